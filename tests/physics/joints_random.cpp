// Small linkages of all kinds of joints, many of them locked, contradictory or at a dead point, and what falls on them.
// Nothing in them drives anything: whatever they do, they only lose energy.

#include "choices.hpp"
#include "joints.hpp"
#include "trials.hpp"

namespace carom::test {
namespace {

/// A few rows of bodies with a joint between most neighbours, in a grid, where many are in line; and some loads above.
class RandomLinkage {
  public:
    explicit RandomLinkage(std::uint64_t seed) : any_(seed) {
        columns_ = 1 + any_.below(3), rows_ = 1 + any_.below(2);
        const bool floor = any_.chance(0.5), discs = any_.chance(0.3);
        if (floor) world.add({.kind = Kind::fixed, .shapes = {{.geometry = Box{200, 2, {0, -1}}}}, .friction = 0.6});
        const double lift = floor ? any_.between(0.5, 3) : 0;
        friction_ = std::exp(any_.between(-3, 4)), stiffness_ = std::exp(any_.between(-1, 6));
        const int held = any_.below(4);  // nobody, the left end, both, the corners above
        for (int y = 0; y < rows_; ++y)
            for (int x = 0; x < columns_; ++x) {
                Body body = discs ? Body{.shapes = {{.geometry = Disc{.radius = 0.3}}}}
                                  : Body{.shapes = {{.geometry = Box{0.9, 0.3}}}};
                body.position = {1.0 * x, lift + rows_ - 1 - y}, body.restitution = 0, body.friction = 0.6;
                const bool is_end = x == 0 || x == columns_ - 1;
                if ((held == 1 && x == 0) || (held == 2 && is_end) || (held == 3 && y == 0 && is_end))
                    body.kind = Kind::fixed;
                grid_.push_back(world.add(body));
            }
        const int one = any_.below(kinds);
        const bool mixed = any_.chance(0.4);
        const auto join = [&](int a, int b) { add_joint(a, b, mixed ? any_.below(kinds) : one); };
        for (int y = 0; y < rows_; ++y)
            for (int x = 0; x < columns_; ++x) {
                const int here = y * columns_ + x;
                if (x + 1 < columns_) join(here, here + 1);
                if (y + 1 < rows_ && any_.chance(0.8)) join(here, here + columns_);
            }
        for (int i = any_.below(5); i-- > 0;)
            world.add(
                {.position = {any_.between(0, columns_ - 1), lift + rows_ + 0.5 + i},
                 .shapes = {{.geometry = any_.chance(0.5) ? Geometry(Box{0.6, 0.6}) : Geometry(Disc{.radius = 0.3}),
                             .density = any_.between(0.5, 4)}},
                 .restitution = 0,
                 .friction = 0.6});
    }

    World world = mechanism_world({.sleep = false});

  private:
    static constexpr int kinds = 13;

    void add_joint(int a, int b, int kind) {
        const BodyId first = grid_[static_cast<std::size_t>(a)], second = grid_[static_cast<std::size_t>(b)];
        if (world.body(first).kind == Kind::fixed && world.body(second).kind == Kind::fixed) return;
        Joint joint{.a = first, .b = second, .at = 0.5 * (world.position(first) + world.position(second))};
        if (kind >= 10) joint.at.reset();
        if (kind == 10) joint.anchor_a = {any_.between(-0.2, 0.2), 0};
        const JointMotor brake{.maximum = friction_};
        const JointSpring spring{.stiffness = stiffness_, .damping = 0.1 * stiffness_ * any_.below(2)};
        const JointType types[] = {RevoluteJoint{},
                                   RevoluteJoint{.motor = brake},
                                   RevoluteJoint{.spring = spring, .limits = {-0.2, 0.2}},
                                   RevoluteJoint{.motor = brake, .limits = {-0.3, 0.3}},
                                   WeldJoint{},
                                   WeldJoint{.spring = JointSpring{.frequency = 5, .damping_ratio = 0.3}},
                                   PrismaticJoint{.axis = {1, 0}, .motor = brake, .limits = {-0.2, 0.2}},
                                   WheelJoint{.spring = spring, .motor = brake},
                                   MotorJoint{.maximum_force = 10 * friction_, .maximum_torque = friction_},
                                   FrictionJoint{.maximum_force = 5 * friction_, .maximum_torque = friction_},
                                   DistanceJoint{},
                                   DistanceJoint{.limits = {std::nullopt, 1.0}},
                                   DistanceJoint{.spring = spring, .limits = {0.5, 1.5}}};
        joint.type = types[kind];
        world.add(joint);
    }

    Choices any_;
    int columns_, rows_;
    double friction_, stiffness_;
    std::vector<BodyId> grid_{};
};

TEST(RandomLinkages, OnlyLoseEnergy) {
    constexpr std::uint64_t worlds = trials(600);
    for (std::uint64_t seed = 0; seed < worlds; ++seed) {
        RandomLinkage linkage(seed);
        World& world = linkage.world;
        const double first = energy(world).total();
        double most = -HUGE_VAL, fall = 1, unaccounted = 0;
        run(world, 2.5, 1.0 / 60, [&](const World& w) {
            const Energy e = energy(w);
            most = std::max(most, e.total() - e.work.overlap - e.work.correction - first);
            fall = std::max(fall, first - e.potential());
            unaccounted = std::max(unaccounted, std::abs(e.unaccounted()));
        });
        // The method may give back a little of what an impact took: of what fell so far.
        EXPECT_LE(most, 0.1 + 0.02 * fall) << seed;
        EXPECT_LE(unaccounted, 1e-9 * (fall + std::abs(first))) << seed;  // rounding
    }
}

}  // namespace
}  // namespace carom::test
