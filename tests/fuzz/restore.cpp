// Any bytes are either the state of a world, which is then whole enough to be looked at and saved again, or an Error
// that leaves the world as it was. (A checkpoint has a hash besides, which no fuzzer would get past.)

#include <carom/carom.hpp>
#include <carom/scene.hpp>
#include <cstdlib>

namespace {

using namespace carom;

const Scene& scene() {
    static const Scene made = Scene::parse(R"({"carom": 1, "world": {"integrator": "adaptive"},
        "bodies": [{"name": "a", "radius": 1}, {"position": [3, 0]}, {"name": "c", "kind": "fixed", "position": [0, 3]}],
        "forces": [{"type": "spring", "a": "a", "b": "c"}, {"type": "drag", "linear": 0.1}],
        "expects": [{"quantity": "a.x", "value": 0, "statistic": "zero"}]})");
    return made;
}

std::string saved(const World& world, const Judge& judge) {
    std::string bytes;
    Saver to([&](std::string_view more) { bytes += more; });
    world.save(to);
    judge.save(to);
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    World world = scene().world();
    Judge judge(scene(), world);
    const auto before = state_hash(world);
    Loader from({reinterpret_cast<const char*>(data), size});
    try {
        world.restore(from);
    } catch (const Error&) {
        if (state_hash(world) != before) std::abort();
        return 0;
    }
    try {
        judge.restore(from);
    } catch (const Error&) {
    }
    energy(world);
    for (const BodyId id : world.ids()) world.body(id);
    saved(world, judge);
    return 0;
}

// The fuzzer starts from a true state, which it would never guess.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed);
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    if (size < 100) {
        World world = scene().world();
        Judge judge(scene(), world);
        for (unsigned k = 0; k < seed % 4; ++k) world.step(0.1), judge.observe(world);
        const std::string bytes = saved(world, judge);
        if (bytes.size() <= most) std::copy(bytes.begin(), bytes.end(), data), size = bytes.size();
    }
    return LLVMFuzzerMutate(data, size, most);
}
