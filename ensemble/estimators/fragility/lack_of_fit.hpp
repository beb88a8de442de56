#pragma once
/// Does the form of a fitted curve hold? A score test that allows for records, and the sentence that says it.
///
/// The usual deviance against the shares of the stripes counts runs of one record as independent, and so rejects true
/// curves. Here terms that bend the curve (powers of the logarithm of the intensity up to the fourth; squares where
/// there are several measures) are tested by the sums of their scores over each record, which are independent:
/// Hotelling's T2 of the records' efficient scores, against F(terms, records - terms).

#include <string>

namespace stylobate {

struct FittedCurve;

struct LackOfFit {
    int terms = 0;        ///< that bend the curve; 0 where there is nothing to test with
    double statistic = 0; ///< F
    double p_value = 1;
    std::string says; ///< the finding in a sentence
};

/// @param significance at which the sentence says that the form does not hold
LackOfFit lack_of_fit(const FittedCurve& curve, double significance = 0.05);

} // namespace stylobate
