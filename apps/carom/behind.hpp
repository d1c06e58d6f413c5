#pragma once
#include <carom/carom.hpp>
#include <optional>

namespace carom::app {

/// A body that falls onto the back of a chain, for nothing else is under it.
struct FromBehind {
    BodyId body, chain;
};
/// The first one; nothing where other forces than gravity act, which may hold it.
std::optional<FromBehind> falls_from_behind(const World& world);

}  // namespace carom::app
