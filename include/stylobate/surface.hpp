#pragma once
/// The probability of a limit state over frequency and PGA, or in space over the direction of the shaking and PGA.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stylobate::api {

/// One cell of a surface.
struct Cell {
    double frequency_hz = 0;  ///< of a surface over frequency
    double direction_deg = 0; ///< of a surface over direction: from x towards z
    double pga_m_s2 = 0;
    std::uint64_t trials = 0;  ///< valid realizations
    std::uint64_t reached = 0; ///< those that reached the limit state
    double probability = 0;    ///< NaN without a trial
    double lower = 0;          ///< 95 % interval
    double upper = 1;
};

/// Each array over the cells is (rows x PGAs), row by row: that of row i and PGA j is at i * pga_m_s2.size() + j.
struct Surface {
    std::string limit_state;           ///< "collapse"
    std::string interval;              ///< name of the interval and its level: "jeffreys 0.95"
    std::vector<double> frequency_hz;  ///< of the rows; empty where they are directions
    std::vector<double> direction_deg; ///< of the rows; empty where they are frequencies
    std::vector<double> pga_m_s2;
    std::vector<std::uint64_t> trials;
    std::vector<std::uint64_t> reached;
    std::vector<double> probability; ///< of an adaptive surface whose cells borrow from each other a posterior mean
    std::vector<double> lower;
    std::vector<double> upper;

    const std::vector<double>& rows() const { return frequency_hz.empty() ? direction_deg : frequency_hz; }
    /// @throws std::out_of_range if there is no such cell
    Cell cell(std::size_t row, std::size_t pga) const;
};

} // namespace stylobate::api
