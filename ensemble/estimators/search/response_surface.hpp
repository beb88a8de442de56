#pragma once
/// A probability as a function of one to three numbers, from points that share their random numbers.
///
/// At m points x_i of the unit cube, y_i is the share of the same realizations that reached the limit state. Then
///
///   y = p(x) + e,   e ~ N(0, S),   p ~ GP(mean, s2 k(x, x')),   k: Matern 5/2 with a length for each number
///
/// S is the covariance of the shares over the realizations (`PairedNoise`): common realizations make the errors of
/// neighbouring points nearly equal, and these errors then cancel in differences, which decide where the smallest
/// probability is. This is stochastic kriging with common random numbers: Ankenman, Nelson & Staum, "Stochastic kriging
/// for simulation metamodeling", Operations Research 58 (2010) 371; Chen, Ankenman & Nelson, "The effects of common
/// random numbers on stochastic kriging metamodels", ACM Transactions on Modeling and Computer Simulation 22 (2012) 7.
/// The mean has a flat prior; s and the lengths are averaged over a grid with the weights of their marginal likelihood,
/// so that few points do not look more certain than they are (own choice).
///
/// The next point is that of the largest expected improvement over the best point so far (Jones, Schonlau & Welch,
/// "Efficient global optimization of expensive black-box functions", Journal of Global Optimization 13 (1998) 455), by
/// the difference of the two, whose common error has cancelled.

#include <cstddef>
#include <memory>
#include <vector>

namespace stylobate {

/// A place in the unit cube.
using SearchPlace = std::vector<double>;

/// Shares at points, and the covariance of their errors.
struct PairedNoise {
    std::vector<double> share;      ///< (m)
    std::vector<double> covariance; ///< (m x m)
};

/// From sums by group: a realization, or the realizations of one motion; within strata (cells), whose means are no
/// error.
/// @param reached (groups x m) how many of a group's realizations reached the limit state at each point
/// @param size    (groups) realizations of each   @param stratum (groups)
/// Half a count is added to each variance, so that a share of 0 or 1 has an error too.
PairedNoise paired_noise(const std::vector<double>& reached, const std::vector<double>& size,
                         const std::vector<std::size_t>& stratum, std::size_t points);

class ResponseSurface {
public:
    /// @pre at least two points, of one size
    ResponseSurface(std::vector<SearchPlace> points, const PairedNoise& noise);

    struct Value {
        double mean = 0, sd = 0;
    };
    Value at(const SearchPlace& place) const;
    /// p(a) - p(b).
    Value difference(const SearchPlace& a, const SearchPlace& b) const;

private:
    struct Model;
    std::vector<SearchPlace> points_;
    std::shared_ptr<const std::vector<Model>> models_;
};

/// The first points: the middle and both ends of one number, else a low-discrepancy sequence (Roberts' generalised
/// golden ratio).
std::vector<SearchPlace> first_places(std::size_t dimensions);
/// All places that are looked at: 201, 41 x 41 or 17 x 17 x 17.
std::vector<SearchPlace> candidate_places(std::size_t dimensions);

/// Where p is smallest among the candidates.
struct SearchAnswer {
    SearchPlace best;
    ResponseSurface::Value value;
    std::vector<SearchPlace> flat; ///< candidates whose p is not shown to be larger, at the level
};
SearchAnswer search_answer(const ResponseSurface& surface, const std::vector<SearchPlace>& candidates, double level);

/// The next point, and the improvement that is expected of it.
struct NextPlace {
    SearchPlace place;
    double improvement = 0;
};
/// @param points that have been run: none of them is asked for again
NextPlace next_place(const ResponseSurface& surface, const std::vector<SearchPlace>& candidates,
                     const std::vector<SearchPlace>& points);

} // namespace stylobate
