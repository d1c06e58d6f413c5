#pragma once
#include "forces/dynamics.hpp"

namespace carom {

/// By row, the bodies whose force stays as it is while they stay where they are: gravity and constant forces, and a
/// drag without wind. A spring may be pulled at its other end, and a field may change with time.
std::vector<bool> only_weighed(const Forces& forces, const Bodies& bodies);

}  // namespace carom
