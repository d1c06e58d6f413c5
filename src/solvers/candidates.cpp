// Which pieces may meet: whose boxes are near one another, and of those who move towards one another.

#include "solvers/candidates.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/mechanism.hpp"
#include "solvers/shared.hpp"

namespace carom {

void bound_piece(const SoftScene& scene, std::uint32_t i, SoftContacts& contacts) {
    PieceTable& pieces = contacts.pieces;
    const Piece& piece = scene.pieces[i];
    const Frame& frame = contacts.motion.frames[piece.row];
    make_at(pieces.placed[i], [&] { return Placed(piece.outline, frame, {}); });
    const Aabb& box = pieces.boxes[i] = bounds(pieces.placed[i], frame.position);
    pieces.sizes[i] = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
}

Aabb with_room(const PieceTable& pieces, const Outlook& outlook, std::size_t piece, double more) {
    const PieceTag& tag = pieces.tags[piece];
    const double way = outlook.reach[tag.row] + (tag.moves ? outlook.thrown : 0);
    const double room = way + speculation * pieces.sizes[piece] + more;
    const Aabb& box = pieces.boxes[piece];
    return {{box.low.x - room, box.low.y - room}, {box.high.x + room, box.high.y + room}};
}

PieceTag::PieceTag(const Piece& piece, const Bodies& bodies)
    : row(piece.row),
      number(piece.number),
      id(bodies.id[row]),
      filter(piece.filter),
      is_sensor(piece.sensor),
      moves(bodies.inverse_mass[row] != 0),
      is_single(piece.outline.count == 1),
      is_of_chain(piece.outline.one_sided),
      shape(piece.shape),
      restitution(piece.restitution),
      thickness(carom::thickness(piece.outline)),
      friction(piece.friction),
      rolling_resistance(piece.rolling_resistance),
      surface_speed(piece.surface_speed),
      radius(piece.outline.radius) {}

namespace {

/// Whether two pieces can meet at all, as they are.
bool can_meet(const SoftScene& scene, BoxPair pair, const PieceTable& pieces) {
    const PieceTag &a = pieces.tags[pair.a], &b = pieces.tags[pair.b];
    if (a.row == b.row || a.is_sensor || b.is_sensor || !may_meet(a.filter, b.filter)) return false;
    const bool is_thick = std::min(a.thickness, b.thickness) < HUGE_VAL;  // points and lines pass through one another
    if (!is_thick || (!a.moves && !b.moves)) return false;
    return !scene.mechanisms.apart.contains(a.row, b.row);
}

Candidate candidate_of(BoxPair pair, const PieceTable& pieces) {
    const PieceTag* a = &pieces.tags[pair.a];
    const PieceTag* b = &pieces.tags[pair.b];
    if (b->id.index < a->id.index) std::swap(a, b), std::swap(pair.a, pair.b);
    return {{a->id, b->id, a->number, b->number}, pair.a, pair.b};
}

}  // namespace

void add_pair(const SoftScene& scene, BoxPair pair, SoftContacts& contacts) {
    if (can_meet(scene, pair, contacts.pieces))
        contacts.search.candidates.push_back(candidate_of(pair, contacts.pieces));
}

void add_wall(std::uint32_t wall, std::uint32_t piece, SoftContacts& contacts) {
    const PieceTag& b = contacts.pieces.tags[piece];
    if (b.is_sensor || !b.moves) return;
    contacts.search.candidates.push_back({{{wall, 0}, b.id, 0, b.number}, wall, piece});
}

namespace {

constexpr std::size_t at_once = 256;  // pieces or pairs that are worth sharing

/// All pieces that may not be as the last search left them.
class PiecesLookedAt {
  public:
    PiecesLookedAt(const SoftScene& scene, const Rest& rest)
        : listed_(rest.is_known ? &rest.awake_pieces : nullptr),
          size_(listed_ ? listed_->size() : scene.pieces.size()) {}
    std::size_t size() const { return size_; }
    std::uint32_t operator[](std::size_t k) const { return listed_ ? (*listed_)[k] : static_cast<std::uint32_t>(k); }
    template <class Act>
    void each(const Act& act) const {
        for (std::size_t k = 0; k < size_; ++k) act((*this)[k]);
    }

  private:
    const std::vector<std::uint32_t>* listed_;
    std::size_t size_;
};

/// Whether the rooms of all but the pieces that are awake are as the last search left them, and are wide enough.
bool knows_rooms(const SoftContacts& contacts, double time) {
    return contacts.rest.is_known && contacts.search.left_out && time <= contacts.search.rest_ahead;
}
bool knows_rooms(const SoftContacts& contacts) {
    return knows_rooms(contacts, contacts.outlook.ahead) && contacts.outlook.thrown <= contacts.search.rest_thrown;
}

/// For how long to look ahead: to the end of a step, in dt [s]; or where all move fast, on average, for two substeps of
/// h, or for one. Pairs grow in number with the square of how far all may get, and who is struck in a crowd that is so
/// fast has to be looked for anew before the step is over all the same.
double time_ahead(double dt, double h, const SoftContacts& contacts) {
    constexpr double far = 0.5, very_far = 2;  // of its size
    double reach = 0, size = contacts.rest.is_known ? contacts.rest.fixed_size : 0;
    contacts.rest.each_row_looked_at([&](std::size_t i) {
        if (contacts.pieces.extent[i] == 0 || contacts.rest.asleep[i]) return;
        reach += contacts.outlook.reach[i];
        size += 2 * contacts.pieces.extent[i];
    });
    if (reach <= far * size) return dt;
    return std::min(dt, reach <= very_far * size ? 2 * h : h);
}

/// Notes what pieces are like, and how far bodies stretch.
void note_pieces(const SoftScene& scene, PieceTable& pieces) {
    pieces.placed.resize(scene.pieces.size()), pieces.boxes.resize(scene.pieces.size());
    pieces.sizes.resize(scene.pieces.size());
    pieces.tags.clear(), pieces.names.clear();
    reserve_large(pieces.tags, scene.pieces.size()), reserve_large(pieces.names, scene.pieces.size());
    pieces.extent.assign(scene.bodies.size() + 1, 0);
    pieces.extent.back() = HUGE_VAL;  // the ground's
    for (const Piece& piece : scene.pieces) {
        const PieceTag& tag = pieces.tags.emplace_back(piece, scene.bodies);
        pieces.names.push_back({tag.id.index, tag.number});
        if (piece.sensor) continue;  // it strikes nobody, however far it stretches
        double farthest = 0;
        for (int k = 0; k < piece.outline.count; ++k)
            farthest = std::max(farthest, dot(piece.outline.corner[k], piece.outline.corner[k]));
        const double extent = std::sqrt(farthest) + piece.outline.radius;
        pieces.extent[piece.row] = std::max(pieces.extent[piece.row], extent);
    }
}

/// Notes how far bodies may get in so much time [s].
void note_reach(const SoftScene& scene, const State& state, double time, SoftContacts& contacts) {
    const WayAhead way(scene, state, time);
    const auto note = [&](std::size_t row) { contacts.outlook.reach[row] = way.of(row, contacts.pieces.extent[row]); };
    if (knows_rooms(contacts, time)) return contacts.rest.each_row_looked_at(note);
    for_each_rows(scene.threads, state.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) note(row);
    });
}

/// How far [m] anybody may be thrown in what is left of a substep of h [s] in which he is struck: by twice the speed of
/// the fastest, or 0 if nobody could be so far through another one that it matters.
double thrown_in(double h, const SoftContacts& contacts) {
    double reach = 0, thinnest = HUGE_VAL;
    contacts.rest.each_row_looked_at([&](std::size_t i) { reach = std::max(reach, contacts.outlook.reach[i]); });
    for (const PieceTag& tag : contacts.pieces.tags) thinnest = std::min(thinnest, tag.thickness);
    const double way = 2 * reach * h / contacts.outlook.ahead;
    return way > 0.25 * thinnest ? way : 0;
}

/// Notes how all bodies move, and for how long and how far to look.
void look_ahead(const SoftScene& scene, const State& state, double dt, double h, SoftContacts& contacts) {
    const Rest& rest = contacts.rest;
    Outlook& outlook = contacts.outlook;
    if (rest.is_known)
        take_moving(scene.threads, rest.moving, state, outlook.from);
    else
        outlook.from = state;
    note_reach(scene, state, dt, contacts);
    outlook.ahead = time_ahead(dt, h, contacts);
    if (outlook.ahead < dt) note_reach(scene, state, outlook.ahead, contacts);
    outlook.thrown = are_few(scene) ? thrown_in(h, contacts) : 0;
    if (!knows_rooms(contacts)) return outlook.leashes.assign(state.size() + 1, {});
    rest.each_row_looked_at([&](std::size_t row) { outlook.leashes[row] = {}; });
}

void add_pairs(const SoftScene& scene, bool again, SoftContacts& contacts) {
    PairSearch& search = contacts.search;
    Scratch<bool> movable(again ? 0 : scene.pieces.size());
    if (!again)
        PiecesLookedAt(scene, contacts.rest).each([&](std::uint32_t i) {
            movable[i] = contacts.rest.is_known || contacts.pieces.tags[i].moves;
        });
    const auto keep = [&](std::span<BoxPair> some) {
        const auto end =
            std::remove_if(some.begin(), some.end(), [&](BoxPair p) { return !can_meet(scene, p, contacts.pieces); });
        return static_cast<std::size_t>(end - some.begin());
    };
    const std::span names(contacts.pieces.names);
    const auto pairs =
        again ? search.sweep.pairs_again(search.rooms, contacts.rest.awake_pieces, scene.threads, keep, names)
              : search.sweep.pairs(search.rooms, movable, scene.threads, keep, names);
    const std::size_t walls = search.candidates.size();
    search.candidates.resize(walls + pairs.size());
    parallel_ranges(scene.threads, pairs.size(), at_once, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k)
            make_at(search.candidates[walls + k], [&] { return candidate_of(pairs[k], contacts.pieces); });
    });
}

bool comes_before(const Candidate& c, const Candidate& d) { return c.key < d.key; }

void add_walls(const SoftScene& scene, SoftContacts& contacts) {
    for (std::uint32_t w = 0; w < scene.walls.all.size(); ++w)
        PiecesLookedAt(scene, contacts.rest).each([&](std::uint32_t i) {
            if (apart(scene.walls.all[w], contacts.search.rooms[i]) <= 0) add_wall(w, i, contacts);
        });
    auto& found = contacts.search.candidates;
    if (!std::is_sorted(found.begin(), found.end(), comes_before))  // rows are not always in the order of indices
        std::sort(found.begin(), found.end(), comes_before);
}

/// Whether all pieces stay in the rooms for which pairs were looked for the last time.
bool are_known(const SoftScene& scene, const SoftContacts& contacts) {
    const PairSearch& search = contacts.search;
    if (!search.knows_pairs || search.left_out != contacts.rest.is_known) return false;
    const auto is_outside = [&](std::size_t i) {
        return !is_within(with_room(contacts.pieces, contacts.outlook, i), search.rooms[i]);
    };
    if (!knows_rooms(contacts)) return !is_any(scene.threads, scene.pieces.size(), is_outside);
    return !is_any(scene.threads, contacts.rest.awake_pieces.size(),
                   [&](std::size_t k) { return is_outside(contacts.rest.awake_pieces[k]); });
}

/// Puts those that were made candidates late among the others.
void take_in_late(PairSearch& search) {
    LargeArray<Candidate>& all = search.candidates;
    if (search.in_order == all.size()) return;
    const auto late = all.begin() + static_cast<std::ptrdiff_t>(search.in_order);
    std::sort(late, all.end(), comes_before);
    const Scratch<Candidate> early(all.begin(), late), others(late, all.end());
    std::merge(early.begin(), early.end(), others.begin(), others.end(), all.begin(), comes_before);
    search.in_order = all.size();
}

/// The pairs whose boxes meet or may soon, in the order of their keys. What it costs to look for them depends on how
/// long they last, and nothing else does: who is near enough is found without asking who else is a candidate. They are
/// taken to last until somebody has left a room twice in a row.
void look_for_pairs(const SoftScene& scene, SoftContacts& contacts) {
    PairSearch& search = contacts.search;
    const PieceTable& pieces = contacts.pieces;
    constexpr double ample = 0.1;  // of a piece's size
    constexpr int seldom = 16;
    const bool somebody_left = search.knows_pairs && search.left_out == contacts.rest.is_known;
    const bool lasts = search.lasts || ++search.vain == seldom;
    if (lasts) search.vain = 0;
    search.rooms.resize(pieces.boxes.size());
    const auto give_room = [&](std::size_t i) {
        const bool may_leave = lasts && pieces.tags[i].moves;
        search.rooms[i] = with_room(pieces, contacts.outlook, i, may_leave ? ample * pieces.sizes[i] : 0);
    };
    const bool again = knows_rooms(contacts);
    if (again) {
        for (const std::uint32_t i : contacts.rest.awake_pieces) give_room(i);
    } else {
        for (std::size_t i = 0; i < pieces.boxes.size(); ++i) give_room(i);
        search.rest_ahead = contacts.outlook.ahead, search.rest_thrown = contacts.outlook.thrown;
    }
    search.candidates.clear();
    add_walls(scene, contacts);
    add_pairs(scene, again, contacts);
    search.in_order = search.candidates.size();
    search.knows_pairs = true, search.left_out = contacts.rest.is_known, search.lasts = !somebody_left;
}

}  // namespace

std::span<const Near> find_candidates(const SoftScene& scene, const State& state, double dt, double h,
                                      SoftContacts& contacts) {
    PairSearch& search = contacts.search;
    const Timed timed(scene.profile, Work::pairs);
    if (!contacts.rest.is_known) {
        recall_resting(contacts);
        contacts.outlook.reach.assign(scene.bodies.size() + 1, 0);
        note_pieces(scene, contacts.pieces);
    }
    const PiecesLookedAt pieces(scene, contacts.rest);
    parallel_ranges(scene.threads, pieces.size(), at_once, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) bound_piece(scene, pieces[k], contacts);
    });
    look_ahead(scene, state, dt, h, contacts);
    if (are_known(scene, contacts))
        search.lasts = true;
    else
        look_for_pairs(scene, contacts);
    take_in_late(search);
    const Nearness nearness(scene, state, h, contacts);
    const std::size_t all = search.candidates.size();
    if (search.near.size() < all) search.near.resize(all);
    parallel_ranges(scene.threads, all, at_once, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k)
            make_at(search.near[k], [&] { return nearness.of(static_cast<std::uint32_t>(k)); });
    });
    contacts.outlook.passed_over.clear(scene.bodies.size());
    const std::span near(search.near.data(), all);
    const auto end = std::remove_if(near.begin(), near.end(), [&](const Near& one) {
        if (one.is_far) pass_over(one, contacts.outlook);
        return one.is_far;
    });
    return {near.begin(), end};
}

}  // namespace carom
