#pragma once
/// The realizations of one variant: what happened to each, cell by cell; numbers with intervals from them; and the
/// runs, each variant into a result file of its own, so that an interrupted run of all claims goes on where it stopped.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/store/result_store.hpp"
#include "studies/evidence/claims/claim.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::claims {

/// One realization.
struct Observation {
    std::uint64_t index = 0; ///< of the realization
    bool rocked = false, slid = false, collapsed = false;
    /// Cycles from the start of the strong shaking to the collapse; NaN without one. Strong shaking starts where a
    /// harmonic motion's smooth start ends, at once where the start is abrupt and in a half or full sine, and in all
    /// other motions (records, tables, noise, wavelets, tapered ones, sweeps) where they first reach half their PGA.
    double cycles_to_collapse = 0;
    std::array<double, amount_count> amount{}; ///< by `Amount`; NaN where it means nothing

    bool has(Event event, double within_cycles = 0) const;
};

/// One variant. Cells as in `SurfaceTable`: frequency by frequency. A study without a surface has one cell.
struct Sample {
    Levels levels;
    double f1_hz = 0; ///< first natural frequency of the nominal structure, all contacts full
    double rigid_m_s2 =
        0; ///< acceleration from which the nominal column would rock as one rigid body; NaN for a colonnade
    std::vector<double> frequency_hz;            ///< (nf)
    std::vector<double> pga_m_s2;                ///< (np)
    std::vector<std::vector<Observation>> cells; ///< (nf x np) valid realizations
    std::uint64_t invalid = 0;
    std::string version;                ///< of the code that computed it
    std::optional<std::string> why_not; ///< why it was not run; nullopt if it was

    const std::vector<Observation>& cell(std::size_t f, std::size_t p) const { return cells[f * pga_m_s2.size() + p]; }
};

/// @param record as in `run_ensemble`
/// @param path_needed whether the ratios of paths are asked for (the path of the base is then followed)
Observation observe(const Study& study, const Realization& realization, const Motion* record, const Outcome& outcome,
                    bool path_needed);

/// A number that lies between `lower` and `upper` with the confidence asked for.
struct Estimate {
    double value = 0;
    double lower = 0;
    double upper = 0;
    std::size_t realizations = 0; ///< that it rests on

    bool known() const { return realizations > 0; }
    /// Certainly below another one.
    bool below(const Estimate& other) const
    {
        return known() && other.known() && upper <= other.lower && value < other.value;
    }
};

/// Of an event in a cell, with Jeffreys' interval. Unknown if nothing of what was `given` happened.
Estimate probability(const std::vector<Observation>& cell, const Measure& measure, double level);

/// min(p, 1 - p) of that, with the interval that follows.
Estimate minority(const std::vector<Observation>& cell, const Measure& measure, double level);

/// Of an amount in a cell. The interval runs from the k-th smallest to the k-th largest value with the largest k at
/// which it covers the median of any distribution with the level: the chance that the median lies below the k-th
/// smallest of n is the chance of fewer than k heads in n throws of a coin. Unknown where n is too small for k = 1.
Estimate median(const std::vector<Observation>& cell, const Measure& measure, double level);

/// The lowest PGA at which the probability of an event crosses 1/2, at one frequency.
///
/// The value is interpolated in the logarithm of the PGA; it is infinite where no PGA of the axis is enough, and the
/// first PGA where that is enough already. The interval ends at values of the axis: below `lower` (0 if there is none)
/// every probability is certainly below 1/2, and at `upper` (infinite if there is none) it is certainly above. So it
/// is never finer than the axis, whatever the shape of the curve between its values.
Estimate onset(const Sample& sample, std::size_t frequency, const Measure& measure, double level);

/// Any of the three; for an onset `pga` is not used.
Estimate estimate(const Sample& sample, std::size_t frequency, std::size_t pga, const Measure& measure, double level);

/// "1.82 [1.71, 2.03] m/s²"; "above 12 m/s²" and so on for an onset beyond its axis. Lengths in mm.
std::string number_text(const Measure& measure, const Estimate& e);

struct RunPlace {
    std::filesystem::path results;  ///< folder of the result files
    std::filesystem::path data;     ///< folder that the claim files' records are relative to
    std::uint64_t realizations = 0; ///< instead of the study's; 0: the study's
    /// Told of each variant that is about to be computed; may be empty.
    std::function<void(const Levels&)> begins = {};
};

/// One sample for each variant, in the order of `variants(file.axes)`. A complete result file of the same study is
/// read, not computed again; an unfinished one of the same study and the same code goes on; any other is replaced.
/// A variant whose record is absent has no realizations and the reason in `why_not`.
///
/// @return fewer samples than variants if the observer asked to stop
/// @throws InputError for whatever is wrong with the study or a level's settings
std::vector<Sample> run_variants(const ClaimFile& file, const RunPlace& place, const RunOptions& options,
                                 Observer& observer);

} // namespace stylobate::claims
