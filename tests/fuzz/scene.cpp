// Any text is either a scene or an Error. A scene is the same after it was written and read, its world runs or says why
// not, and the world as a scene of its own has the same bits.

#include <carom/analysis.hpp>
#include <carom/scene.hpp>
#include <cstdint>
#include <cstdlib>

namespace {

using namespace carom;

/// So that an input takes milliseconds: a scene may ask for more bodies, and for more work, than a fuzzer has time for.
constexpr std::size_t most_bodies = 60, most_forces = 60;
constexpr double most_substeps = 20;

void require(bool right) {
    if (!right) std::abort();
}

bool is_small(const World& world) {
    const std::size_t fields = world.fields().size(),
                      walls = world.half_planes().size() + world.rectangles().size() + world.stadiums().size();
    return world.size() <= most_bodies && world.springs().size() <= 4 * most_bodies && fields + walls <= most_forces &&
           world.attractions().size() + world.soft_discs().size() + world.drags().size() +
                   world.torsion_springs().size() <=
               most_forces;
}

/// Methods that choose their own step may choose any number of them.
bool is_bounded(const World& world) {
    const Integrator& method = world.settings().integrator;
    return !std::holds_alternative<Adaptive>(method) && !std::holds_alternative<Nystrom>(method) &&
           !std::holds_alternative<GaussRadau>(method);
}

void run_a_little(const Scene& scene, World world) {
    Judge judge(scene, world);
    const double step = std::min(scene.plan().step, most_substeps * world.stable_step());
    for (int n = 0; n < 3 && is_bounded(world); ++n) {
        world.step(step);
        judge.observe(world);
    }
    judge.verdicts();
}

void save_and_load(const World& world) {
    const Scene saved = Scene::of(world);
    const Scene again = Scene::parse(saved.text());
    require(again.text() == saved.text());
    require(state_hash(again.world()) == state_hash(world));
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    setenv("CAROM_MEMORY", "3e6", 1);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const Scene scene = Scene::parse({reinterpret_cast<const char*>(data), size});
        const std::string text = scene.text();
        require(Scene::parse(text).text() == text);
        const World world = scene.world();
        if (!is_small(world)) return 0;
        run_a_little(scene, world);
        if (world.fields().empty()) save_and_load(world);
    } catch (const Error&) {
    }
    return 0;
}
