// A mass that was given beside densities counted for nothing, without a word; of a scene it was an error.

#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <cmath>

#include "error_of.hpp"

namespace carom::test {
namespace {

Body plate(double density, double side = 2) {
    return {.shapes = {{.geometry = Box{.width = side, .height = 1}, .density = density}}, .name = "plate"};
}

TEST(MassBesideADensityWasDropped, IsRefused) {
    World world;
    Body heavy = plate(3);
    heavy.mass = 50;
    EXPECT_EQ(error_of([&] { world.add(heavy); }),
              "Body 'plate'.mass must not be given beside a density, which makes it 6 kg, got 50");
    EXPECT_EQ(world.size(), 0u);
    const BodyId id = world.add(plate(3));
    EXPECT_EQ(error_of([&] { world.set(id, heavy); }),
              "Body 'plate'.mass must not be given beside a density, which makes it 6 kg, got 50");
    EXPECT_EQ(world.body(id).mass, 6);
    heavy.mass = NAN;
    EXPECT_NE(error_of([&] { world.add(heavy); }), "no error");
}

TEST(MassBesideADensityWasDropped, ABodyThatIsReadIsTakenBackAndInAnotherWorld) {
    World world, other;
    Body odd = plate(0.7);
    odd.shapes.push_back({.geometry = Hull{{{0, 0}, {1.3, 0.2}, {0.3, 1.7}}, 0.1}, .density = 3.1});
    for (const Kind kind : {Kind::dynamic, Kind::fixed, Kind::driven}) {
        odd.kind = kind, odd.name.clear();
        const BodyId id = world.add(odd);
        for (const Kind to : {Kind::fixed, Kind::dynamic, Kind::driven, Kind::dynamic}) {
            Body body = world.body(id);
            body.kind = to;
            world.set(id, body);
            other.add(world.body(id));
        }
        Body denser = world.body(id);
        for (Shape& shape : denser.shapes) shape.density = 2 * *shape.density;
        const double mass = denser.mass;
        world.set(id, denser);
        EXPECT_NEAR(world.body(id).mass, 2 * mass, 1e-12);
    }
    Body plain = plate(1);
    plain.shapes[0].density.reset(), plain.mass = 7;
    const BodyId id = world.add(plain);
    plain = world.body(id);
    plain.shapes[0].density = 1.0;
    world.set(id, plain);
    EXPECT_EQ(world.body(id).mass, 2);
}

}  // namespace
}  // namespace carom::test
