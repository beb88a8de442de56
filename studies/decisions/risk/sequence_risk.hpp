#pragma once
/// Simulated years of earthquakes with the damage carried along, beside structures that meet each one as new, as plain
/// data.

#include "ensemble/estimators/fragility/limits.hpp"
#include "ensemble/model/fields.hpp"

#include <cstdint>
#include <string>

namespace stylobate {

/// A share or a difference with its interval.
struct SequenceNumber {
    double value = 0;
    Limits limits;
};

struct SequenceRisk {
    double years = 0;
    double level = 0.9;
    std::uint64_t histories = 0;
    double threshold = 0; ///< weaker earthquakes are left out
    std::string threshold_says;
    double events_a_year = 0;                  ///< of the hazard above the threshold
    std::uint64_t events = 0, most_events = 0; ///< in all histories; in one
    std::uint64_t with_two = 0;                ///< histories with two earthquakes or more: the others cannot differ
    std::uint64_t carried = 0, fresh = 0, both = 0; ///< histories with a fall
    std::uint64_t invalid = 0;                      ///< histories that are left out of the counts
    std::uint64_t runs = 0, steps = 0;              ///< what it took
    SequenceNumber carried_share, fresh_share;
    SequenceNumber difference;  ///< of the shares, paired
    SequenceNumber ratio;       ///< carried over fresh, paired
    SequenceNumber closed_form; ///< 1 - exp(-lambda years) of the fragility, which meets each earthquake as new
    /// The threshold's check: so many histories once more with weaker earthquakes too, and how many of them fell then
    /// and had not before, or the reverse: a history that differs early may end otherwise by chance.
    std::uint64_t checked = 0, then_fell = 0, then_stood = 0;
    double checked_threshold = 0;
    SequenceNumber check_difference; ///< of the share that has fallen, with weaker earthquakes minus without, paired
};

template <class F>
void visit_fields(std::type_identity<SequenceNumber>, F&& f)
{
    f("value", &SequenceNumber::value);
    f(
        "lower", [](auto& n) -> auto& { return n.limits.lower; });
    f(
        "upper", [](auto& n) -> auto& { return n.limits.upper; });
}

template <class F>
void visit_fields(std::type_identity<SequenceRisk>, F&& f)
{
    f("years", &SequenceRisk::years);
    f("level", &SequenceRisk::level);
    f("histories", &SequenceRisk::histories);
    f("threshold", &SequenceRisk::threshold);
    f("threshold_says", &SequenceRisk::threshold_says);
    f("events_1_year", &SequenceRisk::events_a_year);
    f("events", &SequenceRisk::events);
    f("most_events", &SequenceRisk::most_events);
    f("histories_with_two_events", &SequenceRisk::with_two);
    f("fallen_carried", &SequenceRisk::carried);
    f("fallen_fresh", &SequenceRisk::fresh);
    f("fallen_both", &SequenceRisk::both);
    f("invalid", &SequenceRisk::invalid);
    f("runs", &SequenceRisk::runs);
    f("steps", &SequenceRisk::steps);
    f("carried_share", &SequenceRisk::carried_share);
    f("fresh_share", &SequenceRisk::fresh_share);
    f("difference", &SequenceRisk::difference);
    f("ratio", &SequenceRisk::ratio);
    f("closed_form", &SequenceRisk::closed_form);
    f("checked", &SequenceRisk::checked);
    f("checked_threshold", &SequenceRisk::checked_threshold);
    f("then_fell", &SequenceRisk::then_fell);
    f("then_stood", &SequenceRisk::then_stood);
    f("check_difference", &SequenceRisk::check_difference);
}

} // namespace stylobate
