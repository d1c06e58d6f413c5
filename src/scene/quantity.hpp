#pragma once
#include <string>

namespace carom {

/// Whether a quantity of this name is one of the world as a whole, such as "bodies" or "energy.total".
bool is_of_world(const std::string& name);

}  // namespace carom
