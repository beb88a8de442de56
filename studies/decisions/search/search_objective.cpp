#include "studies/decisions/search/search_objective.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/hazard/hazard_file.hpp"
#include "studies/kinds/fragility/fragility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stylobate {

namespace {

HazardModel hazard_of(const OptimiseSpec& spec, const std::string& file, const Study& study)
{
    const MotionSetSpec* motions = study.design().motions;
    if (!motions)
        throw InputError(file, 0,
                         "optimise.hazard: a frequency is of a study of kind \"fragility\", and this one has no "
                         "intensities of a hazard.\n  Omit optimise.hazard, or search a fragility study.");
    if (motions->method != FragilityMethod::stripes || motions->stripes() < 2)
        throw InputError(file, 0,
                         "optimise.hazard: the frequency is by the shares of stripes.\n  Give fragility.method = "
                         "\"stripes\" with two intensities at least, or omit optimise.hazard.");
    try {
        return read_hazard({*spec.hazard}, measure_of(*motions));
    } catch (const InputError& error) {
        const std::string text = error.what(), option = "--hazard ";
        throw InputError(file, 0, "optimise.hazard: " + (text.starts_with(option) ? text.substr(option.size()) : text));
    }
}

bool is_common(const std::vector<const StudySide*>& sides, std::uint64_t index, std::size_t limit)
{
    return std::ranges::all_of(sides, [&](const StudySide* s) { return s->has(index) && s->known(index, limit); });
}

} // namespace

/// Realizations of each motion at each stripe.
struct SearchObjective::Counts {
    std::size_t groups, stripes, points;
    double all = 0;
    std::vector<double> trials;  ///< (groups x stripes)
    std::vector<double> reached; ///< (groups x stripes x points)

    double of(std::size_t g, std::size_t j, std::size_t i) const { return reached[(g * stripes + j) * points + i]; }
    /// Of all motions together.
    double share(std::size_t j, std::size_t i) const
    {
        double n = 0, sum = 0;
        for (std::size_t g = 0; g < groups; ++g) {
            n += trials[g * stripes + j];
            sum += of(g, j, i);
        }
        return n > 0 ? sum / n : 0;
    }
    bool has(std::size_t g) const
    {
        return std::any_of(trials.begin() + static_cast<std::ptrdiff_t>(g * stripes),
                           trials.begin() + static_cast<std::ptrdiff_t>((g + 1) * stripes),
                           [](double n) { return n > 0; });
    }
    bool has_at(std::size_t j) const
    {
        for (std::size_t g = 0; g < groups; ++g)
            if (trials[g * stripes + j] > 0)
                return true;
        return false;
    }
    /// Own frequencies of the motions that have runs, point by point: (motions) x (points). A motion without runs at a
    /// stripe takes the share of the others there, as in `share_frequency`.
    std::vector<std::vector<double>> own(const std::vector<double>& weight) const
    {
        std::vector<std::vector<double>> all_motions;
        for (std::size_t g = 0; g < groups; ++g) {
            if (!has(g))
                continue;
            std::vector<double> y(points);
            for (std::size_t j = 0; j < stripes; ++j)
                for (std::size_t i = 0; i < points; ++i) {
                    const double n = trials[g * stripes + j];
                    y[i] += weight[j] * (n > 0 ? of(g, j, i) / n : share(j, i));
                }
            all_motions.push_back(std::move(y));
        }
        return all_motions;
    }
};

SearchObjective::SearchObjective(const OptimiseSpec& spec, const std::string& file, const Study& study, double level)
    : file_(file), level_(level)
{
    if (!spec.hazard)
        return;
    hazard_ = hazard_of(spec, file, study);
    const MotionSetSpec& motions = *study.design().motions;
    for (int j = 0; j < motions.stripes(); ++j)
        intensity_.push_back(motions.intensity.value(j));
    weight_ = stripe_weights(intensity_, *hazard_);
}

SearchObjective::Counts SearchObjective::counts(const std::vector<const StudySide*>& sides, std::size_t limit,
                                                const PairLayout& layout) const
{
    Counts counts{layout.groups, intensity_.size(), sides.size(), 0, {}, {}};
    counts.trials.resize(counts.groups * counts.stripes);
    counts.reached.resize(counts.trials.size() * counts.points);
    for (std::uint64_t index = 0; index < sides.front()->size(); ++index) {
        if (!is_common(sides, index, limit))
            continue;
        const std::size_t at = layout.group(index) * counts.stripes + layout.cell(index);
        counts.all += 1;
        counts.trials[at] += 1;
        for (std::size_t i = 0; i < sides.size(); ++i)
            counts.reached[at * sides.size() + i] += sides[i]->reached(index, limit);
    }
    return counts;
}

/// The largest frequency is that of a state that is always reached from the weakest stripe on at which a run of any
/// point has reached it: what weaker ones do not exclude is no part of the frequency, as in `stylobate risk`.
PairedNoise SearchObjective::frequency_noise(const std::vector<const StudySide*>& sides, std::size_t limit,
                                             const PairLayout& layout) const
{
    const Counts found = counts(sides, limit, layout);
    std::size_t with_runs = 0;
    for (std::size_t j = 0; j < found.stripes; ++j)
        with_runs += found.has_at(j);
    if (with_runs < 2)
        throw InputError(file_, 0,
                         "[optimise]: a frequency needs realizations at two intensities of which is known in all of "
                         "the points whether they reached the limit state, and there are some at one alone.");
    std::size_t first = 0;
    const auto none_at = [&](std::size_t j) {
        for (std::size_t i = 0; i < found.points; ++i)
            if (found.share(j, i) > 0)
                return false;
        return true;
    };
    while (first < found.stripes && none_at(first))
        ++first;
    if (first == found.stripes)
        first = 0;
    const double most = std::accumulate(weight_.begin() + static_cast<std::ptrdiff_t>(first), weight_.end(), 0.0);
    const auto own = found.own(weight_);
    const double each = found.all / static_cast<double>(own.size());
    std::vector<double> reached;
    for (const auto& motion : own)
        for (const double y : motion)
            reached.push_back(each * y);
    return paired_noise(reached, std::vector<double>(own.size(), each), std::vector<std::size_t>(own.size()),
                        found.points, most);
}

PairedNoise SearchObjective::noise(const std::vector<const StudySide*>& sides, std::size_t limit,
                                   const PairLayout& layout) const
{
    std::uint64_t index = 0;
    while (index < sides.front()->size() && !is_common(sides, index, limit))
        ++index;
    if (index == sides.front()->size())
        throw InputError(file_, 0,
                         "[optimise]: no realization is valid at all of the points that were run, and known to have "
                         "reached the limit state or not.\n  Choose ranges in which the study is valid; `stylobate "
                         "info` of the points' results says why it is not.");
    if (is_frequency())
        return frequency_noise(sides, limit, layout);
    const std::size_t m = sides.size(), groups = layout.groups;
    std::vector<double> reached(groups * m), size(groups);
    std::vector<std::size_t> stratum(groups);
    for (; index < sides.front()->size(); ++index) {
        if (!is_common(sides, index, limit))
            continue;
        std::size_t group = layout.group(index);
        if (groups == 0) { // a realization by itself, within its cell
            group = size.size();
            size.push_back(0);
            stratum.push_back(layout.cell(index));
            reached.resize(reached.size() + m);
        }
        size[group] += 1;
        for (std::size_t i = 0; i < m; ++i)
            reached[group * m + i] += sides[i]->reached(index, limit);
    }
    return paired_noise(reached, size, stratum, m);
}

FrequencyEstimate SearchObjective::frequency(const StudySide& side, std::size_t limit, const PairLayout& layout) const
{
    const Counts found = counts({&side}, limit, layout);
    const FragilityData data = grouped(intensity_, found.trials, found.reached);
    FrequencyOptions options;
    options.level = level_;
    return share_frequency(data, stripe_shares(data), *hazard_, options);
}

ChangeNumber SearchObjective::change(const StudySide& base, const StudySide& variant, std::size_t limit,
                                     const PairLayout& layout) const
{
    const Counts found = counts({&base, &variant}, limit, layout);
    PairedStripes pairs{intensity_, found.trials, {}, {}};
    for (std::size_t i = 0; i < found.reached.size(); i += 2) {
        pairs.base.push_back(found.reached[i]);
        pairs.variant.push_back(found.reached[i + 1]);
    }
    ChangeOptions options;
    options.level = level_;
    options.years.clear();
    return frequency_change(pairs, *hazard_, options).frequency;
}

} // namespace stylobate
