#pragma once
/// A comparison and a risk estimate with something in every member, for tests of their files.

#include "studies/decisions/compare/comparison.hpp"
#include "studies/decisions/risk/risk.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace stylobate {

inline PlaceComparison sample_place(std::uint64_t base_only, std::uint64_t variant_only)
{
    PlaceComparison place;
    place.counts = {10, base_only, variant_only, 50};
    const auto pairs = static_cast<double>(place.counts.pairs());
    place.base.probability = static_cast<double>(place.counts.base()) / pairs;
    place.variant.probability = static_cast<double>(place.counts.variant()) / pairs;
    place.difference = place.variant.probability - place.base.probability;
    place.lower = place.difference - 0.05;
    place.upper = place.difference + 0.05;
    place.unpaired = 500;
    place.p = 0.001;
    place.p_adjusted = 0.004;
    return place;
}

/// Of a surface with two cells, or of a fragility study with three stripes.
inline Comparison sample_comparison(bool of_motions)
{
    Comparison c;
    c.kind = of_motions ? "fragility" : "surface";
    c.title = "A column";
    c.base_name = "column";
    c.base_results = "column.h5";
    c.base_toml = "[study]\nkind = \"surface\"\n";
    c.code_version = "1.0";
    c.adjustment = "holm";
    if (of_motions) {
        c.measure = "pgv_m_s";
        c.intensity = {0.3, 0.6, 1.2};
        c.motions = 20;
    } else {
        c.frequency_hz = {2};
        c.pga_m_s2 = {3, 6};
        c.adaptive_budget = 1000;
        c.adaptive_margin = 0.05;
        c.adaptive_rounds = 3;
    }
    for (const char* name : {"dowels", "tendon"}) {
        VariantComparison v;
        v.name = name;
        v.results = v.name + ".h5";
        v.study_toml = "[study]\n";
        v.pairs = 100;
        v.invalid_base = v.dropped = 1;
        v.inputs = {{"friction", CommonDraws::same, 3}, {"tilt", CommonDraws::variant_only, 1}};
        v.notes = {"structure.columns differs"};
        for (const char* limit : {"collapse", "peak_0.35"}) {
            LimitComparison state{limit, "what it is", true, {}, sample_place(30, 10), {}};
            for (std::size_t cell = 0; cell < c.places(); ++cell)
                state.cells.push_back(sample_place(40 - 30 * cell, 10 * cell));
            for (std::size_t i = 0; of_motions && i < c.places() * c.motions; ++i)
                state.by_motion.push_back({i % 4, 3 - i % 3, i % 3, 1});
            v.limits.push_back(state);
        }
        if (!of_motions)
            v.depends = {{"friction",
                          {4.5, 1e-5, {0.65, 0.71}, {{{-0.2, -0.3, -0.1}, {-0.1, -0.2, -0.01}, {0.02, -0.1, 0.1}}}},
                          2e-5}};
        c.variants.push_back(v);
    }
    return c;
}

inline RiskNumber sample_risk_number(double value)
{
    RiskNumber n;
    n.value = value;
    n.total = {value / 3, value * 4};
    n.fragility = {value / 2, value * 2};
    n.hazard = {value / 1.5, value * 3};
    n.fragility_part = 0.4;
    return n;
}

inline RiskChange sample_risk_change()
{
    RiskChange change;
    change.comparison_file = "column_comparison.h5";
    change.title = "A column";
    change.base_name = "column";
    change.code_version = "1.0";
    change.hazard.source = "hazard.csv";
    change.hazard.measure = "pgv_m_s";
    change.hazard.intensity = {0.05, 0.5, 5};
    change.hazard.frequency = {0.1, 1e-3, 1e-5};
    change.years = {50, 100};
    change.intensity = {0.3, 0.6, 1.2};
    change.motions = 20;
    change.says = {"A note."};
    for (const char* name : {"dowels", "tendon"}) {
        VariantChange variant{name, std::string(name) + ".h5", {}};
        for (const bool determined : {true, false}) {
            StateChange s;
            s.state = determined ? "collapse" : "peak_0.35";
            s.meaning = "what it is";
            s.determined = determined;
            s.note = "why";
            s.change.base.frequency = sample_risk_number(1e-3);
            s.change.variant.frequency = sample_risk_number(7e-4);
            s.change.base.unseen = 1e-5;
            s.change.variant.unseen = 2e-5;
            s.change.frequency = {-3e-4, {-4e-4, -2e-4}, {-6e-4, -1e-4}};
            s.change.ratio = {0.7, {0.6, 0.8}, {0.6, std::numeric_limits<double>::infinity()}};
            s.change.probability = {{-0.01, {-0.02, -0.005}, {-0.03, -0.004}}, {-0.02, {-0.04, -0.01}, {-0.06, -0.01}}};
            s.base_share = {0, 0.4, 0.9};
            s.variant_share = {0, 0.3, 0.8};
            variant.states.push_back(s);
        }
        change.variants.push_back(variant);
    }
    return change;
}

inline SequenceRisk sample_sequences()
{
    SequenceRisk s;
    s.years = 100;
    s.histories = 200;
    s.threshold = 0.1;
    s.threshold_says = "the strongest stripe that harms nothing";
    s.events_a_year = 0.02;
    s.events = 400;
    s.most_events = 6;
    s.with_two = 120;
    s.carried = 30;
    s.fresh = 20;
    s.both = 15;
    s.invalid = 1;
    s.runs = 700;
    s.steps = 123456;
    s.carried_share = {0.15, {0.1, 0.2}};
    s.fresh_share = {0.1, {0.07, 0.14}};
    s.difference = {0.05, {0.01, 0.09}};
    s.ratio = {1.5, {1.1, std::numeric_limits<double>::infinity()}};
    s.closed_form = {std::numeric_limits<double>::quiet_NaN(), {0, 1}};
    s.checked = 20;
    s.then_fell = 1;
    s.checked_threshold = 0.05;
    s.check_difference = {0.05, {-0.05, 0.15}};
    return s;
}

inline Risk sample_risk(bool with_sequences)
{
    constexpr double inf = std::numeric_limits<double>::infinity();
    Risk r;
    r.fragility_file = "column.h5";
    r.title = "A column";
    r.study_text = "[study]\nkind = \"fragility\"\n";
    r.code_version = "1.0";
    r.hazard.source = "hazard.csv";
    r.hazard.site = "23.7,37.9";
    r.hazard.measure = "pgv_m_s";
    r.hazard.intensity = {0.05, 0.5, 5};
    r.hazard.frequency = {0.1, 1e-3, 1e-5};
    r.hazard.fractiles = {{0.16, {0.05, 5e-4, 5e-6}}, {0.84, {0.2, 2e-3, 2e-5}}};
    r.years = {50, 100};
    r.says = {"1 invalid realization is left out."};
    const auto state = [&](const char* name, FragilityForm form, bool chosen, bool determined) {
        StateRisk s{name, "what it is", form, chosen, determined, "why", {}, {}};
        s.estimate.form = form;
        s.estimate.frequency = sample_risk_number(1e-3);
        s.estimate.by_mean_hazard = 1.2e-3;
        s.estimate.below = 0.01;
        s.estimate.above = 0.02;
        s.estimate.beyond_hazard = 0.03;
        s.estimate.bounds = {1e-4, inf};
        s.estimate.unseen = 1e-6;
        for (const auto& [from, to] : {std::pair{0.0, 0.3}, std::pair{0.3, 2.5}, std::pair{2.5, inf}})
            s.estimate.parts.push_back({from, to, sample_risk_number(3e-4)});
        s.fragility = {{0.3, 0.1, 0.05, 0.2}, {2.5, 0.9, 0.8, 0.95}};
        r.states.push_back(s);
    };
    state("peak_0.35", FragilityForm::lognormal, true, true);
    state("collapse", FragilityForm::shares, true, true);
    state("collapse", FragilityForm::lognormal, false, false);
    if (with_sequences)
        r.sequences = sample_sequences();
    return r;
}

} // namespace stylobate
