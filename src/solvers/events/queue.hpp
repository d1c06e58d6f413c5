#pragma once
// Which disc's event is next. Each disc has exactly one event, so that the queues hold slots.

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "solvers/events/disc.hpp"

namespace carom {

/// A calendar in constant time: a list for each of many days, and one for what lies beyond the last (R. Brown, Commun.
/// ACM 31, 1220 (1988); G. Paul, J. Comput. Phys. 221, 615 (2007), whose current day is a tree). When a day comes its
/// few events are put in order. The lists are rings through heads of their own, so that nothing is to be asked when an
/// event moves from one to another.
class Calendar {
  public:
    /// Makes the queue of these events, at a time before all of them.
    void fill(std::vector<GasEvent>& events, double now);
    /// The slot with the next event; no_slot if there is none.
    Slot next(const std::vector<GasEvent>& events) {
        for (;;) {
            if (at_ < day_.size()) return day_[at_].slot;
            if (!begin_day(events)) return no_slot;
        }
    }
    /// A disc has another event, not before that which is next.
    void change(std::vector<GasEvent>& events, Slot slot, double due) {
        if (at_ < day_.size() && day_[at_].slot == slot)
            ++at_;
        else if (link_[slot].next == slot)
            take_from_today(slot);
        else
            unlink(slot);
        events[slot].due = due;
        link(events, slot);
    }
    /// The events happen earlier by so much, as they say already.
    void shift(const std::vector<GasEvent>& events, double by);

    /// Of an event of today.
    struct Entry {
        double due;
        Slot slot;
        std::uint32_t row;
    };
    /// Today's events from the next one on, as far as they are known.
    std::span<const Entry> today() const { return std::span(day_).subspan(std::min(at_, day_.size())); }
    /// Which day that is.
    std::uint64_t day() const { return day_number_; }
    /// Calls f with the slot of each event of the day after it.
    template <class F>
    void for_tomorrow(F f) const {
        const Slot head = first_head_ + static_cast<Slot>(tomorrow_);
        if (tomorrow_ < days_)
            for (Slot slot = link_[head].next; slot != head; slot = link_[slot].next) f(slot);
    }

  private:
    struct Link {
        Slot next, previous;
    };
    /// Events at the same instant are in the order of rows. Without a branch.
    static bool before(const Entry& a, const Entry& b) {
        return (a.due < b.due) | ((a.due == b.due) & (a.row < b.row));
    }

    void link_all(const std::vector<GasEvent>& events);
    void link(const std::vector<GasEvent>& events, Slot slot) {
        const double day = (events[slot].due - begins_) * per_day_;
        // The comparison also sends an infinite day, and one too late for an index, beyond the last.
        const std::int64_t list =
            day < static_cast<double>(days_) ? static_cast<std::int64_t>(day > 0 ? day : 0) : days_;
        if (list < tomorrow_) return insert_today(events, slot);
        const Slot head = first_head_ + static_cast<Slot>(list), first = link_[head].next;
        link_[slot] = {first, head};
        link_[first].previous = slot;
        link_[head].next = slot;
    }
    void unlink(Slot slot) {
        const Link l = link_[slot];
        link_[l.previous].next = l.next;
        link_[l.next].previous = l.previous;
    }
    void insert_today(const std::vector<GasEvent>& events, Slot slot);
    void take_from_today(Slot slot);
    bool begin_day(const std::vector<GasEvent>& events);
    void put_in_order();
    bool turn_page(const std::vector<GasEvent>& events);

    /// Of each disc, with itself if its event is today; then the head of each day; the last is for later.
    std::vector<Link> link_;
    std::vector<Entry> day_, unordered_;  ///< today's events in their order
    std::vector<std::uint32_t> place_;    ///< for that order
    std::size_t at_ = 0;                  ///< which of them is next
    Slot first_head_ = 0;
    std::int64_t days_ = 0, tomorrow_ = 0;
    double begins_ = 0;             ///< the first day [s]
    double per_day_ = 1;            ///< days a second
    std::size_t taken_ = 0;         ///< events since the first day
    std::uint64_t day_number_ = 0;  ///< of today
};

/// The plain one that tests hold the calendar against.
class SortedQueue {
  public:
    void fill(std::vector<GasEvent>& events, double now);
    Slot next(const std::vector<GasEvent>&) const { return sorted_.empty() ? no_slot : std::get<2>(*sorted_.begin()); }
    void change(std::vector<GasEvent>& events, Slot slot, double due);
    void shift(std::vector<GasEvent>& events, double by);

  private:
    std::set<std::tuple<double, std::uint32_t, Slot>> sorted_;
};

}  // namespace carom
