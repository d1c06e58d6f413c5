// Any text is either a scene or an Error, and a scene is the same after it was written and read.

#include <carom/scene.hpp>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const std::string_view text(reinterpret_cast<const char*>(data), size);
        const carom::Scene scene = carom::Scene::parse(text);
        const std::string canonical = scene.text();
        if (carom::Scene::parse(canonical).text() != canonical) std::abort();
        carom::World world = scene.world();
        if (world.size() > 100) return 0;
        for (int i = 0; i < 3; ++i) world.step(0.01);
        carom::Scene::of(world);
    } catch (const carom::Error&) {
    }
    return 0;
}
