// Ragdolls: eleven bones, ten hinges with limits and a little friction, of a person of 1.6 m.

#include "joints.hpp"

namespace carom {
namespace {

using namespace test;

struct Bone {
    double y, from, to, radius;  // [m]
    int parent;
    double pivot, lower, upper, friction;  // [m], [rad], [N m]
};
constexpr Bone bones[] = {
    {0.95, -0.02, 0.02, 0.095, -1, 0, 0, 0, 0},             // hip
    {1.20, -0.135, 0.135, 0.09, 0, 1.00, -0.8, 0, 6},       // trunk
    {1.475, -0.038, 0.039, 0.075, 1, 1.40, -0.9, 0.3, 3},   // head
    {0.775, -0.125, 0.125, 0.06, 0, 0.90, -0.15, 1.25, 6},  // thigh
    {0.475, -0.155, 0.125, 0.045, 3, 0.625, -1.6, 0, 3},    // shin
    {0.775, -0.125, 0.125, 0.06, 0, 0.90, -0.15, 1.25, 6},
    {0.475, -0.155, 0.125, 0.045, 5, 0.625, -1.6, 0, 3},
    {1.225, -0.125, 0.125, 0.035, 1, 1.35, -0.3, 2.5, 2},  // arm
    {0.975, -0.125, 0.125, 0.03, 7, 1.10, 0, 1.6, 1},      // forearm
    {1.225, -0.125, 0.125, 0.035, 1, 1.35, -0.3, 2.5, 2},
    {0.975, -0.125, 0.125, 0.03, 9, 1.10, 0, 1.6, 1},
};

/// `number` tells its bones, which pass one another, from those of others.
void add_ragdoll(World& world, Vec2 at, Vec2 velocity, double spin, int number) {
    std::vector<BodyId> here;
    for (const Bone& bone : bones) {
        const Vec2 from_hip{0, bone.y - bones[0].y};
        here.push_back(world.add(Body{.position = at + from_hip,
                                      .velocity = velocity + cross(spin, from_hip),
                                      .angular_velocity = spin,
                                      .shapes = {{.geometry = Capsule{{0, bone.from}, {0, bone.to}, bone.radius},
                                                  .density = 100,
                                                  .filter = {.group = -number}}},
                                      .restitution = 0,
                                      .friction = 0.6}));
        if (bone.parent < 0) continue;
        const RevoluteJoint hinge{.motor = JointMotor{.speed = 0, .maximum = bone.friction},
                                  .limits = {bone.lower, bone.upper}};
        world.add(Joint{.a = here[static_cast<std::size_t>(bone.parent)],
                        .b = here.back(),
                        .at = at + Vec2{0, bone.pivot - bones[0].y},
                        .type = hinge});
    }
}

void add_stairs(World& world) {
    Body stairs{.kind = Kind::fixed, .restitution = 0, .friction = 0.6};
    for (int i = 0; i < 8; ++i)
        stairs.shapes.push_back({.geometry = Box{0.4, 2 - 0.25 * i, {0.2 + 0.4 * i, 1 - 0.125 * i}}});
    world.add(stairs);
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.6}});
}

/// How far a joint is beyond its limits [rad].
double beyond(const World& world, JointId id) {
    const JointLimits limits = std::get<RevoluteJoint>(world.joint(id).type).limits;
    const double q = world.reaction(id).coordinate;
    return std::max(*limits.lower - q, q - *limits.upper);
}

/// What is kept before the drift is kept after it to 1e-11 of a size, so what is beyond is left where a blow in the
/// midst of a substep throws bones about and the drift has no solution: less than a millimetre for a moment, which
/// closes. Some energy is made, before it goes: two sweeps over contacts do not see what joints make of the masses,
/// which is the likely cause. The bounds are twice the most that was measured: 2.4e-3 rad, 5.8e-4 m, 0.43 %.
TEST(Ragdolls, FallDownStairsAndComeToRest) {
    World world = mechanism_world();
    add_stairs(world);
    for (int i = 0; i < 4; ++i) add_ragdoll(world, {0.6 + 0.4 * i, 3.2 + 1.2 * i}, {1.5, 1}, -2 - i, i + 1);
    double over = 0, gap = 0, made = 0, least = HUGE_VAL;
    watch(world, 20, [&] {
        for (const JointId id : world.joint_ids()) {
            over = std::max(over, beyond(world, id));
            gap = std::max(gap, world.reaction(id).gap);
        }
        const double total = energy(world).total();
        least = std::min(least, total), made = std::max(made, total - least);
    });
    std::printf("beyond %.2g rad, gap %.2g m, made %.3g of %.4g J\n", over, gap, made, energy(world).initial_total);
    EXPECT_LE(over, 5e-3);
    EXPECT_LE(gap, 1e-3);
    EXPECT_LE(made, 0.01 * energy(world).initial_total);
    EXPECT_LE(gaps(world), 1e-9);
    for (const JointId id : world.joint_ids()) EXPECT_LE(beyond(world, id), 1e-8);
    for (const BodyId id : world.ids()) EXPECT_TRUE(world.asleep(id) || world.body(id).kind == Kind::fixed);
}

/// A crowd of limbs, of which some bear much, is not cut into twice as many substeps for these, and lies in the floor
/// four times as deep as if it were (0.004 of a radius): that is little still, hardly any energy is made, and all come
/// to rest.
TEST(Ragdolls, PileUpInAPitAndComeToRest) {
    constexpr int many = 20;
    constexpr double width = 5;
    World world = mechanism_world();
    Body pit{.kind = Kind::fixed, .restitution = 0, .friction = 0.6};
    for (const double x : {-0.5, width + 0.5}) pit.shapes.push_back({.geometry = Box{1, 60, {x, 29}}});
    pit.shapes.push_back({.geometry = Box{width, 1, {width / 2, -0.5}}});
    world.add(pit);
    for (int i = 0; i < many; ++i)
        add_ragdoll(world, {0.6 + std::fmod(1.7 * i, width - 1.2), 1.3 + 2 * i}, {0.3 * (i % 3 - 1), 0},
                    0.5 * (i % 5 - 2), i + 1);
    double made = 0, least = HUGE_VAL, sunk = 0;
    int pressed = 0;
    watch(world, 14, [&] {
        const double total = energy(world).total();
        least = std::min(least, total), made = std::max(made, total - least);
        for (const BodyId id : world.ids())
            for (const Shape& shape : world.body(id).shapes)
                if (const auto* limb = std::get_if<Capsule>(&shape.geometry))
                    for (const Vec2 end : {limb->a, limb->b})
                        if (const double deep = 1 - to_world(world.pose(id), end).y / limb->radius; deep > 0)
                            sunk += deep, ++pressed;
    });
    std::printf("made %.3g of %.6g J, %.3g of a radius in the floor\n", made, energy(world).initial_total,
                sunk / pressed);
    EXPECT_LE(made, 0.01 * energy(world).initial_total);
    EXPECT_LE(sunk / pressed, 0.03);  // by chance: 0.011 to 0.025 in ten starts that differ by 1e-3 m/s
    EXPECT_LE(gaps(world), 1e-9);
    for (const BodyId id : world.ids()) EXPECT_TRUE(world.asleep(id) || world.body(id).kind == Kind::fixed);
}

/// One that lay on a limit, by 1e-10 rad beyond it, was not seen to stand: it was solved for in every step.
TEST(Ragdolls, ThatLieOnALimitStandWhereNobodySleeps) {
    World world = mechanism_world({.sleep = false});
    world.add(HalfPlane{.side = {.restitution = 0, .friction = 0.6}});
    for (int i = 0; i < 12; ++i) add_ragdoll(world, {4.0 * i, 2 + 0.2 * i}, {0.1 * (i - 6), 0}, 0.1 * (i - 6), i + 1);
    run(world, 8, frame);
    for (const BodyId id : world.ids()) {
        EXPECT_EQ(world.velocity(id), Vec2{});
        EXPECT_EQ(world.angular_velocity(id), 0);
    }
}

}  // namespace
}  // namespace carom
