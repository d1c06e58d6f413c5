#include "notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "behind.hpp"
#include "linked.hpp"

namespace carom::app {

namespace {

std::string name_of(const World& world, const ShapeId& shape) {
    if (shape.body.generation == 0) {
        constexpr std::string_view sides[] = {"left", "right", "bottom", "top"};
        const std::size_t wall = shape.shape, of_rectangles = 4 * world.rectangles().size();
        if (wall < of_rectangles) return fmt::format("the {} wall", sides[wall % 4]);
        return fmt::format("half-plane {}", wall - of_rectangles);
    }
    const std::string name = world.body(shape.body).name;
    const auto ids = world.ids();
    return name.empty() ? fmt::format("body {}", std::find(ids.begin(), ids.end(), shape.body) - ids.begin())
                        : fmt::format("'{}'", name);
}

constexpr std::size_t named = 3;  // of what is in doubt

bool is_point(const World& world, const ShapeId& shape) {
    if (shape.body.generation == 0) return false;
    const Body body = world.body(shape.body);
    return body.radius == 0 && body.shapes.empty();
}

/// Whether it is of a disc of an exact gas, which does not start so: it is refused, or moved.
bool is_of_gas(const World& world, const Overlap& overlap) {
    if (!std::holds_alternative<Events>(world.settings().solver)) return false;
    const auto is_free = [&](const ShapeId& shape) {
        return shape.body.generation != 0 && world.body(shape.body).kind == Kind::dynamic &&
               !world.in_steps(shape.body);
    };
    return is_free(overlap.shapes.a) || is_free(overlap.shapes.b);
}

/// What is inside of one another by more than what may be meant to be pressed together.
std::vector<Overlap> deep_overlaps(const World& world) {
    constexpr double much = 0.01;  // of what is thinner
    if (std::holds_alternative<NoContact>(world.settings().solver)) return {};
    const auto* const impulse = std::get_if<Impulse>(&world.settings().solver);
    std::vector<Overlap> deep = world.overlaps();
    std::erase_if(deep, [&](const Overlap& o) {
        return o.part < much || (impulse && !impulse->disc_collisions && !o.shapes.at_wall()) || is_of_gas(world, o);
    });
    return deep;
}

/// A list of the first few overlaps.
std::string listed(const World& world, const std::vector<Overlap>& deep) {
    std::string text;
    for (std::size_t k = 0; k < std::min(named, deep.size()); ++k) {
        const auto& [a, b] = deep[k].shapes;
        const bool turned = is_point(world, a);
        text += fmt::format("{}{} is {:.3g} m inside of {}", k == 0 ? "" : ", ", name_of(world, turned ? a : b),
                            deep[k].depth, name_of(world, turned ? b : a));
    }
    return deep.size() > named ? text + fmt::format(", and {} more", deep.size() - named) : text;
}

/// What is said of bodies that are inside of one another, each empty if none are: of shapes, and of points in shapes.
std::pair<std::string, std::string> overlapping(const World& world) {
    std::vector<Overlap> deep = deep_overlaps(world), points;
    const auto* const impulse = std::get_if<Impulse>(&world.settings().solver);
    if (!impulse)  // SoftStep pushes no point out
        std::erase_if(deep, [&](const Overlap& o) {
            const bool of_point = is_point(world, o.shapes.a) || is_point(world, o.shapes.b);
            if (of_point) points.push_back(o);
            return of_point;
        });
    std::pair said{listed(world, deep), listed(world, points)};
    if (!deep.empty())
        said.first += impulse && impulse->time_of_impact
                          ? ". The solver 'impulse' knows bodies that are apart: it takes these as touching where they "
                            "are"
                          : ". They will be pushed apart, and what that takes is work against overlap";
    if (!points.empty())
        said.second +=
            ". A point is not pushed out of a shape, and stops what would bring it deeper, as if it touched the rim: a "
            "joint of type 'filter' lets the two pass one another";
    return said;
}

/// Whether a joint does not fit where its bodies are by more than hand-written numbers round.
bool gapes(const World& world, const Joint& joint, double gap) {
    constexpr double much = 1e-3, rounding = 1e-9, dust = 1e-15;  // dust: what a metre is rounded by [m]
    const Vec2 b = world.position(joint.b);
    const Vec2 pivot = joint.a ? to_world(world.pose(*joint.a), joint.anchor_a) : joint.anchor_a;
    const double reach = std::max(length(joint.anchor_b), length(b - pivot));
    return gap > much * reach && gap > dust && gap > rounding * (length(b) + length(pivot));
}

std::string name_of(const Joint& joint, std::size_t k) {
    return joint.name.empty() ? fmt::format("joint {}", k) : fmt::format("joint '{}'", joint.name);
}

/// A list of what is said of some joints, the first few of them; empty if it is of none.
template <class Say>
std::string of_joints(const World& world, Say say) {
    std::string text;
    std::size_t found = 0;
    for (std::size_t k = 0; k < world.joints().size(); ++k) {
        const std::string said = say(world.joints()[k], world.joint_ids()[k], k);
        if (said.empty() || ++found > named) continue;
        text += (found == 1 ? "" : ", ") + said;
    }
    return found > named ? text + fmt::format(", and {} more", found - named) : text;
}

/// Joints that do not fit where their bodies are; empty if all do.
std::string gaping(const World& world) {
    const std::string text = of_joints(world, [&world](const Joint& joint, JointId id, std::size_t k) {
        const double gap = world.reaction(id).gap;
        return gapes(world, joint, gap) ? fmt::format("{} gapes by {:.3g} m", name_of(joint, k), gap) : "";
    });
    if (text.empty()) return "";
    return text + ". The first step puts the bodies where it closes: is 'at' right, or the anchors and lengths?";
}

/// Joints that do not allow the velocities of their bodies by more than hand-written numbers round; empty if all do.
std::string breaking(const World& world) {
    constexpr double much = 1e-3;
    const std::string text = of_joints(world, [&world](const Joint& joint, JointId id, std::size_t k) -> std::string {
        double speed = length(world.velocity(joint.b)), spin = std::abs(world.angular_velocity(joint.b));
        double around = spin * length(joint.anchor_b);
        if (joint.a) {
            const double own = std::abs(world.angular_velocity(*joint.a));
            speed += length(world.velocity(*joint.a)), spin += own;
            // What holds b along an axis of a is seen from a where b is.
            around +=
                own * std::max(length(joint.anchor_a), length(world.position(joint.b) - world.position(*joint.a)));
        }
        const Breach breach = world.breach(id);
        const bool moves = breach.speed > much * (speed + around), turns = breach.spin > much * spin;
        if (!moves && !turns) return "";
        const std::string by = moves ? fmt::format("{:.3g} m/s", breach.speed) : "",
                          about = turns ? fmt::format("{:.3g} rad/s", breach.spin) : "";
        return fmt::format("{} by {}{}{}", name_of(joint, k), by, moves && turns ? " and " : "", about);
    });
    if (text.empty()) return "";
    return "the velocities break " + text +
           ". The first step stops that, and the energy this takes is residual: do velocity and angular_velocity fit?";
}

/// Whether a body is a point, whose angle nothing changes.
bool does_not_turn(const Body& body) {
    return body.kind == Kind::dynamic && body.moment_of_inertia.value_or(body.radius) == 0;
}

/// Points on which a torque acts, which has nothing to turn there; empty if there are none.
std::string unturned(const World& world) {
    std::vector<BodyId> turned;
    for (const ConstantForce& force : world.constant_forces())
        if (force.torque != 0 || force.point != Vec2{}) turned.push_back(force.body);
    for (const TorsionSpring& spring : world.torsion_springs()) turned.insert(turned.end(), {spring.a, spring.b});
    for (const BodyId id : turned) {
        if (does_not_turn(world.body(id)))
            return name_of(world, ShapeId{.body = id}) +
                   " is a point, which no torque turns: it needs a radius, shapes or a moment_of_inertia";
    }
    return "";
}

/// Whether a joint has a motor that takes whatever force is needed.
bool has_unlimited_motor(const Joint& joint) {
    return std::visit(
        [](const auto& type) {
            if constexpr (requires { type.motor->maximum; })
                return type.motor && type.motor->speed != 0 && !type.motor->maximum;
            else if constexpr (requires { type.velocity; })
                return (type.velocity != Vec2{} && !type.maximum_force) ||
                       (type.angular_velocity != 0 && !type.maximum_torque);
            else
                return false;
        },
        joint.type);
}

/// What motors without a maximum have driven into something; empty if it is nothing.
std::string driven_in(const World& world) {
    constexpr double much = 0.1;  // of what is thinner
    const auto joints = world.joints();
    const auto motor = std::find_if(joints.begin(), joints.end(), has_unlimited_motor);
    if (motor == joints.end() || !(energy(world).work.motor > 0)) return "";
    std::vector<BodyId> moved{motor->b};
    if (motor->a) moved.push_back(*motor->a);
    const std::unordered_set<BodyId> all = linked(world, moved);
    std::vector<Overlap> deep = deep_overlaps(World(world));  // the shapes that it lays out stay with a world
    std::erase_if(deep, [&](const Overlap& o) {
        return o.part < much || !(all.contains(o.shapes.a.body) || all.contains(o.shapes.b.body));
    });
    if (deep.empty()) return "";
    for (auto& [shapes, depth, part] : deep)
        if (!all.contains(shapes.b.body)) std::swap(shapes.a, shapes.b);  // who was moved is told first
    return fmt::format(
        "at the end {}. The motor of {} has no maximum, and drives what it moves through whatever is in the way: give "
        "it one",
        listed(world, deep), name_of(*motor, static_cast<std::size_t>(motor - joints.begin())));
}

/// A point that turns beside a joint's anchor: what has no moment of inertia nothing slows down. Empty if none does.
std::string turning_points(const World& world) {
    return of_joints(world, [&world](const Joint& joint, JointId, std::size_t k) -> std::string {
        if (std::holds_alternative<FilterJoint>(joint.type)) return "";
        const auto turns = [&world](BodyId id, Vec2 anchor) {
            return anchor != Vec2{} && world.angular_velocity(id) != 0 && does_not_turn(world.body(id));
        };
        const bool is_a = joint.a && turns(*joint.a, joint.anchor_a);
        if (!is_a && !turns(joint.b, joint.anchor_b)) return "";
        const BodyId id = is_a ? *joint.a : joint.b;
        return fmt::format("{} is a point that turns at {:.3g} rad/s, {:.3g} m beside {}",
                           name_of(world, ShapeId{.body = id}), world.angular_velocity(id),
                           length(is_a ? joint.anchor_a : joint.anchor_b), name_of(joint, k));
    });
}

/// The expressions that a scene looks at.
std::vector<std::string> quantities_of(const Scene& scene) {
    std::vector<std::string> all;
    for (const Expectation& e : scene.expectations()) all.push_back(e.quantity);
    for (const Twin& twin : scene.twins()) all.push_back(twin.quantity);
    for (const Picture& picture : scene.pictures())
        all.insert(all.end(), picture.quantities.begin(), picture.quantities.end());
    return all;
}

/// The angle of a point that is looked at, most likely meant as that of a pendulum; empty if none is.
std::string constant_angle(const World& world, const Scene& scene, const std::vector<std::string>& quantities) {
    for (const std::string& quantity : quantities) {
        std::vector<std::string> names;
        try {
            names = Quantity(quantity, world, scene.parameters(), true).names();
        } catch (const Error&) {
            continue;  // who uses it says what is wrong
        }
        for (const std::string& name : names) {
            const auto dot = name.rfind('.');
            const std::string of = name.substr(0, dot), what = dot == name.npos ? "" : name.substr(dot + 1);
            if (what != "angle" && what != "omega") continue;
            const Body body = world.body(world.find(of));
            if (!does_not_turn(body) || body.angular_velocity != 0) continue;
            return fmt::format(
                "{} never changes: '{}' is a point, and does not turn. The direction in which it lies is that of its "
                "place, as atan2({}.x, -{}.y) of a pendulum that hangs at (0, 0)",
                in_expression(of) + "." + what, of, in_expression(of), in_expression(of));
        }
    }
    return "";
}

/// A free point among lines, which do not stop it; empty if there is none.
std::string unstopped(const World& world) {
    const auto is_line = [](const Shape& s) {
        return !s.sensor && (std::holds_alternative<Segment>(s.geometry) || std::holds_alternative<Chain>(s.geometry));
    };
    const auto has_line = [&](const std::vector<Shape>& of) { return std::any_of(of.begin(), of.end(), is_line); };
    const auto shapes = world.shapes();
    if (!std::holds_alternative<SoftStep>(world.settings().solver) ||
        std::none_of(shapes.begin(), shapes.end(), has_line))
        return "";
    std::unordered_set<BodyId> held;
    for (const Spring& spring : world.springs()) held.insert({spring.a, spring.b});
    for (const Joint& joint : world.joints()) {
        if (joint.a) held.insert(*joint.a);
        held.insert(joint.b);
    }
    for (std::size_t i = 0; i < world.size(); ++i) {
        const BodyId id = world.ids()[i];
        const bool is_point = shapes[i].empty() && world.radii()[i] == 0;
        if (is_point && world.kinds()[i] == Kind::dynamic && !held.contains(id))
            return name_of(world, ShapeId{.body = id}) +
                   " is a point, which passes through segments and chains: to be stopped by them it needs a radius";
    }
    return "";
}

/// Whether a wall that loses nothing is below: what falls comes to it.
bool is_elastic_floor_in(const World& world) {
    const Vec2 gravity = world.settings().gravity;
    const auto is_floor = [&](const Side& side, Vec2 normal) {
        constexpr double upright = 1e-9;  // by rounding a wall beside has a little of a floor
        return side.restitution == 1 && dot(normal, gravity) < -upright * length(normal) * length(gravity);
    };
    const auto planes = world.half_planes();
    const auto rectangles = world.rectangles();
    return std::any_of(planes.begin(), planes.end(), [&](const HalfPlane& h) { return is_floor(h.side, h.normal); }) ||
           std::any_of(rectangles.begin(), rectangles.end(), [&](const Rectangle& r) {
               return is_floor(r.bottom, {0, 1}) || is_floor(r.top, {0, -1}) || is_floor(r.left, {1, 0}) ||
                      is_floor(r.right, {-1, 0});
           });
}

/// Shapes that fall on a wall, or on one another, and lose nothing because nobody said what: they would be expected to
/// come to rest. Empty if somebody said so, be it that it is 1, or in --set.
std::string never_resting(const Scene& scene, const World& world) {
    if (!is_elastic_floor_in(world) || !std::holds_alternative<SoftStep>(world.settings().solver) ||
        scene.text().find("\"restitution\"") != std::string::npos)
        return "";
    const auto is_elastic = [&world](std::size_t i) {
        const auto& shapes = world.shapes()[i];
        const double own = world.body(world.ids()[i]).restitution;
        return !shapes.empty() && std::all_of(shapes.begin(), shapes.end(),
                                              [own](const Shape& s) { return s.restitution.value_or(own) == 1; });
    };
    for (std::size_t i = 0; i < world.size(); ++i)
        if (world.kinds()[i] == Kind::dynamic && is_elastic(i))
            return "no body and no wall has a restitution, which is then 1: " +
                   name_of(world, {.body = world.ids()[i]}) +
                   " bounces off what it falls on and never comes to rest. \"restitution\": 0, of one of the two, "
                   "stops that";
    return "";
}

std::vector<std::string> springs_between_fixed(const World& world) {
    std::vector<std::string> found;
    if (world.springs().empty() && world.torsion_springs().empty()) return found;
    std::unordered_set<BodyId> fixed;
    for (std::size_t i = 0; i < world.size(); ++i)
        if (world.kinds()[i] == Kind::fixed) fixed.insert(world.ids()[i]);
    const auto look = [&](const char* what, BodyId a, BodyId b) {
        if (fixed.contains(a) && fixed.contains(b))
            found.push_back(
                fmt::format("{} between {} and {}", what, name_of(world, {.body = a}), name_of(world, {.body = b})));
    };
    for (const Spring& s : world.springs()) look("a spring", s.a, s.b);
    for (const TorsionSpring& s : world.torsion_springs()) look("a torsion spring", s.a, s.b);
    return found;
}

/// A body that falls through a chain, which is solid from one side alone; empty if none does.
std::string from_behind(const World& world) {
    const auto found = falls_from_behind(world);
    if (!found) return "";
    return fmt::format(
        "{} is behind a chain of {}, which is solid from the left of its points alone, and falls through it: turn the "
        "order of its points round",
        name_of(world, ShapeId{.body = found->body}), name_of(world, ShapeId{.body = found->chain}));
}

/// Forces that do nothing, whatever happens; empty if all may do something.
std::string idle(const World& world) {
    std::string text;
    const auto say = [&text](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
    const auto is_on_fixed = [&](const char* what, std::optional<BodyId> body) {
        const bool fixed = body && world.body(*body).kind == Kind::fixed;
        if (fixed) say(fmt::format("{} on {} does nothing, for it is fixed", what, name_of(world, {.body = *body})));
        return fixed;
    };
    for (const Drag& d : world.drags())
        if (!is_on_fixed("a drag", d.body) && d.linear == 0 && d.quadratic == 0 && d.angular == 0)
            say("a drag does nothing without a coefficient: linear, quadratic or angular");
    for (const ConstantForce& f : world.constant_forces())
        if (!is_on_fixed("a constant force", f.body) && f.force == Vec2{} && f.torque == 0)
            say("a constant force does nothing without a force or a torque");
    for (const ForceField& f : world.fields()) is_on_fixed("a field", f.body);
    // More of them are the edge of a net.
    if (const auto still = springs_between_fixed(world); still.size() <= named)
        for (const std::string& spring : still) say(spring + " does nothing, for both are fixed");
    const auto ids = world.ids();
    const auto charged = std::count_if(ids.begin(), ids.end(), [&](BodyId id) { return world.body(id).charge != 0; });
    for (const Attraction& a : world.attractions())
        if (a.couples == Couples::charge && charged < 2)
            say("an attraction between charges does nothing without two bodies that have a charge");
    return text;
}

}  // namespace

std::vector<Note> notes_at_start(const Scene& scene, const World& start, std::vector<std::string> quantities) {
    const World world = start;  // the shapes that it lays out stay with a world
    for (const std::string& quantity : quantities_of(scene)) quantities.push_back(quantity);
    const auto [shapes, points] = overlapping(world);
    std::vector<Note> all{{"overlap", shapes}, {"point", points}, {"gap", gaping(world)}, {"breach", breaking(world)}};
    std::erase_if(all, [](const Note& note) { return note.text.empty(); });
    for (Note& note : all) note.text = "at the start " + note.text;
    if (scene.plan().measure_from > 0 && !is_measured(world))
        all.push_back({"measure_from",
                       "run.measure_from is of the measures of a gas, which there are of ten dynamic discs or more "
                       "under the solver 'events': here it changes nothing"});
    if (const std::string points_alone = unturned(world); !points_alone.empty())
        all.push_back({"unturned", points_alone});
    if (const std::string engines = turning_points(world); !engines.empty())
        all.push_back({"engine", engines + ". Nothing slows down what has no moment of inertia: it drives what the "
                                           "joint holds with whatever that takes. Give it a radius, shapes or a "
                                           "moment_of_inertia"});
    if (const std::string angle = constant_angle(world, scene, quantities); !angle.empty())
        all.push_back({"angle", angle});
    if (const std::string points_alone = unstopped(world); !points_alone.empty())
        all.push_back({"unstopped", points_alone});
    if (const std::string chain = from_behind(world); !chain.empty()) all.push_back({"behind", chain});
    if (const std::string elastic = never_resting(scene, world); !elastic.empty()) all.push_back({"elastic", elastic});
    if (const std::string forces = idle(world); !forces.empty()) all.push_back({"idle", forces});
    if (const std::string curves = scene.put_off_curves(world); !curves.empty())
        all.push_back({"curve", curves + ". A curve says where the body is from the start on: leave the place away, or "
                                         "let the curve begin there"});
    return all;
}

std::vector<Note> notes_at_end(const World& end) {
    const std::string driven = driven_in(end);
    return driven.empty() ? std::vector<Note>{} : std::vector<Note>{{"motor", driven}};
}

}  // namespace carom::app
