// Whether a chain is just as long as its way is found where its mechanism is assembled, and a post that was put
// elsewhere had nothing assembled anew. So a world went on with the slack of where the post had been, and the same one
// restored from a snapshot with that of where it was: 0.5 mm apart after half a second, a chain of three links.
#include <gtest/gtest.h>

#include <carom/carom.hpp>
#include <string>

using namespace carom;

namespace {

struct Chained {
    World world{{.gravity = {0, -9.81}, .solver = SoftStep{}}};
    BodyId post;

    Chained() {
        BodyId last = world.add(Body{.kind = Kind::fixed});
        post = world.add(Body{.kind = Kind::fixed, .position = {3, 0}});
        for (int i = 0; i < 3; ++i) {
            const BodyId link =
                world.add(Body{.position = {0.5 + i, 0}, .mass = 1, .shapes = {{.geometry = Box{1, 0.1}}}});
            world.add(Joint{.a = last, .b = link, .at = Vec2{double(i), 0}, .type = RevoluteJoint{}});
            last = link;
        }
        world.add(Joint{.a = last, .b = post, .at = Vec2{3, 0}, .type = RevoluteJoint{}});
    }
};

}  // namespace

TEST(MovedPostWasForgotten, ByAWorldThatIsNotRestored) {
    Chained one;
    one.world.step(1.0 / 60);
    for (const double x : {2.999, 3.0}) {
        one.world.set_position(one.post, {x, 0}, 0);
        Chained other;
        std::string saved;
        Saver saver([&](std::string_view some) { saved.append(some); });
        one.world.save(saver);
        Loader loader(saved);
        other.world.restore(loader);
        for (int i = 0; i < 30; ++i) one.world.step(1.0 / 60), other.world.step(1.0 / 60);
        for (std::size_t k = 0; k < one.world.size(); ++k)
            EXPECT_EQ(one.world.positions()[k], other.world.positions()[k]) << "body " << k << ", post at " << x;
    }
}
