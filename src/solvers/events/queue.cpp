#include "solvers/events/queue.hpp"

#include <algorithm>

#include "math/pages.hpp"

namespace carom {

namespace {
constexpr double events_a_day = 8;
}  // namespace

void Calendar::fill(std::vector<GasEvent>& events, double now) {
    // Half of the discs have their event within the median time, and then another one soon. Some tell that of all.
    constexpr std::size_t some = 500;
    std::vector<double> due;
    for (std::size_t k = 0; k < events.size(); k += 1 + events.size() / some)
        if (events[k].due < gas_never) due.push_back(events[k].due);
    double page = 1;
    if (!due.empty()) {
        std::nth_element(due.begin(), due.begin() + static_cast<std::ptrdiff_t>(due.size() / 2), due.end());
        page = due[due.size() / 2] - now;
    }
    first_head_ = static_cast<Slot>(events.size());
    const std::size_t days = 64 + events.size() / 4, links = events.size() + days + 1;
    days_ = static_cast<std::int64_t>(days);
    reserve_large(link_, links);
    link_.resize(links);
    per_day_ = page > 0 ? static_cast<double>(events.size()) / events_a_day / page : 1;
    if (!(per_day_ < gas_never)) per_day_ = 1;
    begins_ = now;
    link_all(events);
}

void Calendar::link_all(const std::vector<GasEvent>& events) {
    for (Slot head = first_head_; head < link_.size(); ++head) link_[head] = {head, head};
    day_.clear();
    at_ = taken_ = 0, tomorrow_ = 0;
    scout_day(0);
    for (Slot slot = 0; slot < events.size(); ++slot) link(events, slot);
}

/// The next day with events; false if nothing will ever happen.
bool Calendar::begin_day(const std::vector<GasEvent>& events) {
    const auto empty = [this](std::int64_t day) {
        const Slot head = first_head_ + static_cast<Slot>(day);
        return link_[head].next == head;
    };
    for (;;) {
        while (tomorrow_ < days_ && empty(tomorrow_)) ++tomorrow_;
        if (tomorrow_ < days_) break;
        if (at_ < day_.size()) return false;  // to turn a page takes long where many events never come
        if (!turn_page(events)) return false;
    }
    const Slot head = first_head_ + static_cast<Slot>(tomorrow_++);
    unordered_.clear();
    for (Slot slot = link_[head].next; slot != head;) {
        unordered_.push_back({events[slot].due, slot, events[slot].row});
        const Slot after = link_[slot].next;
        link_[slot] = {slot, slot};
        slot = after;
    }
    link_[head] = {head, head};
    taken_ += unordered_.size();
    append_in_order();
    return true;
}

/// By counting who is before whom, for that is not to be guessed.
void Calendar::append_in_order() {
    constexpr std::size_t many = 48;
    day_.erase(day_.begin(), day_.begin() + static_cast<std::ptrdiff_t>(at_));
    at_ = 0;
    const std::size_t n = unordered_.size(), left = day_.size();
    day_.resize(left + n);
    if (n > many) {
        std::stable_sort(unordered_.begin(), unordered_.end(), before);
        std::copy(unordered_.begin(), unordered_.end(), day_.begin() + static_cast<std::ptrdiff_t>(left));
        return;
    }
    place_.assign(n, 0);
    for (std::size_t b = 1; b < n; ++b)
        for (std::size_t a = 0; a < b; ++a) {
            const bool first = before(unordered_[a], unordered_[b]);
            place_[a] += !first;
            place_[b] += first;
        }
    for (std::size_t k = 0; k < n; ++k) day_[left + place_[k]] = unordered_[k];
}

void Calendar::insert_today(const std::vector<GasEvent>& events, Slot slot) {
    constexpr std::size_t many = 1000;  // in no time, perhaps: what is over is forgotten
    if (at_ > many) {
        day_.erase(day_.begin(), day_.begin() + static_cast<std::ptrdiff_t>(at_));
        at_ = 0;
    }
    link_[slot] = {slot, slot};
    const Entry entry{events[slot].due, slot, events[slot].row};
    const auto rest = day_.begin() + static_cast<std::ptrdiff_t>(at_);
    day_.insert(std::upper_bound(rest, day_.end(), entry, before), entry);
}

void Calendar::take_from_today(Slot slot) {
    day_.erase(std::find_if(day_.begin() + static_cast<std::ptrdiff_t>(at_), day_.end(),
                            [slot](const Entry& entry) { return entry.slot == slot; }));
}

/// The first day again, at the earliest event of those that were put off; false if nothing will ever happen.
bool Calendar::turn_page(const std::vector<GasEvent>& events) {
    const Slot later = first_head_ + static_cast<Slot>(days_);
    double first = gas_never;
    for (Slot slot = link_[later].next; slot != later; slot = link_[slot].next)
        first = std::min(first, events[slot].due);
    if (first == gas_never) return false;
    // Only how fast the queue is depends on the length of a day.
    const double wanted = events_a_day * static_cast<double>(days_), found = static_cast<double>(taken_) + 1;
    if (found > 2 * wanted || found < 0.5 * wanted) per_day_ *= std::clamp(found / wanted, 0.25, 4.0);
    begins_ = first;
    tomorrow_ = 0, taken_ = 0;
    scout_day(0);
    Slot slot = link_[later].next;
    link_[later] = {later, later};
    while (slot != later) {
        const Slot after = link_[slot].next;
        link(events, slot);
        slot = after;
    }
    return true;
}

void Calendar::shift(const std::vector<GasEvent>& events, double by) {
    // Anew, for the day of an event must not depend on when it was put there.
    begins_ -= by;
    const std::size_t taken = taken_;
    link_all(events);
    taken_ = taken;
}

void SortedQueue::fill(std::vector<GasEvent>& events, double) {
    sorted_.clear();
    for (Slot slot = 0; slot < events.size(); ++slot)
        if (events[slot].due < gas_never) sorted_.insert({events[slot].due, events[slot].row, slot});
}

void SortedQueue::change(std::vector<GasEvent>& events, Slot slot, double due) {
    GasEvent& event = events[slot];
    sorted_.erase({event.due, event.row, slot});
    event.due = due;
    if (due < gas_never) sorted_.insert({due, event.row, slot});
}

void SortedQueue::shift(std::vector<GasEvent>& events, double) { fill(events, 0); }

}  // namespace carom
