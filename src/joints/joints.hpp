#pragma once
// Joints as they are made and kept by a world.

#include "joints/rows.hpp"
#include "math/elementary.hpp"
#include "state/bodies.hpp"

namespace carom {

template <class T>
concept Part_of_joint = std::same_as<T, Joint> || std::same_as<T, JointSpring> || std::same_as<T, JointLimits> ||
    std::same_as<T, JointMotor> ||(std::constructible_from<JointType, T> && !std::same_as<T, JointType>);
/// As bytes a joint is its fields: between them there are gaps, in which may be anything.
template <class T>
requires Part_of_joint<std::remove_const_t<T>>
auto members(T& part) {
    return std::apply([&part](const auto&... field) { return std::tie(part.*(field.member)...); }, fields(&part));
}

/// What errors call a joint.
std::string called(const Joint&);
/// How a joint sees a body, or the ground.
End end_of(const std::optional<BodyId>&, const Bodies&, const State&);
/// Checks a joint, and fills in what follows from where the bodies are: anchors, lengths, angles, stiffnesses.
Joint completed(Joint, const Bodies&, const State&);
bool has_spring(const Joint&);
/// What its springs hold [J].
double spring_energy(const Joint&, const Ends&);

}  // namespace carom
