#pragma once
/// What a search minimises: the share of the realizations that reach a limit state, or its mean annual frequency over a
/// hazard, by the shares of the stripes of a fragility study,
///
///   lambda = sum_j w_j p_j   (`stripe_weights`)
///
/// It is linear in the shares, so it is the mean over the motions of each one's own frequency y_g, and the errors of
/// two points are those of the y_g of their common motions.

#include "ensemble/estimators/risk/frequency_estimate.hpp"
#include "ensemble/estimators/search/paired_noise.hpp"
#include "io/study/decisions/study_variants.hpp"
#include "studies/decisions/compare/pairing.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// A difference of two frequencies with its interval [1/year].
struct FrequencyDifference {
    double value = 0, lower = 0, upper = 0;
};

class SearchObjective {
public:
    /// @param file the study file, for messages
    /// @throws InputError for a hazard with a study that has no stripes, of another measure, or that cannot be read
    SearchObjective(const OptimiseSpec& spec, const std::string& file, const Study& study, double level);

    bool is_frequency() const { return hazard_.has_value(); }

    /// Over the realizations that are valid in all of the points. @throws InputError if there is none
    PairedNoise noise(const std::vector<const StudySide*>& sides, std::size_t limit, const PairLayout& layout) const;

    /// Of one point by itself, as of `stylobate risk`. @pre is_frequency()
    FrequencyEstimate frequency(const StudySide& side, std::size_t limit, const PairLayout& layout) const;

    /// variant - base, motion by motion: Student's interval with (sum d^2)^2 / sum d^4 - 1 degrees of freedom, those of
    /// the motions in which the two differ (own choice, of the form of `PairedNoise::freedom`). Where they differ in
    /// none, limits of a share of motions that was not seen. @pre is_frequency()
    FrequencyDifference difference(const StudySide& base, const StudySide& variant, std::size_t limit,
                                   const PairLayout& layout) const;

private:
    struct Counts;
    Counts counts(const std::vector<const StudySide*>& sides, std::size_t limit, const PairLayout& layout) const;
    PairedNoise frequency_noise(const std::vector<const StudySide*>& sides, std::size_t limit,
                                const PairLayout& layout) const;

    std::string file_;
    double level_;
    std::optional<HazardModel> hazard_;
    std::vector<double> intensity_; ///< (stripes)
    std::vector<double> weight_;    ///< (stripes) [1/year]
};

} // namespace stylobate
