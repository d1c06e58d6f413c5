#pragma once
// Which contacts are solved, in which blocks, and which stages have a part for them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "math/pages.hpp"
#include "solvers/contact_rows.hpp"

namespace carom {

/// Between whom a contact is: what most passes over all of them ask for, side by side. The layout asks for no more.
struct ContactEnds {
    std::uint32_t a, b;       ///< rows of the movers
    std::uint16_t is_single;  ///< 1 if there is one point at most
    std::uint16_t pressed;    ///< 1 if it did before: see SoftContact::pressed()
    bool operator==(const ContactEnds&) const = default;
};

/// Which contacts were laid out, and in how much.
struct LaidOut {
    LargeArray<ContactEnds> contacts;
    std::size_t blocks = 0, colours = 0;
};

/// Notes a bit for a row of a block, if it is so.
inline void note_bit(std::uint8_t& bits, std::uint32_t row, bool is) {
    bits |= static_cast<std::uint8_t>(unsigned{is} << row);
}

/// What contacts have a part in, as bits.
struct Role {
    static constexpr std::uint8_t driven = 1, unturned = 2, changing = 4, strikes = 8, bounces = 16, corners = 32;
};

/// The contacts in the rows of a block.
using BlockContacts = std::array<std::uint32_t, block_rows>;
inline constexpr std::uint32_t no_contact = 0xffffffff;

/// In which blocks contacts are solved.
struct ContactLayout {
    struct Colour {
        std::size_t first, count;  ///< of the blocks
        bool alone;                ///< its contacts share bodies, and are solved one by one
    };
    struct Untouched {
        std::uint8_t now, before;  ///< bits of the rows not pressed yet in this step; of those nor before either
    };

    LargeArray<ContactBlock> blocks;
    LargeArray<BlockContacts> solved_in;  ///< by block
    std::vector<Untouched> untouched;     ///< by block
    std::vector<Colour> colours;
    std::size_t latecomers = 0;  ///< contacts from this one on were taken in, in no order
    LaidOut last;                ///< by the last search, if bodies are what they were
};

/// Which contacts have a part in some stages, by their numbers.
struct StageLists {
    std::vector<std::uint8_t> roles;      ///< of all, as they were laid out: see Role
    std::vector<std::uint32_t> driven;    ///< those with what moves along a curve or by itself
    std::vector<std::uint32_t> unturned;  ///< those with what nothing turns
    std::vector<std::uint32_t> changing;  ///< those that are looked at anew in every substep
    std::vector<std::uint32_t> strikers;  ///< those that may strike in this step
    std::vector<std::uint32_t> landing;   ///< those that are pressed for the first time in this substep
    bool any_bounce = false;              ///< some bounce that sweeps let bounce
    bool any_corners = false;             ///< of some it is two rounded corners that may touch
};

struct SoftContact;

/// The contacts of each body. A body's side of a contact is twice the contact's number, and 1 more for b: who goes from
/// one to the next does not ask the contacts themselves, which are large.
class ContactsOfBodies {
  public:
    /// None is in a list.
    void clear() { after_.clear(); }
    /// Puts those that are new into the lists of their bodies, of which there are so many.
    void list(std::span<const SoftContact> all, std::size_t bodies);
    /// Calls act(contact) for those of the body in a row, as they were listed, in order.
    template <class Act>
    void each(std::uint32_t row, const Act& act) const {
        for (std::uint32_t side = of_body_[row].first; side != no_contact; side = after_[side]) act(side / 2);
    }
    std::uint32_t count(std::uint32_t row) const { return of_body_[row].count; }

  private:
    struct List {
        std::uint32_t first, last, count;
    };
    std::vector<List> of_body_;         ///< the ends of each one's list; by row
    std::vector<std::uint32_t> after_;  ///< by side: the next one of the same body
};

}  // namespace carom
