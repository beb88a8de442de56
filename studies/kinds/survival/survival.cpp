#include "studies/kinds/survival/survival.hpp"

#include "ensemble/estimators/past/agreeing_states.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"
#include "ensemble/numerics/in_parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace stylobate {

namespace {

HazardCurve hazard_curve(const HazardSpec& hazard)
{
    if (!(hazard.k0_per_year > 0))
        return HazardCurve(hazard.intensity_m_s2, hazard.rate_per_year);
    const std::array intensity = {1.0, 10.0}; // two points of the power law
    const std::array rate = {hazard.k0_per_year, hazard.k0_per_year * std::pow(10, -hazard.k)};
    return HazardCurve(intensity, rate);
}

std::uint64_t sum_of(const std::vector<std::uint64_t>& counts)
{
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

} // namespace

SurvivalCounts::SurvivalCounts(const Study& study, const ResultHeader& header)
    : study_(study), axes_{header.frequency_hz, header.pga_m_s2, static_cast<std::size_t>(study.events())},
      motions_(study.total() / study.survival->per_motion)
{
    if (!study.survival->observed)
        return;
    const ObservedState& observed = *study.survival->observed;
    measured_.mirrored = observed.mirrored;
    for (std::size_t i = 0; i < observed.joints.size(); ++i) {
        const auto joint = static_cast<std::size_t>(observed.joints[i]);
        places_.push_back({false, joint});
        measured_.value.push_back(observed.offset_m[i]);
        measured_.tolerance.push_back(observed.tolerance_m);
        names_.push_back(fmt::format("displacement of {} [m]",
                                     joint < header.bed_names.size() ? header.bed_names[joint] : "a joint"));
    }
    const Layout layout = lay_out(study.structure);
    for (std::size_t i = 0, free = 0; i < layout.blocks.size() && !observed.rotation_rad.empty(); ++i) {
        if (layout.blocks[i].fixed)
            continue;
        places_.push_back({true, i});
        measured_.value.push_back(observed.rotation_rad[free++]);
        measured_.tolerance.push_back(observed.tolerance_rad);
        names_.push_back(fmt::format("rotation of {} [rad]", layout.blocks[i].name));
    }
    if (observed.mirrored)
        find_counterparts(layout);
}

void SurvivalCounts::find_counterparts(const Layout& layout)
{
    const std::optional<MirrorImage> image = mirror_image(layout);
    if (!image) // refused where the study is read
        return;
    for (std::size_t i = 0; i < measured_.value.size(); ++i) {
        const Place here = places_[i], there{here.rotation, (here.rotation ? image->blocks : image->beds)[here.number]};
        const auto at = std::find(places_.begin(), places_.end(), there);
        measured_.counterpart.push_back(static_cast<std::size_t>(at - places_.begin()));
        if (at == places_.end())
            places_.push_back(there);
    }
}

void SurvivalCounts::add(const ResultRow& row)
{
    const Outcome& o = row.outcome;
    if (o.state == State::invalid)
        return;
    MotionTally& motion = motions_.at(row.index / study_.survival->per_motion);
    ++motion.valid;
    if (o.state == State::collapsed)
        return;
    ++motion.stand;
    const std::size_t cell =
        static_cast<std::size_t>(study_.design().events_of(row.index) - 1) * axes_.cells_of_one() + row.cell;
    Standing state{row.index, cell, {}};
    for (const Place& place : places_)
        state.value.push_back((place.rotation ? o.rotation_rad : o.bed_offset_m).at(place.number));
    const StateDistance found = distance(measured_, state.value);
    MeasuredState one_sided = measured_;
    one_sided.mirrored = false;
    const bool as_is = distance(one_sided, state.value).agrees();
    motion.as_is += as_is;
    motion.mirrored +=
        measured_.value.empty() || (measured_.mirrored && mirror_distance(measured_, state.value).agrees());
    motion.agree += found.agrees();
    moving_ += found.agrees() && o.at_rest == 0;
    const bool nearer = !nearest_ || found.value < nearest_->distance ||
                        (found.value == nearest_->distance && row.index < nearest_->index);
    if (nearer && !state.value.empty())
        nearest_ = NearestState{row.index, found.value, cell, found.worst, found.found};
    standing_.push_back(std::move(state));
}

std::vector<std::uint64_t> SurvivalCounts::sums(std::uint32_t MotionTally::*part) const
{
    const std::size_t of_cell = motions_.size() / axes_.cells();
    std::vector<std::uint64_t> sums(axes_.cells(), 0);
    for (std::size_t m = 0; m < motions_.size(); ++m)
        sums[m / of_cell] += motions_[m].*part;
    return sums;
}

std::vector<SurvivalCounts::Standing> SurvivalCounts::standing() const
{
    std::vector<Standing> sorted = standing_;
    std::sort(sorted.begin(), sorted.end(), [](const Standing& a, const Standing& b) { return a.index < b.index; });
    return sorted;
}

std::vector<CellCount> cell_means(std::size_t cells, std::size_t motions, double most,
                                  const std::function<std::optional<double>(std::size_t)>& share)
{
    std::vector<CellCount> means;
    std::vector<double> shares;
    for (std::size_t c = 0; c < cells; ++c) {
        shares.clear();
        for (std::size_t m = c * motions / cells; m < (c + 1) * motions / cells; ++m)
            if (const std::optional<double> one = share(m))
                shares.push_back(*one);
        means.push_back(shares.empty() ? CellCount{} : effective_count(shares, most));
    }
    return means;
}

PriorDensity prior_density(const SurvivalSpec& spec)
{
    switch (spec.prior) {
    case PastPrior::log_uniform:
        break;
    case PastPrior::uniform:
        return [](double intensity) { return intensity; };
    case PastPrior::hazard:
        return [curve = hazard_curve(*spec.hazard)](double intensity) { return curve.density(std::log(intensity)); };
    }
    return [](double) { return 1.0; };
}

std::string prior_words(const SurvivalSpec& spec, const std::vector<double>& pga_m_s2)
{
    const char* words = spec.prior == PastPrior::log_uniform ? "flat in ln PGA"
                        : spec.prior == PastPrior::uniform   ? "flat in PGA"
                                                             : "in proportion to the rates of the hazard curve";
    return fmt::format("{} from {:.3g} to {:.3g} m/s2", words, pga_m_s2.front(), pga_m_s2.back());
}

namespace {

/// The mean over the motions of a share of those with so many valid structures.
std::vector<CellCount> means(const Study& study, const SurvivalCounts& counts, std::uint64_t fewest,
                             const std::function<double(const MotionTally&)>& share)
{
    const std::vector<MotionTally>& motions = counts.motions();
    return cell_means(
        counts.axes().cells(), motions.size(), static_cast<double>(study.realizations),
        [&](std::size_t m) { return motions[m].valid < fewest ? std::nullopt : std::optional(share(motions[m])); });
}

/// (cells of one event x built) `AlikeStructures::all_stand`; 0 where none stands.
std::vector<double> all_stand_ratios(const Study& study, const SurvivalCounts& counts, std::uint64_t built)
{
    std::vector<double> ratios(counts.axes().cells_of_one() * built, 0);
    std::vector<CellCount> one;
    for (std::uint64_t m = 1; m <= built; ++m) {
        const std::vector<CellCount> all =
            means(study, counts, built, [m](const MotionTally& tally) { return all_stand_share(tally, m); });
        if (m == 1)
            one = all;
        const auto mean = [](const CellCount& cell) { return cell.trials > 0 ? cell.successes / cell.trials : 0; };
        for (std::size_t c = 0; c < counts.axes().cells_of_one(); ++c)
            if (mean(one[c]) > 0)
                ratios[c * built + m - 1] = mean(all[c]) / mean(one[c]);
    }
    return ratios;
}

} // namespace

PastAnswer past_answer(const PastLikelihood& likelihood, const std::vector<RatioThresholds>& thresholds,
                       const PriorDensity& prior, double level)
{
    PastAnswer answer;
    for (std::size_t events = 1; events <= likelihood.axes.events; ++events)
        answer.by_events.push_back(exclusion(likelihood, events, prior, level, thresholds[events - 1]));
    answer.posterior = past_posterior(likelihood, prior, level);
    return answer;
}

MonumentJudgement judge_monuments(const PastAxes& axes, const std::vector<double>& trials,
                                  const StandingStates& standing, const MeasuredState& measured,
                                  const SurvivalSpec& spec, std::uint64_t seed)
{
    MonumentJudgement result;
    const RatioThresholds usual =
        measured.value.empty() ? standing_thresholds(axes, spec.level) : asymptotic_thresholds(axes, spec.level);
    result.thresholds.assign(axes.events, usual);
    if (measured.value.empty() || spec.monuments == 0 || standing.cell.empty())
        return result;
    const AgreeingStates agreeing(standing, measured);
    in_parallel(std::size_t{0}, axes.events, [&](std::size_t e) {
        result.thresholds[e] =
            ratio_thresholds(axes, trials, standing, agreeing, measured, e + 1, spec.monuments, spec.level, seed);
    });
    result.test = test_monuments(axes, trials, standing, agreeing, measured, past_prior(axes, prior_density(spec)),
                                 spec.monuments, seed);
    return result;
}

Survival survival_of(const Study& study, const SurvivalCounts& counts)
{
    const SurvivalSpec& spec = *study.survival;
    Survival s;
    s.axes = counts.axes();
    s.prior = prior_words(spec, s.axes.intensity);
    s.level = spec.level;
    s.realizations = study.total();
    s.trials = counts.sums(&MotionTally::valid);
    s.standing = counts.sums(&MotionTally::stand);
    s.agreeing = counts.sums(&MotionTally::agree);
    s.valid = sum_of(s.trials);
    s.stand = sum_of(s.standing);
    s.agree = sum_of(s.agreeing);
    s.moving = counts.moving();
    s.measured = counts.measured();
    s.names = counts.names();
    s.state_measured = !s.measured.value.empty();
    s.nearest = counts.nearest();
    s.built = spec.built;
    s.standing_alike = spec.standing;
    const PriorDensity prior = prior_density(spec);
    if (s.agree > 0) {
        StandingStates standing;
        for (const SurvivalCounts::Standing& one : counts.standing()) {
            standing.cell.push_back(one.cell);
            standing.value.insert(standing.value.end(), one.value.begin(), one.value.end());
        }
        const MonumentJudgement monuments = judge_monuments(
            s.axes, std::vector<double>(s.trials.begin(), s.trials.end()), standing, s.measured, spec, study.seed);
        s.monuments = monuments.test;
        s.coverage = monuments.thresholds.front().coverage;
        const std::vector<CellCount> agreeing = means(study, counts, 1, agreeing_share);
        s.past = past_answer(past_likelihood(s.axes, agreeing, study.seed, PastUse::means), monuments.thresholds, prior,
                             spec.level);
        if (s.axes.frequency_hz.size() > 1) {
            const PastLikelihood by_cell = past_likelihood(s.axes, agreeing, study.seed, PastUse::cells);
            for (std::size_t f = 0; f < s.axes.frequency_hz.size(); ++f)
                s.by_frequency.push_back(exclusion(by_cell, 1, prior, spec.level, monuments.thresholds.front(), f));
        }
        const std::vector<CellCount> alike = means(study, counts, spec.built, [&](const MotionTally& tally) {
            return built_share(tally, spec.built, spec.standing);
        });
        if (spec.built > 1 && std::any_of(alike.begin(), alike.end(), [](auto& cell) { return cell.successes > 0; }))
            s.alike =
                past_answer(past_likelihood(s.axes, alike, study.seed, PastUse::means),
                            std::vector<RatioThresholds>(s.axes.events, asymptotic_thresholds(s.axes, spec.level)),
                            prior, spec.level);
    }
    if (spec.stands_for_years) {
        s.years = *spec.stands_for_years;
        s.sigma_ln = spec.hazard->sigma_ln;
        const std::vector<CellCount> collapse =
            means(study, counts, 1, [](const MotionTally& tally) { return 1 - all_stand_share(tally, 1); });
        const PastLikelihood falls = past_likelihood(s.axes, collapse, study.seed, PastUse::rates,
                                                     std::uint64_t{1} << 48); // other random numbers
        if (!(spec.hazard->k0_per_year > 0))
            s.hazard_points = {spec.hazard->intensity_m_s2.front(), spec.hazard->intensity_m_s2.back()};
        s.rates = hazard_update(falls, hazard_curve(*spec.hazard), s.years, s.sigma_ln, spec.level, s.hazard_points,
                                {spec.built, spec.standing, all_stand_ratios(study, counts, spec.built)});
    }
    return s;
}

} // namespace stylobate
