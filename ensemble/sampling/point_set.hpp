#pragma once
/// The uniform numbers of a study's realizations: independent ones, or scrambled Sobol points.
///
/// With `sampling = "sobol"` realization k of a cell takes point k of Sobol's sequence (Sobol, "On the distribution of
/// points in a cube and the approximate evaluation of integrals", USSR Computational Mathematics and Mathematical
/// Physics 7 (1967) 86), with one dimension for each number that is drawn. The points are scrambled by nested random
/// permutations (Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", in "Monte Carlo and Quasi-Monte Carlo
/// Methods in Scientific Computing" (1995) 299): digit d of a coordinate is flipped by a random bit that belongs to the
/// digits before it. Every number is then exactly uniform, so the share that collapses is unbiased; among the first 2^m
/// realizations of a cell each of 2^m equal parts of every number's range is sampled once; and cells, whose scrambles
/// are independent of each other, stay independent. The variance due to single numbers decreases; that due to chaos
/// does not. Binomial intervals are therefore usually conservative. For nets with t = 0 the variance of a scrambled net
/// is at most e = 2.7 times the independent one, and far below it for smooth functions (Owen, "Scrambled net variance
/// for integrals of smooth functions", Annals of Statistics 25 (1997) 1541). For Sobol points in many dimensions, whose
/// t is larger, the bound is larger too; docs/adaptive.md has the measured variance.
///
/// Beyond as many digits as distinguish the points of a cell, the digits of scrambled points are independent and
/// uniform, and are drawn as such. Direction numbers are those of Boost (Joe & Kuo, "Constructing Sobol sequences with
/// better two-dimensional projections", SIAM Journal on Scientific Computing 30 (2008) 2635). The numbers stay a pure
/// function of study, index, stream and element.
///
/// In a sensitivity study the numbers of a factor are those of its row's point A or B, depending on the realization's
/// point; for Morris' points A_k the factor's own numbers are half a range away from A's. All others are drawn once for
/// all points of a row (`FactorDesign::rest_index`). Sobol points are then the rows, with twice the dimensions: A's,
/// then B's.
///
/// Not offered: the same numbers in every cell (common random numbers). They reduce the variance of the difference of
/// two cells, not that of the probability of any; and correlated errors make pooling with neighbours less informative.

#include "ensemble/model/study.hpp"
#include "ensemble/numerics/random.hpp"

#include <cstdint>
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
        int factor = -1; ///< its number in the design; -1: it is none
    };

    PointSet() = default;
    /// @param places the numbers of a realization, the most important ones first: the first dimensions are the best
    /// @param study must outlive it
    PointSet(const Study& study, const std::vector<Place>& places);

    /// In the open interval (0, 1), as `uniform01`. The index is that of a realization; realizations that share the
    /// object of the number (`StudyDesign`) have the same one. A place that was not named is independent in any case.
    double uniform(std::uint64_t index, Stream stream, std::uint64_t element) const;

    /// How many numbers a realization has, of a study whose realizations are given by their numbers.
    std::size_t size() const { return dimension_.size(); }
    /// Of such a study: one realization's numbers, in the order of the places.
    PointSet given(std::span<const double> numbers) const;

private:
    /// Number `element` of a stream for realization, or row, `index`.
    double point(std::uint64_t seed, std::uint64_t index, Stream stream, std::uint64_t element) const;
    static std::uint64_t key(Stream stream, std::uint64_t element)
    {
        return (static_cast<std::uint64_t>(stream) << 32) | element;
    }

    /// The index by which a realization draws.
    std::uint64_t drawn_as(std::uint64_t index, Stream stream) const;

    std::uint64_t seed_ = 0;
    std::uint64_t structure_seed_ = 0; ///< of what is not the motion's
    std::uint64_t per_cell_ = 1;       ///< realizations, or rows of points
    StudyDesign design_;
    std::unordered_map<std::uint64_t, std::uint64_t> factor_; ///< by key
    int digits_ = 0; ///< that distinguish the points of a cell; 0: all are independent
    std::unordered_map<std::uint64_t, std::uint64_t> dimension_; ///< by key
    std::span<const double> given_;                              ///< (dimensions), not kept
    std::vector<std::uint64_t> direction_; ///< (dimensions x digits), the first digit in the highest bit
};

} // namespace stylobate
