#pragma once
/// A hazard curve as a chain of power laws, integrals over it, and the curves of a hazard that is not known exactly.
///
/// Between two points, and beyond the first and the last one, lambda = exp(c - k x) with x = ln im: the usual log-log
/// interpolation. Hazard curves are concave on these scales, so both continuations are upper bounds of a concave one.
/// Events of the intensities dx have the frequency -d lambda = k exp(c - k x) dx.

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stylobate {

// The seismic hazard of a site as plain data: how often an intensity of shaking is exceeded.

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
    std::optional<std::string> site;       ///< of a file of several; nullopt: the hazard is of one site alone
    std::string measure;                   ///< with its SI unit, as of a fragility study: "pga_m_s2", "sa_1s_m_s2"
    std::vector<double> intensity;         ///< (n >= 2) ascending, > 0
    std::vector<double> frequency;         ///< (n) best estimate (usually the mean) of that of exceedance [1/year]
    std::vector<HazardFractile> fractiles; ///< by ascending probability; empty: its uncertainty is not known
    bool unbounded = false;                ///< a power law at all intensities: it has no range
    std::vector<std::string> says;         ///< notes for the user on how it was read
};

/// An end of a range of ln im that is none; -no_end at intensity 0.
inline constexpr double no_end = std::numeric_limits<double>::infinity();

class HazardCurve {
public:
    /// @param intensity (n >= 2) ascending, > 0   @param frequency (n) not increasing, > 0
    /// @pre the last two frequencies differ
    HazardCurve(std::span<const double> intensity, std::span<const double> frequency);

    /// Of exceedance, at x = ln im; infinite at -infinity unless the first two points are equal.
    double frequency(double x) const;

    /// -d lambda / dx: the frequency of events of the intensities dx, over dx; 0 on a level piece.
    double density(double x) const;

    /// ln im that is exceeded so often: the inverse of `frequency`.
    /// @pre frequency > 0, and below that at -infinity
    double log_intensity(double frequency) const;

    /// The integral of Phi(intercept + slope x) -d lambda over [from, to] (either end may be infinite), in closed form.
    /// With eta = intercept + slope x, by parts on each piece of the chain,
    ///
    ///   I = [-Phi(eta) exp(c - k x)] + exp(c + k intercept / slope + k^2 / (2 slope^2)) [Phi(eta + k / slope)],
    ///
    /// of which one piece without ends is k0 m^-k exp(k^2 beta^2 / 2) with the median m and the dispersion beta =
    /// 1 / slope (Cornell, "Calculating building seismic performance reliability: a basis for multi-level design
    /// norms", Proceedings of the 11th World Conference on Earthquake Engineering (1996), paper 2122; Cornell, Jalayer,
    /// Hamburger & Foutch, "Probabilistic basis for 2000 SAC FEMA steel moment frame guidelines", Journal of Structural
    /// Engineering 128 (2002) 526).
    /// @pre slope > 0
    double lognormal_integral(double intercept, double slope, double from, double to) const;

    /// Weights w with sum_j w_j p_j = the integral of P -d lambda over [from, to], of P that is linear in x between the
    /// values p_j at the nodes, constant above the last node, and falls linearly to 0 over one more spacing (that of
    /// the first two nodes) below the first one.
    /// @param nodes (>= 2) ascending, ln im
    std::vector<double> node_weights(std::span<const double> nodes, double from, double to) const;

private:
    /// lambda = exp(c - k x) on [from, to].
    struct Piece {
        double from, to, c, k;
    };
    std::vector<Piece> pieces_;
};

/// The curve of the best estimate.
HazardCurve best_curve(const HazardModel& hazard);

/// The curve below which the true one lies with a probability. Between fractiles the logarithm of the frequency is
/// linear in the normal quantile of the probability, and so beyond the first and the last one (two fractiles are then a
/// lognormal distribution). The curve of a fractile is taken as a whole: a hazard that is high at one intensity is high
/// at all of them, which makes the interval the widest that the fractiles allow.
/// @pre two fractiles at least
HazardCurve quantile_curve(const HazardModel& hazard, double probability);

/// The mean of the curves over their probabilities, at each intensity: between two fractiles, and beyond the outer
/// ones, ln frequency is a + b z in the normal quantile z, of which the mean over z1 to z2 is
///
///   exp(a + b2 / 2) (Phi(z2 - b) - Phi(z1 - b)),
///
/// so that of two fractiles it is the mean exp(a + b2 / 2) of a lognormal distribution. A frequency by the fragility is
/// linear in the hazard, so that by this curve it is the mean over the hazard.
/// @pre two fractiles at least
HazardCurve mean_curve(const HazardModel& hazard);

} // namespace stylobate
