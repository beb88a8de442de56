#pragma once
/// The uniform numbers of which a study's realizations are made: independent ones, or scrambled Sobol points.
///
/// With `sampling = "sobol"` realization k of a cell takes point k of Sobol's sequence, a dimension for each number
/// that is drawn, scrambled by Owen's nested random permutations: digit d of a coordinate is flipped by a random bit
/// that belongs to the digits before it. Every number is then exactly uniform, so the share that collapses has no bias;
/// among the first 2^m realizations of a cell each of 2^m equal parts of every number's range is taken once; and cells,
/// whose scrambles are independent of each other, stay independent. What the outcome owes to single numbers then varies
/// less from cell to cell; what is chaos stays. Binomial intervals are therefore too wide rather than too narrow: the
/// variance of a scrambled net is at most e = 2.7 times the independent one, and for what is smooth far below it
/// (Owen, Annals of Statistics 25 (1997) 1541); docs/adaptive.md has what was measured.
///
/// Beyond as many digits as tell the points of a cell apart, the digits of scrambled points are independent and
/// uniform, and are taken so. Direction numbers are those of Boost (Joe & Kuo 2008). The numbers stay a pure function
/// of study, index, stream and element.
///
/// In a sensitivity study the numbers of a factor are those of its row's point A or B, as the realization's point says;
/// of Morris' points A_k the factor's own are half a range away from A's. All else is drawn once for all points of a
/// row (`Study::rest_index`). Sobol points are then the rows, with twice the dimensions: A's, then B's.
///
/// Not offered: the same numbers in every cell (common random numbers). They make the difference of two cells better
/// known, not the probability of any; and neighbours whose errors go together have less to tell each other.

#include "ensemble/model/study.hpp"
#include "ensemble/numerics/random.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace stylobate {

class PointSet {
public:
    /// Where a number is used.
    struct Place {
        Stream stream;
        std::uint64_t element;
        int factor = -1; ///< of a sensitivity study: its number, -1: none
    };

    PointSet() = default;
    /// @param places the numbers of a realization, those first that matter most: the first dimensions are the best ones
    PointSet(const Study& study, const std::vector<Place>& places);

    /// In the open interval (0, 1), as `uniform01`: the index is that of a realization, and in a fragility study those
    /// that share what the number is for (`FragilitySpec`) have the same one. A place that was not named is independent
    /// in any case.
    double uniform(std::uint64_t index, Stream stream, std::uint64_t element) const;

    /// How many numbers a realization of a study of rare events has.
    std::size_t size() const { return dimension_.size(); }
    /// Of a study of rare events: one realization's numbers, in the order of the places.
    PointSet given(std::span<const double> numbers) const;

private:
    /// Number `element` of a stream for realization, or row, `index`.
    double point(std::uint64_t index, Stream stream, std::uint64_t element) const;
    static std::uint64_t key(Stream stream, std::uint64_t element)
    {
        return (static_cast<std::uint64_t>(stream) << 32) | element;
    }

    /// The index by which a realization draws.
    std::uint64_t drawn_as(std::uint64_t index, Stream stream) const;

    std::uint64_t seed_ = 0;
    std::uint64_t per_cell_ = 1;
    std::uint64_t stripes_ = 0; ///< of a fragility study, else 0
    std::uint64_t contacts_ = 1, twins_ = 1;
    std::optional<SensitivitySpec> design_;
    std::unordered_map<std::uint64_t, std::uint64_t> factor_; ///< by key
    int digits_ = 0; ///< that tell the points of a cell apart; 0: all are independent
    std::unordered_map<std::uint64_t, std::uint64_t> dimension_; ///< by key
    std::span<const double> given_;                              ///< (dimensions), not kept
    std::vector<std::uint64_t> direction_; ///< (dimensions x digits), the first digit in the highest bit
};

} // namespace stylobate
