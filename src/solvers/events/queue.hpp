#pragma once
// Which disc's event is next. Each disc has exactly one event, so that the queues hold slots.

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "simd/prefetch.hpp"
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
        while (day_.size() <= at_ + ahead_)
            if (!begin_day(events)) return at_ < day_.size() ? day_[at_].slot : no_slot;
        return day_[at_].slot;
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
    /// How many events after the next one are to be known, if the page has so many: days begin sooner for that.
    void look_ahead(std::size_t events) { ahead_ = events; }
    /// Goes ahead through the days that come, an event at a call or two, with whose slots it calls f; a ring's next
    /// link is asked for a call before it is needed.
    template <class F>
    void scout(F f) {
        constexpr std::int64_t far = 4;  // days
        if (scouted_ < tomorrow_ || scouted_ > tomorrow_ + far) scout_day(tomorrow_);
        for (int steps = scouted_ < tomorrow_ + 2 ? 2 : 1; steps > 0 && scouted_ < days_;) {
            const Slot next = link_[scout_].next;
            if (next < first_head_ && next != scout_) {
                prefetch(&link_[next]);
                f(scout_ = next);
                --steps;
            } else {
                if (scouted_ == tomorrow_ + far) return;
                scout_day(scouted_ + 1);
            }
        }
    }
    /// Asks for the link of an event, and, when that has come, for those on both sides of it.
    void fetch_link(Slot slot) const { prefetch(link_.data() + slot); }
    void fetch_ring(Slot slot) const { prefetch(&link_[link_[slot].next]), prefetch(&link_[link_[slot].previous]); }

  private:
    struct Link {
        Slot next, previous;
    };
    /// Events at the same instant are in the order of rows. Without a branch.
    static bool before(const Entry& a, const Entry& b) {
        return (a.due < b.due) | ((a.due == b.due) & (a.row < b.row));
    }

    void scout_day(std::int64_t day) { scouted_ = day, scout_ = first_head_ + static_cast<Slot>(day); }
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
    void append_in_order();
    bool turn_page(const std::vector<GasEvent>& events);

    /// Of each disc, with itself if its event is today; then the head of each day; the last is for later.
    std::vector<Link> link_;
    std::vector<Entry> day_, unordered_;  ///< today's events in their order
    std::vector<std::uint32_t> place_;    ///< for that order
    std::size_t at_ = 0, ahead_ = 0;      ///< which of them is next, and how many more have to be known
    Slot first_head_ = 0;
    std::int64_t days_ = 0, tomorrow_ = 0;
    double begins_ = 0;         ///< the first day [s]
    double per_day_ = 1;        ///< days a second
    std::size_t taken_ = 0;     ///< events since the first day
    Slot scout_ = 0;            ///< who goes ahead is at this link,
    std::int64_t scouted_ = 0;  ///< in this day
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
