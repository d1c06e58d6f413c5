#pragma once
// Joints as they are made and kept by a world.

#include "joints/rows.hpp"
#include "math/elementary.hpp"
#include "state/bodies.hpp"

namespace carom {

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
