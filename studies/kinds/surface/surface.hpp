#pragma once
/// The surface of the probability of a limit state, from its realizations.

#include "io/store/result_store.hpp"
#include "studies/experiment/limit_state.hpp"

#include <vector>

namespace stylobate {

/// Counts realizations cell by cell; those that are invalid are no trials.
class SurfaceCounts {
public:
    SurfaceCounts(std::vector<double> frequency_hz, std::vector<double> pga_m_s2,
                  LimitState limit = LimitState::collapse);
    /// Of what has been counted; its probabilities are computed anew.
    explicit SurfaceCounts(const SurfaceTable& counted);
    void add(const ResultRow& row);
    /// Probability and Jeffreys interval of every cell.
    SurfaceTable table() const;

private:
    SurfaceTable table_;
    LimitState limit_ = LimitState::collapse;
};

/// The same from the counts of a study that keeps no rows.
SurfaceTable surface_of(const ResultHeader& header, const Tally& tally, LimitState limit);

} // namespace stylobate
