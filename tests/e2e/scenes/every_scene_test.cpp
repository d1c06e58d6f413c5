#include <gtest/gtest.h>

#include <algorithm>
#include <carom/carom.hpp>
#include <carom/scene.hpp>
#include <filesystem>
#include <fstream>

#include "throughput.hpp"

// Every scene through its text and back, and every world through a scene and back, to the last bit; and its ledger.

namespace carom {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> scene_files() {
    std::vector<fs::path> files;
    for (const auto& file : fs::recursive_directory_iterator(fs::path(CAROM_SOURCE_DIR) / "scenes"))
        if (file.path().extension() == ".json") files.push_back(file.path());
    std::sort(files.begin(), files.end());
    return files;
}

class EveryScene : public testing::TestWithParam<fs::path> {};

std::uint64_t hash_after(World world, double step, int steps) {
    for (int n = 0; n < steps; ++n) world.step(step);
    return state_hash(world);
}

TEST_P(EveryScene, IsTheSameThroughItsText) {
    const Scene scene = Scene::load(GetParam());
    const Scene again = Scene::parse(scene.text());
    EXPECT_EQ(again.text(), scene.text());
    EXPECT_EQ(again.title(), scene.title());
    EXPECT_EQ(again.teaches(), scene.teaches());
    EXPECT_EQ(again.expectations().size(), scene.expectations().size());
    EXPECT_EQ(again.pictures().size(), scene.pictures().size());
    EXPECT_EQ(again.plan().step, scene.plan().step);
    EXPECT_EQ(again.plan().duration, scene.plan().duration);
    EXPECT_EQ(state_hash(again.world()), state_hash(scene.world()));
    EXPECT_EQ(hash_after(again.world(), scene.plan().step, 20), hash_after(scene.world(), scene.plan().step, 20));
}

TEST_P(EveryScene, IsTheSameThroughItsWorld) {
    const Scene scene = Scene::load(GetParam());
    World world = scene.world();
    const std::string text = scene.text();
    if (text.find("\"drive\"") != std::string::npos || text.find("\"field\"") != std::string::npos) {
        EXPECT_THROW(Scene::of(world), Error);  // functions have no text
        return;
    }
    for (int n = 0; n < 5; ++n) world.step(scene.plan().step);
    const Scene saved = Scene::of(world, "saved");
    EXPECT_EQ(state_hash(saved.world()), state_hash(world));
    EXPECT_EQ(Scene::of(saved.world(), "saved").text(), saved.text());
    EXPECT_EQ(Scene::parse(saved.text()).text(), saved.text());
    // SoftStep begins with the impulses of its last step, of which a scene knows nothing.
    const auto in_steps = [&](BodyId id) { return world.in_steps(id); };
    if (std::holds_alternative<SoftStep>(world.settings().solver) ||
        std::any_of(world.ids().begin(), world.ids().end(), in_steps))
        return;
    // A saved world goes on as a copy does that has forgotten what its integrator remembered.
    world.configure(world.settings());
    EXPECT_EQ(hash_after(saved.world(), scene.plan().step, 20), hash_after(world, scene.plan().step, 20));
}

TEST_P(EveryScene, ClosesItsLedger) {
    const Scene scene = Scene::load(GetParam());
    World world = scene.world();
    test::Throughput through(world);
    const Plan plan = scene.plan();
    const double steps = std::min(std::ceil(plan.duration / plan.step), 2000.0);
    for (int n = 0; n < steps && !HasFailure(); ++n) {
        world.step(plan.step);
        through.add(world);
        test::expect_closed(world, through);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(scene_files()), [](const auto& file) {
    std::string name = fs::relative(file.param, fs::path(CAROM_SOURCE_DIR) / "scenes").replace_extension().string();
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
});

}  // namespace
}  // namespace carom
