#pragma once
// Corners past which a body goes, and which of them it can run into.

#include "solvers/soft_step.hpp"

namespace carom {

/// Two pieces that touch, or nearly do, whether or not they are a contact yet.
struct Encounter {
    std::uint32_t a, b;  ///< rows of the movers
    std::uint32_t piece_a, piece_b;
    bool at_wall;
    double radius_a, radius_b, size, least_thickness;
    const Manifold& manifold;

    explicit Encounter(const SoftContact& c)
        : a(c.a),
          b(c.b),
          piece_a(c.piece_a),
          piece_b(c.piece_b),
          at_wall(c.at_wall),
          radius_a(c.radius_a),
          radius_b(c.radius_b),
          size(c.size),
          least_thickness(c.least_thickness),
          manifold(c.manifold) {}
    Encounter(const Near& near, const Manifold& found, const SoftContacts& contacts)
        : a(near.a), b(near.b), manifold(found) {
        const Candidate& c = contacts.search.candidates[near.candidate];
        piece_a = c.piece_a, piece_b = c.piece_b, at_wall = c.is_at_wall();
        radius_a = at_wall ? 0 : contacts.pieces.tags[c.piece_a].radius,
        radius_b = contacts.pieces.tags[c.piece_b].radius;
        size = size_of(c, contacts.pieces), least_thickness = thickness(c, contacts.pieces);
    }
};

/// Whether the normal of two corners turns by more than a hair in dt [s], as they move now.
bool turns(const Encounter& c, const State& state, double dt);

/// Whether the two of a contact may pass far into one another in a substep of h [s].
bool is_fast(const State& state, double h, std::uint32_t a, std::uint32_t b, double thickness,
             const SoftContacts& contacts);

/// Takes out of those who touch, by their places among the near, the ones with corners, past which a body goes, that
/// lie in or below the plane of a side which it is on: that side keeps it off them. Else a body that has sunk in by a
/// hair would run into every seam of a floor. They are taken out before they are contacts, which are large.
void drop_covered(const SoftScene& scene, const State& state, double h, const SoftContacts& contacts,
                  Scratch<std::uint32_t>& touching);

/// Whether one of a pair is a piece of a chain.
inline bool is_at_chain(const Candidate& c, const PieceTable& pieces) {
    return pieces.tags[c.piece_b].is_of_chain || (!c.is_at_wall() && pieces.tags[c.piece_a].is_of_chain);
}
/// Whether who is over the neighbours of a piece of a chain, if he is, may come to it in a substep of h [s]; if not
/// that is asked again before the next one.
bool may_come(const SoftScene&, const State&, double h, const Near&, const Manifold&, const SoftContacts&);
/// Whether who is beside a piece of a chain, or whom a neighbour has, may come down on it in a substep of h [s] by more
/// than a hair, as he moves or in any direction after a blow; or is fast.
bool may_land_on(const SoftScene&, const State&, double h, const Near&, const SoftContacts&);
/// How a body passes a piece of a chain that it has come to from behind, where nothing is solid.
enum class FromBehind : std::uint8_t { no, now, until_out };
/// `until_out` once it was deeper in it than it can have come from the front, and else `now` if its middle has just
/// come across and it goes on. No contact holds the two meanwhile, unless one did before, or the body was put there.
FromBehind comes_from_behind(const SoftScene&, const State&, const Near&, const Manifold&, const SoftContacts&);

}  // namespace carom
