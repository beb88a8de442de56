#include "studies/measured/calibration/calibration_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace stylobate {

namespace {

constexpr std::size_t most_rounds = 6;
constexpr double widen = 1.5;                      // of the spread of the best points, for the next round
constexpr double least_spread = 1e-3;              // of the range
constexpr double few_points = 0.7;                 // factor on the correlation of few points
constexpr double alike_per_key = 2;                // nats
constexpr std::array fine_steps = {1.0, 2.0, 3.0}; // deviations from the best value, in a profile
constexpr double near_value = 0.05;      // of the range: points that may lend their other parameters to a profile
constexpr double likelihood_drop = 1.92; // half the 95 % quantile of chi2 with one degree of freedom
constexpr double interval_deviations = 1.96;
constexpr double nearly_all = 0.8;   // of the range: an interval wider than this determines nothing
constexpr double wide_part = 1. / 3; // of the range: tied parameters with wider intervals are not known
constexpr double tied = 0.95;        // correlation from which two parameters are known together only

double sum(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Number of points of the profiles of a number of parameters.
std::size_t most_profile_points(std::size_t keys, const CalibrationOptions& options)
{
    return 2 * keys * (options.profile + 1 + 2 * fine_steps.size());
}

std::vector<double> unit_matrix(std::size_t d)
{
    std::vector<double> m(d * d, 0.0);
    for (std::size_t i = 0; i < d; ++i)
        m[i * d + i] = 1;
    return m;
}

} // namespace

CalibrationSearch::CalibrationSearch(Study nominal, Study start, std::vector<FitKey> keys,
                                     const CalibrationOptions& options, CalibrationEvidence& evidence,
                                     const RunOptions& run, Observer& observer, SearchProgress& progress)
    : nominal_(std::move(nominal)), start_(std::move(start)), keys_(std::move(keys)), options_(options),
      evidence_(evidence), run_(run), observer_(observer), progress_(progress)
{
}

std::size_t CalibrationSearch::planned(std::size_t keys, const CalibrationOptions& options, std::size_t folds)
{
    if (keys == 0)
        return 2 + (options.held_out ? folds : 0);
    return 2 + options.scan + most_rounds * options.refine + 2 * options.surface + most_profile_points(keys, options) +
           (options.held_out ? folds : 0);
}

double CalibrationSearch::value(std::size_t key, double unit) const
{
    const FitKey& k = keys_[key];
    if (unit <= 0 || unit >= 1)
        return unit <= 0 ? k.from : k.to;
    return k.logarithmic ? k.from * std::exp(unit * std::log(k.to / k.from)) : k.from + unit * (k.to - k.from);
}

Study CalibrationSearch::study_at(const UnitPoint& point) const
{
    std::vector<std::string> names;
    std::vector<double> values;
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        names.push_back(keys_[i].key);
        values.push_back(value(i, point[i]));
    }
    return with_values(start_, names, values);
}

bool CalibrationSearch::try_points(const std::vector<UnitPoint>& points)
{
    // in portions, so that the progress line moves and a wish to stop is soon heard
    constexpr std::size_t portion = 16;
    for (std::size_t first = 0; first < points.size(); first += portion) {
        const std::size_t last = std::min(first + portion, points.size());
        std::vector<Study> studies;
        for (std::size_t i = first; i < last; ++i)
            studies.push_back(study_at(points[i]));
        if (!evidence_.add(studies, run_, observer_))
            return false;
        for (std::size_t i = first; i < last; ++i) {
            const std::size_t candidate = evidence_.candidates() - (last - i);
            tried_.push_back({points[i], candidate, sum(evidence_.own_scores(candidate, {}))});
        }
        progress_.advance(last - first);
    }
    return true;
}

std::size_t CalibrationSearch::best_tried() const
{
    return static_cast<std::size_t>(
        std::max_element(tried_.begin(), tried_.end(), [](const Tried& a, const Tried& b) { return a.own < b.own; }) -
        tried_.begin());
}

/// Rounds of points about the best ones so far, with their mean and spread made a little wider, until the best ones are
/// as good as each other, or no longer become better.
bool CalibrationSearch::refine()
{
    progress_.stage("refinement about the optimum");
    const std::size_t d = keys_.size(), best = 3 * d;
    double last_mean = -std::numeric_limits<double>::infinity();
    for (std::size_t round = 0;; ++round) {
        std::vector<std::size_t> order(tried_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(),
                  [&](std::size_t a, std::size_t b) { return tried_[a].own > tried_[b].own; });
        order.resize(std::min(order.size(), best));
        const double n = static_cast<double>(order.size());
        surface_.best.assign(d, 0.0);
        for (const std::size_t i : order)
            for (std::size_t k = 0; k < d; ++k)
                surface_.best[k] += tried_[i].at[k] / n;
        std::vector<double> cov(d * d, 0.0);
        for (const std::size_t i : order)
            for (std::size_t k = 0; k < d; ++k)
                for (std::size_t m = 0; m < d; ++m)
                    cov[k * d + m] += (tried_[i].at[k] - surface_.best[k]) * (tried_[i].at[m] - surface_.best[m]) / n;
        surface_.deviation.resize(d);
        surface_.correlation = unit_matrix(d);
        for (std::size_t k = 0; k < d; ++k)
            surface_.deviation[k] = std::max(std::sqrt(cov[k * d + k]), least_spread);
        for (std::size_t k = 0; k < d; ++k)
            for (std::size_t m = 0; m < d; ++m)
                if (k != m)
                    surface_.correlation[k * d + m] =
                        few_points * cov[k * d + m] / (surface_.deviation[k] * surface_.deviation[m]);
        double mean = 0;
        for (const std::size_t i : order)
            mean += tried_[i].own / n;
        const double alike = alike_per_key * static_cast<double>(d);
        const bool settled =
            tried_[order.front()].own - tried_[order.back()].own < alike || (round >= 3 && mean - last_mean < alike);
        last_mean = mean;
        if (round == most_rounds || settled) {
            progress_.spare((most_rounds - round) * options_.refine);
            return true;
        }
        std::vector<double> spread = surface_.deviation;
        for (double& s : spread)
            s *= widen;
        if (!try_points(points_about(surface_.best, spread, surface_.correlation, options_.refine, drawn_)))
            return false;
        drawn_ += options_.refine;
    }
}

std::vector<ScoredPoint> CalibrationSearch::scored(const std::vector<std::size_t>& tried) const
{
    std::vector<ScoredPoint> points;
    for (const std::size_t i : tried)
        points.push_back({tried_[i].at, evidence_.scores(tried_[i].candidate, reference_)});
    return points;
}

/// Two rounds of points over the region in which the best one may lie, and the quadratic form through all that lie
/// there, whatever round they are from.
bool CalibrationSearch::fit()
{
    progress_.stage("the shape of the score about the optimum");
    const std::size_t d = keys_.size();
    std::vector<double> most(d, prior_deviation);
    for (int round = 0; round < 2; ++round) {
        std::vector<double> spread = surface_.deviation;
        for (std::size_t k = 0; k < d; ++k) {
            spread[k] = std::clamp(widen * spread[k], least_spread, most[k]);
            // a form that hardly determines a parameter must not move the next round out of the region
            most[k] = std::min(2 * spread[k], prior_deviation);
        }
        const UnitPoint centre = surface_.best;
        if (!try_points(points_about(centre, spread, surface_.correlation, options_.surface, drawn_)))
            return false;
        drawn_ += options_.surface;
        near_.clear();
        for (std::size_t i = 0; i < tried_.size(); ++i) {
            bool inside = true;
            for (std::size_t k = 0; k < d; ++k)
                inside = inside && std::fabs(tried_[i].at[k] - centre[k]) < 2.5 * spread[k];
            if (inside)
                near_.push_back(i);
        }
        reference_ = tried_[best_tried()].candidate;
        const ScoreSurface fitted = fit_surface(scored(near_), evidence_.runs());
        if (fitted.fitted)
            surface_ = fitted;
    }
    return surface_.fitted;
}

/// Every parameter held at values over its range, the others where the form wants them then, and where they were in the
/// best point that has been tried nearby.
bool CalibrationSearch::profiles(FormCalibration& result)
{
    progress_.stage("profiles of the parameters");
    const std::size_t d = keys_.size();
    std::vector<UnitPoint> points;
    held_.assign(d, {});
    std::vector<std::size_t> held; // parameter of each pair of points
    for (std::size_t i = 0; i < d; ++i) {
        std::vector<double> values = {surface_.best[i]};
        for (std::size_t k = 0; k < options_.profile; ++k)
            values.push_back(static_cast<double>(k) /
                             static_cast<double>(std::max<std::size_t>(options_.profile, 2) - 1));
        for (const double step : fine_steps)
            for (const double side : {-1.0, 1.0}) {
                const double at = surface_.best[i] + side * step * std::min(surface_.deviation[i], surface_.reach[i]);
                if (at > 0 && at < 1)
                    values.push_back(at);
            }
        std::sort(values.begin(), values.end());
        values.erase(std::unique(values.begin(), values.end()), values.end());
        for (const double at : values) {
            UnitPoint moved = surface_.best;
            for (std::size_t j = 0; j < d; ++j)
                moved[j] = std::clamp(moved[j] + surface_.along[i * d + j] * (at - surface_.best[i]), 0.0, 1.0);
            moved[i] = at;
            std::optional<std::size_t> nearest;
            for (std::size_t t = 0; t < tried_.size(); ++t)
                if (std::fabs(tried_[t].at[i] - at) <= near_value && (!nearest || tried_[t].own > tried_[*nearest].own))
                    nearest = t;
            UnitPoint other = nearest ? tried_[*nearest].at : surface_.best;
            other[i] = at;
            points.push_back(std::move(moved));
            points.push_back(std::move(other));
            held.push_back(i);
        }
        held_[i] = std::move(values);
    }
    progress_.spare(most_profile_points(d, options_) - points.size());
    const std::size_t first = tried_.size();
    if (!try_points(points))
        return false;
    for (std::size_t h = 0; h < held.size(); ++h) {
        double best = -std::numeric_limits<double>::infinity();
        for (std::size_t t = first + 2 * h; t < first + 2 * h + 2; ++t)
            best = std::max(best, sum(evidence_.scores(tried_[t].candidate, reference_)));
        std::vector<ProfilePoint>& profile = result.parameters[held[h]].profile;
        profile.push_back({value(held[h], held_[held[h]][profile.size()]), best - surface_.largest});
    }
    return true;
}

/// The interval of a parameter: that of the form where it knows the parameter from its points, and wherever the profile
/// has not yet fallen.
void CalibrationSearch::judge(FittedParameter& p, std::size_t i) const
{
    const FitKey& key = keys_[i];
    const double best = surface_.best[i];
    // of the range: one part of the value more
    const double method = key.method_deviation * (key.logarithmic ? 1 / std::log(key.to / key.from)
                                                                  : std::fabs(value(i, best)) / (key.to - key.from));
    const double half = interval_deviations * std::hypot(surface_.deviation[i], method);
    const double drop =
        likelihood_drop * std::max(surface_.overdispersion[i], 1.0) + interval_deviations * surface_.roughness;
    const std::vector<double>& at = held_[i];
    const auto high_enough = [&](const ProfilePoint& point) { return point.score >= -drop; };
    const auto first = std::find_if(p.profile.begin(), p.profile.end(), high_enough);
    const auto last = std::find_if(p.profile.rbegin(), p.profile.rend(), high_enough).base(); // one after it
    double low = best, high = best;
    if (first != p.profile.end()) {
        const auto lowest = static_cast<std::size_t>(first - p.profile.begin());
        const auto highest = static_cast<std::size_t>(last - p.profile.begin()) - 1;
        const bool known = surface_.deviation[i] < surface_.reach[i];
        // where the profile crosses the limit on its way out
        const auto crossing = [&](std::size_t inside, std::size_t outside) {
            const double a = p.profile[inside].score + drop, b = p.profile[outside].score + drop;
            return known ? at[inside] : at[inside] + (at[outside] - at[inside]) * a / (a - b);
        };
        low = std::min(low, lowest > 0 ? crossing(lowest, lowest - 1) : at[lowest]);
        high = std::max(high, highest + 1 < at.size() ? crossing(highest, highest + 1) : at[highest]);
        if (known) {
            low = std::min(low, best - half);
            high = std::max(high, best + half);
        }
    } else {
        low = best - half;
        high = best + half;
    }
    low = std::max(low, 0.0);
    high = std::min(high, 1.0);
    p.bounded_below = low > 0;
    p.bounded_above = high < 1;
    p.low = value(i, low);
    p.high = value(i, high);
    const bool narrow = std::min(high, 1.0) - std::max(low, 0.0) < nearly_all;
    p.determined = p.bounded_below && p.bounded_above && narrow;
    if (p.determined)
        return;
    if (p.bounded_below && narrow)
        p.note = fmt::format("not determined by these data beyond: at least {:.4g}", p.low);
    else if (p.bounded_above && narrow)
        p.note = fmt::format("not determined by these data beyond: at most {:.4g}", p.high);
    else
        p.note = "not determined by these data: the score hardly changes over the range";
}

/// Each motion is predicted by the parameters that the others give, and by the study as it was.
bool CalibrationSearch::hold_out(FormCalibration& result, const std::vector<std::size_t>& fold, std::size_t folds)
{
    progress_.stage("cross-validation over motions");
    const std::vector<std::size_t>& runs = evidence_.runs();
    const std::vector<ScoredPoint> near = scored(near_);
    std::vector<UnitPoint> points;
    for (std::size_t f = 0; f < folds; ++f) {
        std::vector<bool> use;
        for (std::size_t u = 0; u < runs.size(); ++u)
            use.push_back(fold[u] != f);
        const ScoreSurface others = fit_surface(near, runs, use);
        points.push_back(others.fitted ? others.best : surface_.best);
    }
    const std::size_t first = tried_.size();
    if (!try_points(points))
        return false;
    std::vector<double> nominal(runs.size()), calibrated(runs.size());
    for (std::size_t f = 0; f < folds; ++f) {
        std::vector<std::size_t> used;
        for (std::size_t u = 0; u < runs.size(); ++u)
            if (fold[u] != f)
                used.push_back(runs[u]);
        const std::vector<double> by_others = evidence_.own_scores(tried_[first + f].candidate, used);
        const std::vector<double> as_it_was = evidence_.own_scores(nominal_candidate_, used);
        for (std::size_t u = 0; u < runs.size(); ++u)
            if (fold[u] == f) {
                calibrated[u] = by_others[u];
                nominal[u] = as_it_was[u];
            }
    }
    result.held_out = paired_gain(nominal, calibrated, fold);
    for (RunScore& run : result.runs)
        run.nominal = run.calibrated = 0;
    for (std::size_t u = 0, r = 0; u < runs.size(); ++u) {
        if (u > 0 && runs[u] != runs[u - 1])
            ++r;
        result.runs[r].nominal += nominal[u];
        result.runs[r].calibrated += calibrated[u];
    }
    return true;
}

/// The study as it was given, before any point; where it is a point of the search too, it counts as one.
bool CalibrationSearch::begin(FormCalibration& result)
{
    nominal_candidate_ = evidence_.candidates();
    progress_.stage("the start study");
    if (!evidence_.add({nominal_}, run_, observer_))
        return false;
    progress_.advance(1);
    UnitPoint at_start;
    result.form = start_.contact.form;
    for (const FitKey& key : keys_) {
        FittedParameter p;
        p.key = key.key;
        p.start = number_in(nominal_, p.key);
        p.from = key.from;
        p.to = key.to;
        // it need not lie within the range
        const double at = key.logarithmic ? std::log(std::max(p.start, p.from) / p.from) / std::log(p.to / p.from)
                                          : (p.start - p.from) / (p.to - p.from);
        at_start.push_back(std::clamp(at, 0.0, 1.0));
        result.parameters.push_back(p);
    }
    if (nominal_.text == start_.text)
        tried_.push_back({at_start, nominal_candidate_, sum(evidence_.own_scores(nominal_candidate_, {}))});
    return true;
}

/// Values, intervals, and what is known only together.
void CalibrationSearch::conclude(FormCalibration& result) const
{
    const std::size_t d = keys_.size();
    result.roughness = surface_.roughness;
    result.correlation = surface_.correlation;
    for (std::size_t i = 0; i < d; ++i) {
        result.parameters[i].value = value(i, surface_.best[i]);
        judge(result.parameters[i], i);
    }
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t j = 0; j < d; ++j) {
            FittedParameter& p = result.parameters[i];
            // (an interval that is narrow all the same has the other one's freedom in it)
            const bool wide = keys_[i].logarithmic ? std::log(p.high / p.low) > wide_part * std::log(p.to / p.from)
                                                   : p.high - p.low > wide_part * (p.to - p.from);
            if (i == j || !p.determined || !wide || std::fabs(result.correlation[i * d + j]) < tied)
                continue;
            p.determined = false;
            p.note = fmt::format("not determined by these data alone: only together with {}", result.parameters[j].key);
        }
}

std::optional<FormCalibration> CalibrationSearch::run(const std::vector<std::size_t>& fold, std::size_t folds)
{
    FormCalibration result;
    if (!begin(result))
        return std::nullopt;
    if (!keys_.empty()) {
        progress_.stage("scan of the whole range");
        if (!try_points(spread_points(keys_.size(), options_.scan, 0)))
            return std::nullopt;
        drawn_ = options_.scan;
        if (!refine() || !fit() || !profiles(result))
            return std::nullopt;
    }
    conclude(result);
    progress_.stage("the calibrated study");
    if (!try_points({surface_.best}))
        return std::nullopt;
    result.study = study_at(surface_.best);
    const std::size_t final_candidate = tried_.back().candidate;
    const std::vector<double> nominal = evidence_.own_scores(nominal_candidate_, {});
    const std::vector<double> calibrated = evidence_.own_scores(final_candidate, {});
    result.score = sum(calibrated);
    result.nominal_score = sum(nominal);
    const std::vector<std::size_t>& runs = evidence_.runs();
    for (std::size_t u = 0; u < runs.size(); ++u) {
        if (u == 0 || runs[u] != runs[u - 1])
            result.runs.emplace_back();
        ++result.runs.back().units;
        result.runs.back().nominal += nominal[u];
        result.runs.back().calibrated += calibrated[u];
    }
    if (options_.held_out && folds > 1 && !hold_out(result, fold, folds))
        return std::nullopt;
    return result;
}

} // namespace stylobate
