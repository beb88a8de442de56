#pragma once
/// The realizations of one variant, digested: what happened to each, cell by cell.

#include "studies/evidence/claims/claim.hpp"

#include "ensemble/model/motion.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/store/result_store.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stylobate::claims {

/// One realization.
struct Observation {
    std::uint64_t index = 0; ///< of the realization
    bool rocked = false, slid = false, collapsed = false, unseated = false;
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
    std::string version; ///< of the code that computed it
    std::string why_not; ///< why it was not run; empty if it was

    const std::vector<Observation>& cell(std::size_t f, std::size_t p) const { return cells[f * pga_m_s2.size() + p]; }
};

/// @param record as in `run_ensemble`
/// @param path_needed whether the ratios of paths are asked for (the path of the base is then followed)
Observation observe(const Study& study, const Realization& realization, const Motion* record, const Outcome& outcome,
                    bool path_needed);

/// @pre the rows are of this study; invalid ones are counted and left out
Sample make_sample(const Study& study, const Sampler& sampler, const Motion* record, const std::vector<ResultRow>& rows,
                   bool path_needed);

} // namespace stylobate::claims
