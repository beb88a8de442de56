#pragma once
/// A mean (a probability, a frequency) as a function of one to three numbers, from points that share their random
/// numbers.
///
/// At m points x_i of the unit cube, y_i is the mean over the same realizations. Then
///
///   y = p(x) + e,   e ~ N(0, S),   p ~ GP(mean, s2 k(x, x')),   k: Matern 5/2 with a length for each number
///
/// S is the covariance of the means over the realizations (`smoothed_noise`): common realizations make the errors of
/// neighbouring points nearly equal, and these errors then cancel in differences, which decide where p is smallest.
/// This is stochastic kriging with common random numbers: Ankenman, Nelson & Staum, "Stochastic kriging for simulation
/// metamodeling", Operations Research 58 (2010) 371; Chen, Ankenman & Nelson, "The effects of common random numbers on
/// stochastic kriging metamodels", ACM Transactions on Modeling and Computer Simulation 22 (2012) 7. The mean has a
/// flat prior; s and the lengths are averaged over a grid with the weights of their marginal likelihood, so that few
/// points do not look more certain than they are (own choice).

#include "ensemble/estimators/search/paired_noise.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace stylobate {

/// A place in the unit cube.
using SearchPlace = std::vector<double>;

/// The first points: the middle and both ends of one number, else a low-discrepancy sequence (Roberts' generalised
/// golden ratio).
std::vector<SearchPlace> first_places(std::size_t dimensions);
/// All places that are looked at: 201, 41 x 41 or 17 x 17 x 17.
std::vector<SearchPlace> candidate_places(std::size_t dimensions);

class ResponseSurface {
public:
    /// @pre at least two points, of one size
    ResponseSurface(std::vector<SearchPlace> points, PairedNoise noise);

    const std::vector<SearchPlace>& points() const { return points_; }
    const PairedNoise& noise() const { return noise_; }

    struct Value {
        double mean = 0, sd = 0;
    };
    std::vector<Value> values(const std::vector<SearchPlace>& places) const;
    Value at(const SearchPlace& place) const;
    /// p(place) - p(from) of each place.
    std::vector<Value> differences(const std::vector<SearchPlace>& places, const SearchPlace& from) const;
    /// p(a) - p(b).
    Value difference(const SearchPlace& a, const SearchPlace& b) const;

    /// Draws of p at all the places jointly, of all the models by their weights.
    /// @returns (number x places)
    std::vector<std::vector<double>> draws(const std::vector<SearchPlace>& places, std::size_t number,
                                           std::uint64_t seed) const;

private:
    struct Model;
    void fit(const PairedNoise& noise);
    /// Of p, or of its difference from a place.
    std::vector<Value> mixture(const std::vector<SearchPlace>& places, const SearchPlace* from) const;

    std::vector<SearchPlace> points_;
    PairedNoise noise_;
    std::shared_ptr<const std::vector<Model>> models_;
};

} // namespace stylobate
