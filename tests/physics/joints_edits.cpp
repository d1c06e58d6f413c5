// Mechanisms that an edit does not concern stay as they were made. That changes nothing: who is restored after each
// edit has all made anew, and goes on with the same bits.

#include "choices.hpp"
#include "joints.hpp"
#include "trials.hpp"

namespace carom::test {
namespace {

/// Groups of bodies hung on a ceiling, between two of its places, on each other, or not at all, above a floor; and what
/// a user does to them. The same seed makes the same and does the same.
class EditedMechanisms {
    Choices any_;

    template <class List>
    auto one_of(const List& list) {
        return list[any_.below(list.size())];
    }

  public:
    explicit EditedMechanisms(std::uint64_t seed) : any_(seed) {
        world.add(HalfPlane{.point = {0, -4}, .side = {.restitution = 0.2, .friction = 0.5}});
        for (int group = 0; group < 5; ++group) add_group(4.0 * group);
    }
    void edit() {
        switch (any_.below(11)) {
            case 0:
                world.add(loose());
                break;
            case 1:
                add_group(any_.between(-5, 25));
                break;
            case 2:
                world.remove(one_of(world.ids()));
                break;
            case 3:
                if (!world.joints().empty()) world.remove(one_of(world.joint_ids()));
                break;
            case 4:
                join(one_of(world.ids()), one_of(world.ids()));
                break;
            case 5:
                set_joint();
                break;
            case 6:
                change_body([&](Body& b) { b.mass *= any_.between(0.5, 2); });
                break;
            case 7:
                change_body([&](Body& b) { b.radius = 0, b.shapes = {{.geometry = Disc{{0.1, 0.05}, 0.2}}}; });
                break;
            case 8:
                change_body([&](Body& b) { b.position.x += 0.01; });
                break;
            case 9:
                world.configure({.gravity = {any_.between(-1, 1), -gravity}, .solver = SoftStep{}});
                break;
            default:
                world.add(ConstantForce{.body = one_of(world.ids()), .force = {any_.between(-2, 2), 0}});
        }
    }
    int steps() { return any_.below(4); }

    World world = mechanism_world();

  private:
    Body loose() {
        return {.position = {any_.between(-5, 25), any_.between(-3, 2)},
                .mass = any_.between(0.3, 3),
                .radius = 0.2,
                .restitution = 0.1,
                .friction = 0.4};
    }
    void add_group(double x) {
        const int bodies = 1 + any_.below(5), held = any_.below(4);
        std::optional<BodyId> last;
        for (int i = 0; i < bodies; ++i) {
            Body body = loose();
            body.position = {x + 0.6 * i, 1.0 * any_.below(2)};
            const BodyId next = world.add(body);
            if (last) join(*last, next);
            const bool is_held = (held > 0 && i == 0) || (held > 1 && i + 1 == bodies);
            if (is_held) world.add(Joint{.b = next, .at = body.position + Vec2{0, 0.5}, .type = RevoluteJoint{}});
            last = next;
        }
    }
    void join(BodyId a, BodyId b) {
        if (a == b || (world.body(a).kind == Kind::fixed && world.body(b).kind == Kind::fixed)) return;
        const JointType types[] = {RevoluteJoint{},
                                   RevoluteJoint{.motor = JointMotor{.speed = 1, .maximum = 2}, .limits = {-0.4, 0.6}},
                                   RevoluteJoint{.spring = JointSpring{.stiffness = 5, .damping = 0.1}},
                                   DistanceJoint{},
                                   DistanceJoint{.limits = {.upper = 1.5}},
                                   WeldJoint{},
                                   PrismaticJoint{.axis = {1, 0}, .limits = {-0.2, 0.2}},
                                   FilterJoint{}};
        Joint joint{.a = a, .b = b, .type = types[any_.below(std::size(types))], .collide = any_.chance(0.5)};
        if (!std::holds_alternative<DistanceJoint>(joint.type))
            joint.at = 0.5 * (world.position(a) + world.position(b));
        if (std::holds_alternative<FilterJoint>(joint.type)) joint.at.reset();
        if (any_.chance(0.2) && !std::holds_alternative<FilterJoint>(joint.type)) joint.break_force = 50;
        world.add(joint);
    }
    void set_joint() {
        if (world.joints().empty()) return;
        const JointId id = one_of(world.joint_ids());
        Joint joint = world.joint(id);
        if (auto* hinge = std::get_if<RevoluteJoint>(&joint.type)) hinge->motor = JointMotor{.speed = -2, .maximum = 1};
        joint.break_force = 80;
        if (!std::holds_alternative<FilterJoint>(joint.type)) world.set(id, joint);
    }
    template <class Change>
    void change_body(Change change) {
        const BodyId id = one_of(world.ids());
        Body body = world.body(id);
        change(body);
        world.set(id, body);
    }
};

TEST(EditedMechanisms, GoOnAsThoseThatAreMadeAnew) {
    constexpr std::uint64_t worlds = trials(40);
    constexpr int edits = 60;
    for (std::uint64_t seed = 0; seed < worlds; ++seed) {
        EditedMechanisms kept(seed), anew(seed);
        for (int i = 0; i < edits; ++i) {
            kept.edit(), anew.edit();
            saved(kept.world);  // closes the edit, as it does for the other one
            restore_from(World(anew.world), anew.world);
            for (int k = kept.steps(); k-- > 0;) kept.world.step(frame);
            for (int k = anew.steps(); k-- > 0;) anew.world.step(frame);
            ASSERT_EQ(state_hash(kept.world), state_hash(anew.world)) << "seed " << seed << ", edit " << i;
        }
    }
}

}  // namespace
}  // namespace carom::test
