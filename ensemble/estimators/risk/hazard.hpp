#pragma once
/// The seismic hazard of a site as plain data: how often an intensity of shaking is exceeded.

#include <string>
#include <vector>

namespace stylobate {

/// The hazard curve of one probability of what is not known of the hazard: with this probability the true frequency is
/// below it.
struct HazardFractile {
    double probability = 0.5;
    std::vector<double> frequency; ///< (n) of exceedance [1/year], not increasing, > 0
};

/// Frequencies of exceedance at intensities. Between two of them the curve is a power law (linear in the logarithms of
/// both), and so beyond the first and the last one.
struct HazardModel {
    std::string source;                    ///< file, or the power law as it was given
    std::string site;                      ///< of several in the file; empty: there is but one
    std::string measure;                   ///< with its SI unit, as of a fragility study: "pga_m_s2", "sa_1s_m_s2"
    std::vector<double> intensity;         ///< (n >= 2) ascending, > 0
    std::vector<double> frequency;         ///< (n) best estimate (usually the mean) of that of exceedance [1/year]
    std::vector<HazardFractile> fractiles; ///< by ascending probability; empty: its uncertainty is not known
    bool unbounded = false;                ///< a power law at all intensities: it has no range
    std::vector<std::string> says;         ///< notes for the user on how it was read
};

} // namespace stylobate
