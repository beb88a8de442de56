#include "ensemble/estimators/fragility/measure_ranking.hpp"

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/estimators/fragility/fragility_curve.hpp"
#include "ensemble/model/input_error.hpp"

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace stylobate {
namespace {

/// The contribution of each record to the log likelihood of a fitted curve.
std::vector<double> log_likelihood_by_record(const FittedCurve& curve)
{
    const Eigen::VectorXd eta = curve.predictors * curve.fit.coefficients;
    std::vector<double> sums(curve.data.records, 0.0);
    for (const FragilityRow& row : curve.data.rows) {
        const LinkValue at = link_at(curve.link, std::clamp(eta[row.point], -36.0, 36.0));
        if (row.reached > 0)
            sums[row.record] += row.reached * std::log(at.below);
        if (row.reached < row.trials)
            sums[row.record] += (row.trials - row.reached) * std::log(at.above);
    }
    return sums;
}

/// Points are split by record, so that a feature of the record can be a predictor beside the measure.
FittedCurve with_feature(const FragilityData& data, const std::vector<double>& values)
{
    FragilityData split = data;
    split.intensity.clear();
    const double n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double square = 0;
    for (const double value : values)
        square += (value - mean) * (value - mean) / n;
    if (!(square > 0 && std::isfinite(square)))
        throw InputError("fragility: a feature of the records is the same for all of them, or not finite.\n  Omit it.");
    Eigen::MatrixXd predictors(static_cast<Eigen::Index>(data.rows.size()), 3);
    for (std::size_t i = 0; i < data.rows.size(); ++i) {
        const FragilityRow& row = data.rows[i];
        split.rows[i].point = static_cast<std::uint32_t>(i);
        split.intensity.push_back(data.intensity[row.point]);
        predictors.row(static_cast<Eigen::Index>(i)) << 1, std::log(data.intensity[row.point]),
            (values[row.record] - mean) / std::sqrt(square);
    }
    return fitted_curve(std::move(split), std::move(predictors), Link::probit);
}

Sufficiency sufficiency_of(const FragilityData& data, const std::string& feature, const std::vector<double>& values,
                           double level)
{
    Sufficiency found;
    found.feature = feature;
    const FittedCurve curve = with_feature(data, values);
    if (curve.fit.maximum != Maximum::inside)
        return found;
    const CurveTarget target = CurveTarget::sum((ParameterVector(3) << 0, 0, 1).finished());
    const RecordSpread spread = record_spread(curve, target);
    found.coefficient = target.value(curve.fit.coefficients);
    found.limits = wald_limits(curve, target, level);
    const boost::math::students_t_distribution<double> student(spread.freedom);
    found.p_value = 2 * cdf(complement(student, std::abs(found.coefficient) / std::sqrt(spread.variance)));
    return found;
}

/// Bonferroni: the smallest of m p-values, compared with level / m.
bool nothing_adds(const std::vector<Sufficiency>& tests, double level)
{
    double smallest = 1;
    for (const Sufficiency& test : tests)
        smallest = std::min(smallest, test.p_value);
    return tests.empty() || smallest >= (1 - level) / static_cast<double>(tests.size());
}

struct Fitted {
    RankedMeasure measure;
    std::vector<double> by_record; ///< log likelihood; empty: no curve
};

/// The log likelihood of one probability for all runs.
double log_likelihood_of_mean(const BinomialCounts& counts)
{
    const double trials = counts.trials.sum(), share = counts.reached.sum() / trials;
    return share > 0 && share < 1 ? trials * (share * std::log(share) + (1 - share) * std::log1p(-share)) : 0;
}

/// A curve in one measure alone, and what each feature of the records would add to it.
/// @param mean log likelihood without any measure   @param trials all runs
Fitted fitted_alone(const FragilityData& data, std::size_t column, const std::string& name,
                    const std::vector<std::string>& features, const std::vector<std::vector<double>>& values,
                    double level, double mean, double trials)
{
    Fitted fitted;
    RankedMeasure& measure = fitted.measure;
    measure.name = name;
    measure.column = column;
    const FragilityData alone = with_measure(data, column);
    if (alone.points() < 2)
        return fitted;
    const FittedCurve curve = fitted_curve(alone, log_predictors(alone), Link::probit);
    if (curve.fit.maximum != Maximum::inside)
        return fitted;
    const double slope = curve.fit.coefficients[1];
    const Limits limits = jackknife_limits(curve, jackknife(curve), CurveTarget::slope(), level);
    measure.dispersion = slope > 0 ? 1 / slope : std::numeric_limits<double>::infinity();
    measure.dispersion_limits = {limits.upper > 0 ? 1 / limits.upper : 0,
                                 limits.lower > 0 ? 1 / limits.lower : std::numeric_limits<double>::infinity()};
    measure.gain = (curve.fit.log_likelihood - mean) / trials;
    fitted.by_record = log_likelihood_by_record(curve);
    for (std::size_t f = 0; f < features.size(); ++f)
        measure.sufficiency.push_back(sufficiency_of(alone, features[f], values[f], level));
    measure.sufficient = nothing_adds(measure.sufficiency, level);
    return fitted;
}

/// Information that a measure lacks against the best one, over all runs.
struct Behind {
    double sum; ///< of the log likelihood
    Limits limits;
};

/// The comparison of Vuong, "Likelihood ratio tests for model selection and non-nested hypotheses", Econometrica 57
/// (1989) 307, with the record as the unit.
Behind behind(const std::vector<double>& best, const std::vector<double>& own, double level)
{
    const double n = static_cast<double>(best.size());
    const double t = quantile(complement(boost::math::students_t_distribution<double>(n - 1), (1 - level) / 2));
    double sum = 0, square = 0;
    for (std::size_t g = 0; g < best.size(); ++g)
        sum += best[g] - own[g];
    for (std::size_t g = 0; g < best.size(); ++g)
        square += std::pow(best[g] - own[g] - sum / n, 2);
    const double reach = t * std::sqrt(n / (n - 1) * square);
    return {sum, {sum - reach, sum + reach}};
}

/// The sentence of a measure. @param best name of the first one; nullopt: this is the first
std::string sentence(const RankedMeasure& measure, double less, const std::optional<std::string>& best,
                     std::size_t features, double level)
{
    std::string says =
        fmt::format("{}: dispersion {:.3f} ({:.3f} to {:.3f}), information {:.3f} nat per run", measure.name,
                    measure.dispersion, measure.dispersion_limits.lower, measure.dispersion_limits.upper, measure.gain);
    if (best)
        says += fmt::format(", {:.3f} ({:.3f} to {:.3f}) less than {}{}", less, measure.behind.lower,
                            measure.behind.upper, *best, measure.behind.lower <= 0 ? ", which is not significant" : "");
    if (features > 0) {
        std::string adds;
        for (const Sufficiency& test : measure.sufficiency)
            if (test.p_value < (1 - level) / static_cast<double>(features))
                adds += fmt::format("{}{} (p = {:.2g})", adds.empty() ? "" : ", ", test.feature, test.p_value);
        says += adds.empty() ? "; no insufficiency found with these records"
                             : "; not sufficient: " + adds + " adds information";
    }
    return says + '.';
}

} // namespace

std::vector<RankedMeasure> ranked_measures(const FragilityData& data, const std::vector<std::string>& names,
                                           const std::vector<std::string>& features,
                                           const std::vector<std::vector<double>>& values, double level)
{
    if (names.size() != data.measures || features.size() != values.size() ||
        std::any_of(values.begin(), values.end(), [&](const auto& each) { return each.size() != data.records; }))
        throw InputError(fmt::format("fragility: {} names for {} measures, {} names for {} features of {} records.",
                                     names.size(), data.measures, features.size(), values.size(), data.records));
    if (data.records < least_records)
        throw InputError(fmt::format("fragility: {} records are too few to rank measures, at least {}.", data.records,
                                     least_records));
    const BinomialCounts counts = counts_of(data);
    const double trials = counts.trials.sum(), mean = log_likelihood_of_mean(counts);
    std::vector<Fitted> all;
    for (std::size_t j = 0; j < data.measures; ++j)
        all.push_back(fitted_alone(data, j, names[j], features, values, level, mean, trials));
    std::stable_sort(all.begin(), all.end(), [](const Fitted& a, const Fitted& b) {
        return a.by_record.empty() != b.by_record.empty() ? b.by_record.empty() : a.measure.gain > b.measure.gain;
    });

    std::vector<RankedMeasure> ranked;
    for (const Fitted& fitted : all) {
        RankedMeasure measure = fitted.measure;
        if (fitted.by_record.empty()) {
            measure.sufficient = false;
            measure.dispersion = measure.gain = std::nan("");
            measure.says = fmt::format("{}: no curve with this measure alone, so it is not ranked.", measure.name);
        } else {
            const auto [sum, limits] = behind(all.front().by_record, fitted.by_record, level);
            measure.behind = {limits.lower / trials, limits.upper / trials};
            measure.says = sentence(measure, sum / trials,
                                    &fitted == &all.front() ? std::nullopt : std::optional(all.front().measure.name),
                                    features.size(), level);
        }
        ranked.push_back(measure);
    }
    return ranked;
}

} // namespace stylobate
