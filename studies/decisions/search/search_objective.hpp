#pragma once
/// What a search minimises: the share of the realizations that reach a limit state, or its mean annual frequency over a
/// hazard, by the shares of the stripes of a fragility study,
///
///   lambda = sum_j w_j p_j   (`stripe_weights`)
///
/// It is linear in the shares, so it is the mean over the motions of each one's own frequency y_g, and the errors of
/// two points are those of the y_g of their common motions.

#include "ensemble/estimators/risk/frequency_change.hpp"
#include "ensemble/estimators/search/response_surface.hpp"
#include "io/study/study_file.hpp"
#include "studies/decisions/compare/pairing.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

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

    /// variant - base, as of `stylobate risk` of a comparison. @pre is_frequency()
    ChangeNumber change(const StudySide& base, const StudySide& variant, std::size_t limit,
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
