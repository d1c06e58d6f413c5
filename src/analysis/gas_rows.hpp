#pragma once
#include <carom/world.hpp>
#include <map>
#include <vector>

namespace carom {

/// The rows that the discs of a gas have now: when bodies come and go, others move. An Error if one of them went.
inline void find_rows(const World& world, const std::vector<BodyId>& discs, std::vector<std::size_t>& rows) {
    const auto ids = world.ids();
    std::map<std::uint32_t, std::size_t> row_of;  // by index, if one has moved
    for (std::size_t k = 0; k < discs.size(); ++k) {
        if (rows[k] < ids.size() && ids[rows[k]] == discs[k]) continue;
        if (!world.contains(discs[k]))
            throw Error("GasMeter: a disc that is measured was removed; a new meter measures those that are left");
        if (row_of.empty())
            for (std::size_t row = 0; row < ids.size(); ++row) row_of[ids[row].index] = row;
        rows[k] = row_of.at(discs[k].index);
    }
}

}  // namespace carom
