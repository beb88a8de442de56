#include "studies/kinds/survival/survival.hpp"

#include "ensemble/estimators/past/mirror_image.hpp"
#include "ensemble/estimators/risk/hazard_curve.hpp"

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

std::uint64_t sum_of(const std::vector<CellCount>& counts, std::uint64_t CellCount::*part)
{
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0},
                           [part](std::uint64_t sum, const CellCount& cell) { return sum + cell.*part; });
}

} // namespace

SurvivalCounts::SurvivalCounts(const Study& study, const ResultHeader& header)
    : study_(study), axes_{header.frequency_hz, header.pga_m_s2, static_cast<std::size_t>(study.events())},
      agree_(axes_.cells()), collapse_(axes_.cells())
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
    const std::size_t cell = static_cast<std::size_t>(study_.events(row.index) - 1) * axes_.cells_of_one() + row.cell;
    ++agree_.at(cell).trials;
    ++collapse_[cell].trials;
    if (o.state == State::collapsed) {
        ++collapse_[cell].successes;
        return;
    }
    Standing state{row.index, cell, {}};
    for (const Place& place : places_)
        state.value.push_back((place.rotation ? o.rotation_rad : o.bed_offset_m).at(place.number));
    const StateDistance found = distance(measured_, state.value);
    agree_[cell].successes += found.agrees();
    moving_ += found.agrees() && o.at_rest == 0;
    const bool nearer = !nearest_ || found.value < nearest_->distance ||
                        (found.value == nearest_->distance && row.index < nearest_->index);
    if (nearer && !state.value.empty())
        nearest_ = NearestState{row.index, found.value, cell, found.worst, found.found};
    if (!state.value.empty())
        standing_.push_back(std::move(state));
}

std::vector<CellCount> SurvivalCounts::stand() const
{
    std::vector<CellCount> stand = collapse_;
    for (CellCount& cell : stand)
        cell.successes = cell.trials - cell.successes;
    return stand;
}

StandingStates SurvivalCounts::standing() const
{
    std::vector<const Standing*> sorted;
    for (const Standing& one : standing_)
        sorted.push_back(&one);
    std::sort(sorted.begin(), sorted.end(), [](const Standing* a, const Standing* b) { return a->index < b->index; });
    StandingStates states;
    for (const Standing* one : sorted) {
        states.cell.push_back(one->cell);
        states.value.insert(states.value.end(), one->value.begin(), one->value.end());
    }
    return states;
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

Survival survival_of(const Study& study, const SurvivalCounts& counts)
{
    const SurvivalSpec& spec = *study.survival;
    Survival s;
    s.axes = counts.axes();
    s.prior = prior_words(spec, s.axes.intensity);
    s.level = spec.level;
    s.realizations = study.total();
    s.agreeing = counts.agree();
    s.standing = counts.stand();
    s.valid = sum_of(s.agreeing, &CellCount::trials);
    s.agree = sum_of(s.agreeing, &CellCount::successes);
    s.stand = sum_of(s.standing, &CellCount::successes);
    s.moving = counts.moving();
    s.measured = counts.measured();
    s.names = counts.names();
    s.state_measured = !s.measured.value.empty();
    s.nearest = counts.nearest();
    const PriorDensity prior = prior_density(spec);
    if (s.judged()) {
        const PastLikelihood likelihood = past_likelihood(s.axes, s.agreeing, study.seed, PastUse::means);
        for (std::size_t events = 1; events <= s.axes.events; ++events)
            s.by_events.push_back(exclusion(likelihood, events, prior, spec.level));
        if (s.axes.frequency_hz.size() > 1) {
            const PastLikelihood by_cell = past_likelihood(s.axes, s.agreeing, study.seed, PastUse::cells);
            for (std::size_t f = 0; f < s.axes.frequency_hz.size(); ++f)
                s.by_frequency.push_back(exclusion(by_cell, 1, prior, spec.level, f));
        }
        s.posterior = past_posterior(likelihood, prior, spec.level);
    }
    if (s.state_measured && spec.monuments > 0) {
        std::vector<std::uint64_t> trials;
        for (const CellCount& cell : s.agreeing)
            trials.push_back(cell.trials);
        s.monuments = test_monuments(s.axes, trials, counts.standing(), s.measured, past_prior(s.axes, prior),
                                     spec.monuments, study.seed);
    }
    if (spec.stands_for_years) {
        s.years = *spec.stands_for_years;
        s.sigma_ln = spec.hazard->sigma_ln;
        const PastLikelihood collapse = past_likelihood(s.axes, counts.collapse(), study.seed, PastUse::rates,
                                                        std::uint64_t{1} << 48); // other random numbers
        if (!(spec.hazard->k0_per_year > 0))
            s.hazard_points = {spec.hazard->intensity_m_s2.front(), spec.hazard->intensity_m_s2.back()};
        s.rates = hazard_update(collapse, hazard_curve(*spec.hazard), s.years, s.sigma_ln, spec.level, s.hazard_points);
    }
    return s;
}

} // namespace stylobate
