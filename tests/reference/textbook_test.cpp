#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <carom/scene.hpp>

#include "reference/truth.hpp"

// The textbook's three runs, every state of every step.

namespace carom {
namespace {

const nlohmann::json& textbook() {
    static const nlohmann::json runs = reference_file("textbook.json");
    return runs;
}

Scene scene_of(const std::string& name) { return Scene::load(std::string(CAROM_SOURCE_DIR) + "/scenes/" + name); }

void expect_state(const World& world, BodyId body, const nlohmann::json& row, double tolerance) {
    EXPECT_NEAR(world.position(body).x, row[0].get<double>(), tolerance);
    EXPECT_NEAR(world.position(body).y, row[1].get<double>(), tolerance);
    EXPECT_NEAR(world.velocity(body).x, row[2].get<double>(), tolerance);
    EXPECT_NEAR(world.velocity(body).y, row[3].get<double>(), tolerance);
}

TEST(Textbook, EveryStateOfTheFiveProjectiles) {
    const auto& run = textbook()["projectiles"];
    const Scene scene = scene_of("projectiles.json");
    World world = scene.world();
    EXPECT_EQ(scene.plan().step, run["dt"].get<double>());
    EXPECT_EQ(scene.plan().duration, run["steps"].get<int>() * run["dt"].get<double>());
    for (int n = 0; n <= run["steps"].get<int>(); ++n) {
        SCOPED_TRACE(n);
        for (std::size_t i = 0; i < 5; ++i) expect_state(world, world.ids()[i], run["states"][i][n], 1e-12);
        world.step(run["dt"]);
    }
}

TEST(Textbook, EveryStateOfTheSpringPendulum) {
    const auto& run = textbook()["spring_pendulum"];
    World world = scene_of("spring-pendulum.json").world();
    const BodyId bob = world.find("bob");
    for (int n = 0; n <= run["steps"].get<int>(); ++n) {
        SCOPED_TRACE(n);
        expect_state(world, bob, run["states"][n], 1e-11);
        world.step(run["dt"]);
    }
}

TEST(Textbook, TheGasStartsFromNumpysBits) {
    const World world = scene_of("gas.json").world();
    const auto& initial = textbook()["gas"]["initial"];
    ASSERT_EQ(world.size(), initial.size());
    for (std::size_t i = 0; i < world.size(); ++i) {
        EXPECT_EQ(world.positions()[i].x, initial[i]["pos"][0].get<double>()) << i;
        EXPECT_EQ(world.positions()[i].y, initial[i]["pos"][1].get<double>()) << i;
        EXPECT_EQ(world.velocities()[i].x, initial[i]["vel"][0].get<double>()) << i;
        EXPECT_EQ(world.velocities()[i].y, initial[i]["vel"][1].get<double>()) << i;
        EXPECT_EQ(world.radii()[i], initial[i]["radius"].get<double>()) << i;
    }
}

// A gas is chaotic: rounding of 1e-16 grows by some thousands in nine seconds, hence 1e-9 for its places.
TEST(Textbook, TheGasPassesThroughItsSnapshots) {
    const auto& run = textbook()["gas"];
    World world = scene_of("gas.json").world();
    EXPECT_NEAR(energy(world).kinetic, run["kinetic_energy_start"].get<double>(), 1e-12);
    int seen = 0;
    for (int n = 0; n <= run["steps"].get<int>(); ++n) {
        if (const auto snapshot = run["snapshots"].find(std::to_string(n)); snapshot != run["snapshots"].end()) {
            ++seen;
            for (std::size_t i = 0; i < world.size(); ++i) {
                EXPECT_NEAR(world.positions()[i].x, (*snapshot)[i][0].get<double>(), 1e-9) << n << " " << i;
                EXPECT_NEAR(world.positions()[i].y, (*snapshot)[i][1].get<double>(), 1e-9) << n << " " << i;
            }
        }
        if (n < run["steps"].get<int>()) world.step(run["dt"]);
    }
    EXPECT_EQ(seen, 4);
    EXPECT_NEAR(energy(world).kinetic, run["kinetic_energy_end"].get<double>(), 1e-11);
}

}  // namespace
}  // namespace carom
