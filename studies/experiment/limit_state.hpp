#pragma once
/// Limit states of a structure: which a realization has reached, and how often that happened.

#include "ensemble/model/fields.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/model/time_counts.hpp"
#include "io/store/result_store.hpp"
#include "studies/experiment/motions.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stylobate {

/// Confidence of the intervals of all probabilities.
inline constexpr double interval_level = 0.95;
/// "jeffreys 0.95", as results and pictures name it.
std::string interval_name();

enum class LimitState {
    collapse, ///< a block has fallen
    total,    ///< every column and every epistyle has fallen
    unseated, ///< an epistyle has lost a seat
    rocked,   ///< ended as `State::rocked`: without a fall, and more by rocking than by sliding
    slid,     ///< ended as `State::slid`: without a fall, and more by sliding than by rocking
    moving    ///< without a fall, and not at rest at the end (`Outcome::at_rest`): its residuals are not known
};

/// The words of the command line, in the order of the enumeration.
const std::vector<std::string>& limit_state_names();
/// @pre the name is one of them
LimitState limit_state_of(std::string_view name);
/// "collapse", "total collapse", ...: what the probability is one of.
const char* describe(LimitState limit);

/// Whether a valid realization reached it.
bool reached(LimitState limit, const Outcome& outcome);

/// What is counted of a realization where no row of it is kept; its limit states in the order of the enumeration.
TallyEntry tally_entry(const ResultRow& row);

/// How often, with its interval.
struct Share {
    std::uint64_t trials = 0;
    std::uint64_t count = 0;
    double probability = 0; ///< NaN without trials
    double lower = 0;       ///< Jeffreys' interval, or that of the motions; NaN: there is none
    double upper = 1;
};
template <class F>
void visit_fields(std::type_identity<Share>, F&& f)
{
    f("trials", &Share::trials);
    f("count", &Share::count);
    f("probability", &Share::probability);
    f("lower", &Share::lower);
    f("upper", &Share::upper);
}
Share share_of(std::uint64_t trials, std::uint64_t count);

/// Counts the outcomes of the realizations of a study; those that are invalid are no trials.
class LimitCounts {
public:
    /// @param motions of a fragility study, whose runs under one ground motion are not independent
    explicit LimitCounts(std::size_t blocks, MotionGroups motions = {})
        : groups_(std::move(motions)), first_(blocks), fallen_(blocks)
    {
    }
    /// Over all cells.
    explicit LimitCounts(const Tally& tally);
    void add(const ResultRow& row);

    Share share(LimitState limit) const;
    /// That a block was the first to fall, by itself.
    Share share_first(std::size_t block) const;
    /// That several were, at the same step.
    Share share_first_together() const;
    /// That a block fell at all, of rows.
    Share share_fallen(std::size_t block) const;
    /// Name of the intervals of these shares: "jeffreys 0.95", or "motions 0.95"; "none" of fewer than 8 motions, whose
    /// shares have no limits (NaN).
    std::string interval() const;
    /// How often each block fell before all others. (blocks)
    const std::vector<std::uint64_t>& first() const { return first_; }
    /// How often several blocks fell before all others, at the same step.
    std::uint64_t first_together() const { return first_together_; }
    std::uint64_t trials() const { return trials_; }
    /// "12 of 34 realizations without collapse still moved at the end."; nullopt where none did.
    std::optional<std::string> moving_text() const;
    /// Median over the realizations that collapsed [s]; NaN if there is none. (As exact as `TimeCounts`.)
    double median_collapse_time_s() const;
    /// Median over those that collapsed in all [s]; NaN if there is none.
    double median_total_collapse_time_s() const;

private:
    /// Outcomes of the runs under one motion.
    struct OfMotion {
        std::uint64_t trials = 0;
        std::vector<std::uint64_t> reached, first, fallen;
        std::uint64_t first_together = 0;
    };
    OfMotion& of_motion(std::size_t motion);
    Share share(std::uint64_t count, const std::function<std::uint64_t(const OfMotion&)>& of_motion) const;

    MotionGroups groups_;
    std::vector<OfMotion> motions_;
    std::uint64_t trials_ = 0;
    std::vector<std::uint64_t> reached_ = std::vector<std::uint64_t>(limit_state_names().size());
    std::vector<std::uint64_t> first_, fallen_;
    std::uint64_t first_together_ = 0;
    TimeCounts collapse_time_s_, total_collapse_time_s_;
};

} // namespace stylobate
