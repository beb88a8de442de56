#pragma once
/// What friction depends on, from its mean over many windows of sliding. The dependences multiply, so that each of them
/// is found as it is beside the others:
///
///   mu = m (1 - k S) (1 +- b/2) (1 +- c/2) (1 + e (t - t_m)) + g z
///
/// S: path slipped, b: slow minus fast over their mean, c: slip to the left minus slip to the right over their mean, t:
/// time (t_m: middle of the windows), z: any other quantity that adds. Gauss-Newton, weights by the windows' noise.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace stylobate {

struct FrictionWindow {
    double mu = 0;     ///< force over weight, against the slip
    double sd = 0;     ///< of its noise
    double path_m = 0; ///< S at its middle
    double time_s = 0;
    int direction = 1; ///< of the body's slip: +1 to the right
    bool fast = false;
    double other = 0; ///< z
    int place = 0;    ///< a number for where it is; not in the fit
};

enum class FrictionTerm { level, wear, speed, direction, time, other, count };
inline constexpr std::size_t friction_terms = static_cast<std::size_t>(FrictionTerm::count);

struct FrictionFit {
    std::array<std::optional<double>, friction_terms> value; ///< nothing: not determined by these windows
    std::array<double, friction_terms> sd{};                 ///< by the noise; more where the windows scatter more
    std::vector<FrictionWindow> windows;                     ///< that were used
    std::vector<double> residual;                            ///< of each over what is expected, less 1

    std::optional<double> operator[](FrictionTerm term) const { return value[static_cast<std::size_t>(term)]; }
    double sd_of(FrictionTerm term) const { return sd[static_cast<std::size_t>(term)]; }
};

/// Windows after the path on which less than two fifths of the first friction are left are not used: there it may have
/// worn away altogether, and time and path cannot be told apart before. A term without windows on both of its sides is
/// not determined.
/// @param wanted terms besides level and wear
/// @return nothing where there are fewer than 4 windows, or no friction above the noise
std::optional<FrictionFit> fit_friction(std::vector<FrictionWindow> windows, const std::vector<FrictionTerm>& wanted);

} // namespace stylobate
