#include "collision/places.hpp"

namespace carom {

void Places::number(std::span<const Piece> pieces, std::size_t rows) {
    first_.resize(known_rows_ + 1);
    const std::uint32_t known = first_.back();
    std::erase_if(sensors_, [known](std::uint32_t k) { return k >= known; });
    for (std::uint32_t k = known; k < pieces.size(); ++k) {
        if (pieces[k].row + 1 > first_.size()) first_.push_back(k);
        if (pieces[k].sensor) sensors_.push_back(k);
    }
    first_.resize(rows), first_.push_back(static_cast<std::uint32_t>(pieces.size()));
}

void Places::follow(std::span<const Piece> pieces, const Motion& bodies) {
    const bool renewed = known_rows_ < frames_.size() || bodies.size() > frames_.size();
    if (renewed) number(pieces, bodies.size());
    frames_.resize(bodies.size()), angles_.resize(bodies.size()), blocks_[0].resize(pieces.size());
    moved_.clear();
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        const Vec2 at = bodies.linear[row];
        const double angle = bodies.angular[row];
        if (row < known_rows_ && frames_[row].position == at && angles_[row] == angle) continue;
        frames_[row] = frame_at(at, angle), angles_[row] = angle;
        for (std::uint32_t k = first_[row]; k < first_[row + 1]; ++k) {
            blocks_[0][k] = carom::bounds(pieces[k].outline, frames_[row]);
            moved_.push_back(k);
        }
    }
    if (renewed)
        bound_all();
    else
        bound_moved();
    known_rows_ = bodies.size(), fit_ = true;
}

void Places::bound(std::size_t level, std::size_t i) {
    const auto& parts = blocks_[level - 1];
    Aabb all = parts[block * i];
    for (std::size_t k = block * i + 1; k < std::min(block * (i + 1), parts.size()); ++k) all = hull(all, parts[k]);
    blocks_[level][i] = all;
}

void Places::bound_all() {
    blocks_.resize(1);
    while (blocks_.back().size() > block) {
        const std::size_t level = blocks_.size();
        blocks_.emplace_back((blocks_.back().size() + block - 1) / block);
        for (std::size_t i = 0; i < blocks_[level].size(); ++i) bound(level, i);
    }
}

/// Of those that moved, and then of their blocks.
void Places::bound_moved() {
    for (std::size_t level = 1; level < blocks_.size(); ++level) {
        for (std::uint32_t& k : moved_) k /= block;
        moved_.erase(std::unique(moved_.begin(), moved_.end()), moved_.end());
        for (const std::uint32_t i : moved_) bound(level, i);
    }
}

}  // namespace carom
