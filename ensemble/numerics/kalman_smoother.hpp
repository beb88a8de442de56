#pragma once
/// Kalman's filter (Kalman, "A new approach to linear filtering and prediction problems", Journal of Basic Engineering
/// 82 (1960) 35) and the smoother of Rauch, Tung and Striebel ("Maximum likelihood estimates of linear dynamic
/// systems", AIAA Journal 3 (1965) 1445) for the history of a point whose acceleration is linear between equally spaced
/// times, from values of several sources; two of them may have a constant offset each. The smoother has the form of
/// Bryson and Frazier, which inverts no matrix (de Jong, "Smoothing and interpolation with the state-space model",
/// Journal of the American Statistical Association 84 (1989) 1085).

#include <array>
#include <cstddef>
#include <vector>

namespace stylobate::kalman {

/// The state: displacement, velocity, acceleration, jerk until the next sample; offset of the
/// accelerations, offset of some of the places.
enum State { u, v, a, j, bias, zero, states };
using Vector = std::array<double, states>;
using Matrix = std::array<Vector, states>;

double dot(const Vector& x, const Vector& y);

/// One value, at a grid step or within the interval after it.
struct Measurement {
    int source;
    Vector row; ///< value = row . state + noise
    double value;
    double variance;
};

/// All values, on a uniform grid.
struct Problem {
    double dt_s = 0;
    std::vector<std::vector<Measurement>> at; ///< of each grid step
    Vector start_mean{};
    Vector start_variance{};
    std::size_t steps() const { return at.size(); }
};

/// How the jerk changes from one interval to the next.
struct Process {
    bool smooth_jerk = false; ///< a random walk; else each interval has its own
    double sd = 0;            ///< of the jerk, or of its change
};

struct Smoothed {
    std::vector<Vector> mean;     ///< (steps)
    std::vector<Vector> variance; ///< (steps) of each part of the state
};

/// The maximum-likelihood intensity of a process: decades first, then the golden section.
/// @param likelihood receives its logarithm, without its constants
Process likeliest(const Problem& problem, bool smooth_jerk, double& likelihood);

Smoothed smoothed(const Problem& problem, const Process& process);

} // namespace stylobate::kalman
