#pragma once
/// Test of the form of a fitted curve: a score test that accounts for records, and the sentence that states its result.
///
/// The usual deviance from the shares of the stripes counts runs of one record as independent, and so rejects true
/// curves. Here additional terms (powers of the logarithm of the intensity up to the fourth; squares where there are
/// several measures) are tested by the sums of their scores over each record, which are independent: Hotelling's T2
/// ("The generalization of Student's ratio", Annals of Mathematical Statistics 2 (1931) 360) of the records' efficient
/// scores (Boos, "On generalized score tests", The American Statistician 46 (1992) 327), compared with F(terms, records
/// - terms).

#include <string>

namespace stylobate {

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
