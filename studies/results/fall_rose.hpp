#pragma once
/// The directions in which realizations of structures in space fell.

#include "ensemble/model/outcome.hpp"
#include "studies/report/html.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// Falls by direction: sectors of equal angles, the first one about x, the others from there towards z.
class FallRose {
public:
    static constexpr std::size_t sectors = 16;

    /// Counts the fall of an outcome that has one.
    void add(const Outcome& outcome);

    const std::vector<std::uint64_t>& counts() const { return counts_; }
    std::uint64_t falls() const { return falls_; }
    /// Length of the mean of the unit vectors: 1 where all fell in one direction, near 0 where none prevails.
    double resultant() const;
    /// Direction of that mean, from x towards z [degrees in (-180, 180]].
    double mean_deg() const;

    /// As the page's script draws it (page/rose.js): from above, x to the right, z downwards; areas are as the counts.
    Html svg(const std::string& title) const;
    /// What the figure shows, with mean and resultant.
    std::string caption() const;

private:
    std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(sectors, 0);
    std::uint64_t falls_ = 0;
    double x_ = 0, z_ = 0; ///< sum of the unit vectors
};

} // namespace stylobate
