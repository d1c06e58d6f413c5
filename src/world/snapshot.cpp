// A world's state as bytes.

#include "world/state.hpp"

namespace carom {

namespace {

// What a contact solver carries from step to step has to be saved; its grid and its candidates are made anew in each.
static_assert(sizeof(Contacts) == sizeof(Impacts) + sizeof(Grid) + sizeof(std::vector<std::uint32_t>),
              "is the new member of Contacts storage, or must it be saved?");
static_assert(std::is_trivially_copyable_v<Impacts> && std::is_trivially_copyable_v<Energy>);

/// Bytes of another version, whose accounts are others, are told by their sizes.
constexpr std::uint64_t layout = sizeof(Powers) + 1000 * (sizeof(Impacts) + 1000 * (sizeof(Energy) + 1000));

}  // namespace

/// What changes while a world moves. What the scene or the user gave, and what is derived from it, stays out.
template <class S>
auto World::State::stored(S& world) {
    auto& [settings, bodies, motion, forces, rectangles, half_planes, periodic, time, steps, contacts, memory,
           holds_removed, edited, dynamics, walls, initial, before_edit] = world;
    using Accounts = std::conditional_t<std::is_const_v<S>, const Impacts, Impacts>;
    return std::tie(bodies, motion, time, steps, static_cast<Accounts&>(contacts), memory, initial);
}

void World::save(Saver& to) const {
    state_->settle();
    to(layout);
    std::apply(to, State::stored(std::as_const(*state_)));
}

void World::restore(Loader& from) {
    auto next = std::make_unique<State>(*state_);
    next->settle();
    std::uint64_t saved = 0;
    from(saved);
    if (saved != layout) throw Error("the state is that of another version of Carom");
    std::apply(from, State::stored(*next));
    next->bodies.check_members(next->motion);
    // The rest follows. Driven bodies are where they were, to the last bit, and not put there anew.
    next->holds_removed = true;
    next->derive();
    state_ = std::move(next);
}

}  // namespace carom
