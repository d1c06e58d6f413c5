#pragma once
#include <carom/scene.hpp>

#include "scene/json.hpp"

namespace carom {

// What the range of no field says alone: an Error at its place in the scene.
void check(const Expectation& e, const Place& place);
void check(const Twin& t, const Place& place);
void check(const Picture& p, const Place& place);

}  // namespace carom
