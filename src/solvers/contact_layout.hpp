#pragma once
// Which contacts are solved, in which blocks, and which stages have a part for them.

#include <array>
#include <cstdint>

#include "solvers/contact_rows.hpp"
#include "state/pages.hpp"

namespace carom {

/// Between whom a contact is: what most passes over all of them ask for, side by side. The layout asks for no more.
struct ContactEnds {
    std::uint32_t a, b;       ///< rows of the movers
    std::uint16_t is_single;  ///< 1 if there is one point at most
    std::uint16_t pressed;    ///< 1 if it did before: see SoftContact::pressed()
    bool operator==(const ContactEnds&) const = default;
};

/// Which contacts were laid out, and in how much.
struct ContactLayout {
    LargeArray<ContactEnds> contacts;
    std::size_t blocks = 0, colours = 0;
};

/// Notes a bit for a row of a block, if it is so.
inline void note_bit(std::uint8_t& bits, std::uint32_t row, bool is) {
    bits |= static_cast<std::uint8_t>(unsigned{is} << row);
}

/// What contacts have a part in, as bits.
struct Role {
    static constexpr std::uint8_t driven = 1, unturned = 2, changing = 4, strikes = 8, bounces = 16;
};

/// The contacts in the rows of a block.
using BlockContacts = std::array<std::uint32_t, block_rows>;

}  // namespace carom
