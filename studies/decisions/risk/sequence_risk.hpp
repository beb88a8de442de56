#pragma once
/// Simulated years of earthquakes with the damage carried along, beside structures that meet each one as new, as plain
/// data.

#include "ensemble/estimators/fragility/limits.hpp"

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
    SequenceNumber difference; ///< of the shares, paired
    SequenceNumber ratio;      ///< carried over fresh, paired
    double closed_form = 0;    ///< 1 - exp(-lambda years) of the fragility, which meets each earthquake as new
    Limits closed_form_limits;
    /// The threshold's check: so many histories once more with weaker earthquakes too, and how many of them fell then
    /// and had not before, or the reverse: a history that differs early may end otherwise by chance.
    std::uint64_t checked = 0, then_fell = 0, then_stood = 0;
    double checked_threshold = 0;
    SequenceNumber check_difference; ///< of the share that has fallen, with weaker earthquakes minus without, paired
};

} // namespace stylobate
