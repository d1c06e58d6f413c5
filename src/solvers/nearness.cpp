// How near those come to one another whose boxes may meet, if they go on as they do.

#include <algorithm>
#include <cmath>

#include "solvers/candidates.hpp"
#include "solvers/impact.hpp"

namespace carom {

double apart(const Wall& wall, const Aabb& box) {
    const Vec2 nearest{wall.normal.x > 0 ? box.low.x : box.high.x, wall.normal.y > 0 ? box.low.y : box.high.y};
    return dot(wall.normal, nearest) - wall.offset;
}

double size_of(const Candidate& c, const PieceTable& pieces) {
    const double b = pieces.sizes[c.piece_b];
    return c.is_at_wall() ? b : std::min(b, pieces.sizes[c.piece_a]);
}

double spare_of(const Candidate& c, const PieceTable& pieces) { return speculation * size_of(c, pieces); }

Nearness::Nearness(const SoftScene& scene, const State& state, double h, const SoftContacts& contacts)
    : scene_(scene),
      state_(state),
      contacts_(contacts),
      foresight_(scene, contacts),
      gone_(state.time - contacts.outlook.from.time),
      h_(h),
      are_few_(are_few(scene)) {}

double Nearness::boxes_apart(const Candidate& c) const {
    const Aabb& b = contacts_.pieces.boxes[c.piece_b];
    if (c.is_at_wall()) return apart(scene_.walls.all[c.piece_a], b);
    const Aabb& a = contacts_.pieces.boxes[c.piece_a];
    return std::max({a.low.x - b.high.x, b.low.x - a.high.x, a.low.y - b.high.y, b.low.y - a.high.y});
}

Near Nearness::of(std::uint32_t index) const {
    const PieceTable& pieces = contacts_.pieces;
    const Candidate& candidate = contacts_.search.candidates[index];
    const PieceTag& b = pieces.tags[candidate.piece_b];
    const bool at_wall = candidate.is_at_wall();
    const auto row = at_wall ? static_cast<std::uint32_t>(state_.size()) : pieces.tags[candidate.piece_a].row;
    const double reach = foresight_.reach_ahead(row) + foresight_.reach_ahead(b.row);
    const double spare = spare_of(candidate, pieces);
    Near near{index, row, b.row, false, reach + spare, HUGE_VAL};
    const double apart = boxes_apart(candidate);
    near.is_far = apart > near.margin;
    if (near.is_far || are_few_) return near;  // who is out of reach need not be watched
    const double other =
        at_wall ? scene_.walls.all[candidate.piece_a].restitution : pieces.tags[candidate.piece_a].restitution;
    if (mixed_restitution(scene_.bodies, other, b.restitution) > bounces_little) return near;
    const Passing pair(contacts_, row, b.row);
    const double approach = foresight_.approach(pair, foresight_.at(pair.small, gone_),
                                                foresight_.at(pair.large, gone_), contacts_.outlook.ahead - gone_);
    const double jump = reach * h_ / contacts_.outlook.ahead - 0.25 * thickness(candidate, pieces);
    const double margin = std::max(approach + spare, jump);
    if (margin >= near.margin) return near;
    near.margin = margin, near.spare = std::max(margin, apart) - approach, near.span = pair.span();
    if (gone_ > 0)
        near.spare -= pair.most(foresight_.off_way(state_, pair.small, gone_, 0),
                                foresight_.off_way(state_, pair.large, gone_, 0));
    near.is_far = apart > margin;
    return near;
}

double thickness(const Candidate& c, const PieceTable& pieces) {
    const double b = pieces.tags[c.piece_b].thickness;
    return c.is_at_wall() ? b : std::min(b, pieces.tags[c.piece_a].thickness);
}

double closing_speed(const State& state, std::uint32_t a, std::uint32_t b, const SoftContacts& contacts) {
    const Passing pair(contacts, a, b);
    return pair.most(twist_of(state, pair.small), twist_of(state, pair.large));
}

}  // namespace carom
