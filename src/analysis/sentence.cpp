#include <fmt/format.h>

#include <algorithm>
#include <carom/convergence.hpp>

namespace carom {

namespace {

std::string growth_words(const Convergence& c) {
    return c.growth ? fmt::format(" errors grow e-fold every {:.2g} s", 1 / c.growth->rate) : "";
}

/// That an answer which does not change with the step is no answer for that.
std::string apart_words(const Convergence& c) {
    const auto apart = [](const Followed& f) { return f.apart && f.left_out.empty() && f.size > 0; };
    const bool any = apart(c.state) || std::any_of(c.quantities.begin(), c.quantities.end(), apart);
    return any ? " The runs agree with one another and not with the reference." : "";
}

/// What was asked for and cannot be judged, and why.
std::string left_out_words(const Convergence& c) {
    std::string out;
    for (const Followed& f : c.quantities)
        if (!f.left_out.empty()) out += fmt::format("{}{} {}", out.empty() ? "" : "; ", f.name, f.left_out);
    return out;
}

}  // namespace

std::string Convergence::sentence() const {
    if (trust == Trust::unjudged) return fmt::format("Not judged: {}.", left_out_words(*this));
    if (trust == Trust::trust)
        return growth ? fmt::format("Trust it: the error stays below {:.2g} for these {:.4g} s, though{}.", tolerance,
                                    duration, growth_words(*this))
                      : fmt::format("Trust it: the error stays below {:.2g} for these {:.4g} s.", tolerance, duration);
    if (trust == Trust::chaotic)
        return fmt::format(
            "Chaotic beyond t = {:.3g} s:{}, and {} there; this one holds until t = {:.3g} s.", horizon,
            growth_words(*this),
            growth->horizon <= horizon ? "no step can help" : "no step down to a thousandth of this one helps",
            good_until);
    const char* what = own_step ? "tolerance" : "dt";
    const char* unit = own_step ? "" : " s";
    const std::string until =
        by_ledger
            ? fmt::format("the method made or lost {:.2g} of the energies at play, and passes {:.2g} at t = {:.3g} s",
                          made_or_lost, tolerance, good_until)
            : fmt::format("the error passes {:.2g} at t = {:.3g} s", tolerance, good_until);
    if (!refined)
        return fmt::format("Refine it: {}, and {}.{}", until,
                           tried > 0 ? "of the steps tried none is fine enough"
                                     : "a step that might be fine enough would take too long to try",
                           apart_words(*this));
    return fmt::format("Refine it to {} = {:.4g}{}: {}; with that it {}.", what, *refined, unit, until,
                       refined_was_run ? "stayed below" : "should stay below, by the order measured") +
           apart_words(*this) + (growth ? fmt::format(" The motion is unstable:{}.", growth_words(*this)) : "");
}

}  // namespace carom
