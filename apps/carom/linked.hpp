#pragma once
#include <carom/carom.hpp>
#include <unordered_set>
#include <vector>

namespace carom::app {

/// The bodies that joints and springs link with some, and these: through dynamic bodies, for others pass nothing on.
std::unordered_set<BodyId> linked(const World& world, std::vector<BodyId> with);

}  // namespace carom::app
