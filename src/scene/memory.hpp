#pragma once
#include "scene/json.hpp"

namespace carom {

struct Amount {
    double bodies = 0, springs = 0;
    bool named = false;
};
/// Throws an Error if this machine has no room for so much, before it tries and is killed.
void require_memory_for(const Amount& amount, const Place& place);
/// The same for a document of this size.
void require_memory_for_text(double bytes, const Place& place);

}  // namespace carom
