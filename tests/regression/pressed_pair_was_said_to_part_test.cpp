// Two that are pressed only by what relaxes a substep at its end: events() had them part, and for a frame nobody
// touched what contacts() said to press him.
#include <algorithm>
#include <vector>

#include "physics/contacts.hpp"

namespace carom::test {
namespace {

TEST(Events, HaveThoseTouchWhomContactsPress) {
    World world({.gravity = {0, -9.81}, .solver = SoftStep{}});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.5}});
    for (const double side : {-3.0, 3.0})
        world.add(HalfPlane{.point = {side, 0}, .normal = {side < 0 ? 1.0 : -1.0, 0}, .side = {.restitution = 0}});
    Random random(1);
    for (int i = 0; i < 80; ++i) {
        Body body{.position = {-2.5 + 0.7 * (i % 8), 0.5 + 0.7 * (i / 8)},
                  .angle = random.uniform(0, 3),
                  .restitution = 0,
                  .friction = 0.5};
        if (i % 2 != 0)
            body.shapes = {{.geometry = Box{.width = 0.5, .height = 0.4}}};
        else
            body.radius = 0.25;
        world.add(body);
    }
    std::vector<ShapePair> touching;
    for (int step = 0; step < 600; ++step) {
        world.step(1.0 / 60);
        for (const ShapePair& pair : world.events().ends) std::erase(touching, pair);
        for (const ShapePair& pair : world.events().begins) touching.push_back(pair);
        for (const ContactPoint& point : world.contacts())
            ASSERT_NE(std::find(touching.begin(), touching.end(), point.shapes), touching.end())
                << step << ": " << point.normal_force << " N";
    }
}

}  // namespace
}  // namespace carom::test
