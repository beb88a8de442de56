#pragma once
/// The collapse-probability surface from its realizations.

#include "io/result_store.hpp"

#include <vector>

namespace stylobate {

/// Confidence of the intervals of a surface.
inline constexpr double surface_level = 0.95;

/// Counts realizations cell by cell; those that are invalid are no trials.
class SurfaceCounts {
public:
    SurfaceCounts(std::vector<double> frequency_hz, std::vector<double> pga_m_s2);
    void add(const ResultRow& row);
    /// Probability and Jeffreys interval of every cell.
    SurfaceTable table() const;

private:
    SurfaceTable table_;
};

} // namespace stylobate
