#pragma once
/// Test (c): what an impact leaves of a rocking block's rate of rotation, over the phase of the impact within a step.
///
/// The monolith is released from leans near half its slenderness whose quarter periods are spread over one step. The
/// lean p1 at which it turns round after the impact gives the ratio e of the rates after and before it, by the rigid
/// block's energy: e2 = V(p1) / V(p0), V(t) = cos(alpha - t) - cos(alpha), p0 the lean at the release. Housner's e is
/// 1 - 1.5 sin2 alpha, whatever the lean.

#include "bench/peers/contender.hpp"

#include <array>
#include <optional>

namespace stylobate::peers {

inline constexpr int impact_phases = 64;

/// Housner's.
double exact_restitution();

/// About the lean from which the rigid monolith is upright after this time [rad]: alpha (1 - 1 / cosh(p t)), Housner's
/// for small angles, which spreads the phases evenly enough.
double lean_of_quarter_period(double time_s);

/// e of one impact. Turning points are those of the parabola through three places, so that they do not depend on where
/// between two steps they fall.
/// @param block in motion from rest at the lean `start_rad`
/// @return NaN if it does not turn round within 8 / p
double restitution(BlockRun& block, double start_rad);

/// Relative errors against Housner's e over all phases of a step; infinite where a block did not turn round.
struct Impacts {
    double mean = 0, least = 0, largest = 0;
    double scatter() const { return largest - least; }
    double worst() const; ///< the larger of |least| and |largest|
};
Impacts impacts(const Contender& contender, double dial);

/// A contender over its dials: steps halved from 1/60 to 1/15360 s, or K_N multiplied by 4 from 1e7 N/m2 on.
struct ImpactScan {
    Contender contender;
    std::vector<double> dials;
    std::vector<Impacts> impacts; ///< (dials)
    struct Reached {
        double dial = 0, step_s = 0; ///< of columns
        Columns shaken;              ///< timed there
    };
    /// The first dial at which the error is within each target at every phase, and at the next two; at the last ones,
    /// at those that there are, but at one more at least.
    std::array<std::optional<Reached>, 2> reached;
};

/// Place of that first dial among these; none: there is none.
std::optional<std::size_t> first_within(const std::vector<Impacts>& impacts, double target);

/// @param seconds for each timing, about
ImpactScan scan_impacts(const Contender& contender, double seconds);

/// Two tables (steps; stiffnesses) and what is reached.
std::string impact_markdown(const std::vector<ImpactScan>& scans, const std::string& processor);
std::string impact_json(const std::vector<ImpactScan>& scans, const std::string& processor);

} // namespace stylobate::peers
