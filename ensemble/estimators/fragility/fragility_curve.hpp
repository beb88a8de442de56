#pragma once
/// Fragility curves: the probability that a limit state is reached, given the intensity, with its intervals.
///
/// With one measure and the probit this is the lognormal curve, P = Phi(ln(im / median) / dispersion), by maximum
/// likelihood (Shinozuka, Feng, Lee & Naganuma, "Statistical analysis of fragility curves", Journal of Engineering
/// Mechanics 126 (2000) 1224; Baker, "Efficient analytical fragility function fitting using dynamic structural
/// analysis", Earthquake Spectra 31 (2015) 579). `docs/fragility_statistics.md` has the measured coverage of each
/// interval: those by runs hold only where runs are independent, which runs of one record are not.

#include "ensemble/estimators/fragility/fragility_data.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// Below it no interval is given: Student's quantile depends on a variance that is itself poorly known.
inline constexpr std::size_t least_records = 8;
/// Below it the intervals are marked: their coverage was measured from here on.
inline constexpr std::size_t enough_records = 10;

struct CurveOptions {
    Link link = Link::probit;
    double level = 0.95;
    std::vector<std::vector<double>> at = {}; ///< (n x measures) intensities at which the probability is wanted
    std::size_t resamples = 0;                ///< of the records, for the bootstrap's intervals; 0: none
    std::uint64_t seed = 1;
};

/// A number and its intervals; unbounded where there is none.
struct CurveEstimate {
    double value = 0;
    Limits records;         ///< the one to use: the jackknife over records
    Limits profile_records; ///< profile likelihood, adjusted to the records
    Limits profile_runs;    ///< profile likelihood, right only where all runs are independent
    Limits bootstrap;       ///< resampled records, studentized
};

struct CurvePoint {
    std::vector<double> intensity; ///< (measures)
    CurveEstimate probability;
};

struct FragilityCurve {
    Link link = Link::probit;
    double level = 0.95;
    std::size_t records = 0;
    double trials = 0, reached = 0;
    Maximum maximum = Maximum::inside; ///< otherwise there is no curve, only bounds of the probabilities
    double log_likelihood = 0;
    std::vector<CurveEstimate> coefficients; ///< (1 + measures) constant, then one per ln intensity
    /// Of one measure, in its unit. Without a curve the value is NaN, and the limits are those of any non-decreasing
    /// curve. A slope that is not significantly above 0 gives no limits.
    CurveEstimate median;
    CurveEstimate dispersion; ///< 1 / slope: the standard deviation of ln capacity for the probit
    std::vector<CurvePoint> at;
    std::vector<std::string> says; ///< remarks for the reader, in sentences
};

/// @throws InputError for data that bear no estimate at all: options out of range, fewer different intensities than
///         coefficients
FragilityCurve fragility_curve(const FragilityData& data, const CurveOptions& options);

/// "between 0.1 and 0.2", "above 0.1", "below 0.2" of the limits of a median without a curve; nullopt if
/// they bound nothing.
/// @param scale from their unit to that of the text
std::optional<std::string> median_text(const Limits& median, double scale = 1);

// Test of the form of a fitted curve: a score test that accounts for records, and the sentence that states its result.
//
// The usual deviance from the shares of the stripes counts runs of one record as independent, and so rejects true
// curves. Here additional terms (powers of the logarithm of the intensity up to the fourth; squares where there are
// several measures) are tested by the sums of their scores over each record, which are independent: Hotelling's T2
// ("The generalization of Student's ratio", Annals of Mathematical Statistics 2 (1931) 360) of the records' efficient
// scores (Boos, "On generalized score tests", The American Statistician 46 (1992) 327), compared with F(terms, records
// - terms).

struct FittedCurve;

struct LackOfFit {
    int terms = 0;        ///< number of additional terms; 0 where the data allow no test
    double statistic = 0; ///< F
    double p_value = 1;
    std::string says; ///< the finding in a sentence
};

/// Below this p-value a form is reported as not fitting, in words and in figures.
inline constexpr double fit_significance = 0.05;

/// @param significance at which the sentence states that the form does not hold
LackOfFit lack_of_fit(const FittedCurve& curve, double significance = fit_significance);

} // namespace stylobate
