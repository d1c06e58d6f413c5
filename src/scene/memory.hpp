#pragma once
#include "scene/json.hpp"

namespace carom {

/// Throws an Error if this machine has no room for so many bodies, before it tries and is killed.
void require_memory_for(double bodies, const Place& place);
/// The same for a document of this size.
void require_memory_for_text(double bytes, const Place& place);

}  // namespace carom
