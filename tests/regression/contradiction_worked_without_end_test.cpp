// What joints that contradict one another pull with is anything, for it moves nothing. It was 1 / slack of what they
// miss: a driven body against the ground did 1e6 J in a second, and a blow on what joints hold fast took 1e24 N s.

#include "physics/joints.hpp"

namespace carom::test {
namespace {

Body block(Vec2 position, Vec2 velocity = {}, Kind kind = Kind::dynamic) {
    return {.kind = kind,
            .position = position,
            .velocity = velocity,
            .shapes = {{.geometry = Box{0.5, 0.5}}},
            .restitution = 0,
            .friction = 0.5};
}

/// What flowed through the ledger [J].
double throughput(const World& world) {
    const Energy e = energy(world);
    return std::abs(e.work.driven) + std::abs(e.heat.total()) + std::abs(e.work.total()) + std::abs(e.residual);
}

// A joint from what is driven away to a body, and another one from that to the ground.
TEST(Contradiction, DoesNoWorkAgainstTheGround) {
    constexpr double weight = 9.81, speed = 1, duration = 2;
    for (const JointType& type :
         {JointType(RevoluteJoint{}), JointType(WeldJoint{}), JointType(PrismaticJoint{{0, 1}})}) {
        World world = mechanism_world();
        const BodyId driven = world.add(block({-1, 0}, {-speed, 0}, Kind::driven)), held = world.add(block({0, 0}));
        const JointId first = world.add(Joint{.a = driven, .b = held, .at = Vec2{-0.5, 0}, .type = type});
        const JointId last = world.add(Joint{.b = held, .at = Vec2{0.5, 0}, .type = type});
        watch(world, duration, [&] {
            for (const JointId joint : {first, last}) EXPECT_LE(length(world.reaction(joint).force), weight);
        });
        // Each gives way by half of it, but for slides, which fall.
        EXPECT_NEAR(world.position(held).x, -0.5 * speed * duration, 1e-3);
        EXPECT_LE(throughput(world), 0.5 * weight * weight * duration * duration) << "of the fall";
    }
}

TEST(Contradiction, TakesNoImpulseThatIsWithoutEnd) {
    for (const Geometry& geometry : {Geometry(Box{0.5, 0.5}), Geometry(Disc{.radius = 0.25})})
        for (const double slip : {0.0, 0.3}) {
            World world = mechanism_world({}, {});
            const BodyId ground = world.add(block({0, 0}, {}, Kind::fixed)), held = world.add(block({0.6, 0}));
            world.add(Joint{.a = ground, .b = held, .at = Vec2{0.3, 0}, .type = WeldJoint{}});
            Body striker = block({1.5, 0.1}, {-1, slip}, Kind::driven);
            striker.shapes[0].geometry = geometry;
            world.add(striker);
            watch(world, 0.6, [] {});  // by then it is 20 cm inside
            EXPECT_LE(throughput(world), 1e3) << geometry.index() << ", slip " << slip;
        }
}

// The body between two ropes is driven to where it cannot be.
TEST(Contradiction, OfRopesIsAGap) {
    World world = mechanism_world();
    const BodyId driven = world.add(block({-1, 0}, {-0.5, 0}, Kind::driven)), held = world.add(block({0, 0}));
    const DistanceJoint rope{.limits = {std::nullopt, 1}};
    const JointId first = world.add(Joint{.a = driven, .b = held, .type = rope});
    const JointId last = world.add(Joint{.b = held, .anchor_a = {1, 0}, .type = rope});
    watch(world, 2, [] {});
    const double apart = length(world.position(driven) - Vec2{1, 0});
    EXPECT_GE(world.reaction(first).gap + world.reaction(last).gap, apart - 2 - 1e-9);
}

}  // namespace
}  // namespace carom::test
