#include <gtest/gtest.h>

#include <carom/scene.hpp>
#include <filesystem>
#include <optional>
#include <set>

#include "reference/truth.hpp"

// An expectation whose source begins with an id of truth.json, as in "mech.kepler[3][0]: Kepler's equation", must
// expect just the value that stands there.

namespace carom {
namespace {

std::vector<Scene> all_scenes() {
    std::vector<Scene> scenes;
    for (const auto& file : std::filesystem::recursive_directory_iterator(std::string(CAROM_SOURCE_DIR) + "/scenes"))
        if (file.path().extension() == ".json") scenes.push_back(Scene::load(file.path()));
    return scenes;
}

/// The value that a source names, if it names one: an id of truth.json and indices into its value.
std::optional<double> value_named(const std::string& source, std::string& id) {
    const auto end = source.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789.");
    id = source.substr(0, end);
    if (id.find('.') == std::string::npos ||
        (!id.starts_with("mech.") && !id.starts_with("ed.") && !id.starts_with("gas.")))
        return std::nullopt;
    const nlohmann::json* at = &truth(id);
    auto from = end;
    for (; from < source.size() && source[from] == '['; from = source.find(']', from) + 1)
        at = &(*at)[std::stoul(source.substr(from + 1))];
    if (!at->is_number() || source[from] != ':') return std::nullopt;
    return at->get<double>();
}

TEST(Scenes, ExpectWhatTheTruthSays) {
    std::set<std::string> said;
    for (const Scene& scene : all_scenes()) {
        for (const Expectation& e : scene.expectations()) {
            std::string id;
            if (const auto value = value_named(e.source, id)) {
                EXPECT_EQ(e.value, *value) << scene.title() << ": " << e.text << " [" << e.source << "]";
                said.insert(id);
            }
        }
    }
    // Rewording a source must not quietly take its truth out of the tests.
    for (const char* id :
         {"ed.cradle", "ed.galperin", "ed.oblique", "mech.block", "mech.catenary", "mech.catenary.elastic",
          "mech.chain.modes", "mech.damped", "mech.double.pendulum", "mech.drop.quad", "mech.kapitza", "mech.kepler",
          "mech.lagrange", "mech.pendulum", "mech.proj", "mech.proj.linear", "mech.proj.quad", "mech.roll"})
        EXPECT_TRUE(said.contains(id)) << id;
}

TEST(Scenes, SayWhatTheyTeachAndWhereTheirNumbersAreFrom) {
    for (const Scene& scene : all_scenes()) {
        EXPECT_FALSE(scene.title().empty());
        EXPECT_FALSE(scene.teaches().empty()) << scene.title();
        EXPECT_FALSE(scene.expectations().empty()) << scene.title();
        EXPECT_FALSE(scene.pictures().empty()) << scene.title();
        for (const Expectation& e : scene.expectations()) {
            EXPECT_FALSE(e.source.empty()) << scene.title() << ": " << e.text;
            EXPECT_FALSE(e.text.empty()) << scene.title() << ": " << e.quantity;
        }
    }
}

}  // namespace
}  // namespace carom
