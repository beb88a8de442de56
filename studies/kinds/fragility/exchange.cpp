#include "studies/kinds/fragility/exchange.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/tables/fragility_exchange.hpp"
#include "studies/kinds/fragility/fragility_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace stylobate {

namespace {

using DamageKind = DamageState::Kind;

struct Group {
    const char* id;
    const char* describe;
    DamageKind first;
};
constexpr Group groups[] = {{"peak", "peak displacement of the top over the width at the base", DamageKind::peak},
                            {"residual", "residual dislocation of a joint over its width", DamageKind::residual},
                            {"seat", "seats of epistyles", DamageKind::unseated}};

/// OpenQuake's name.
std::string measure_of(const std::string& name)
{
    static const std::pair<const char*, const char*> names[] = {
        {"pga_m_s2", "PGA"}, {"pgv_m_s", "PGV"}, {"pgd_m", "PGD"}, {"arias_m_s", "IA"}, {"cav_m_s", "CAV"}};
    for (const auto& [own, theirs] : names)
        if (name == own)
            return theirs;
    return fmt::format("SA({})", name.substr(3, name.find("s_m") - 3));
}

FragilityValue value_of(const CurveEstimate& e)
{
    return {e.value, e.records.lower, e.records.upper};
}

/// In OpenQuake's unit of the measure.
std::string median_bounds(const Limits& median, const std::string& measure)
{
    const auto bounds = median_text(median, per_si_unit(measure));
    return bounds ? "median " + *bounds + " " + openquake_unit(measure) : "no bounds of the median";
}

FragilityFunction lognormal(const Fragility& f, const std::vector<const StateFragility*>& states)
{
    FragilityFunction function;
    function.id = "lognormal";
    function.measure = measure_of(f.measure);
    function.least = f.grid.front();
    function.most = f.grid.back();
    for (const StateFragility* s : states) {
        function.states.push_back({value_of(s->curve.median), value_of(s->curve.dispersion), {}});
        if (s->fit.p_value < fit_significance)
            function.note += s->state.name + ": " + s->fit.says + " ";
    }
    return function;
}

FragilityFunction stripes(const Fragility& f, const std::vector<const StateFragility*>& states)
{
    FragilityFunction function;
    function.id = "stripes";
    function.measure = measure_of(f.measure);
    function.discrete = true;
    // a state of residuals has no share where nothing came to rest, and a function has one table of intensities
    const auto share_at = [](const StateFragility& s, double intensity) {
        const auto& all = s.stripes->stripes;
        const auto at = std::find_if(all.begin(), all.end(),
                                     [&](const StripeShare& share) { return share.intensity == intensity; });
        return at == all.end() ? nullptr : &*at;
    };
    std::set<double> every;
    for (const StateFragility* s : states)
        for (const StripeShare& share : s->stripes->stripes)
            every.insert(share.intensity);
    for (const double intensity : every)
        if (std::all_of(states.begin(), states.end(), [&](const auto* s) { return share_at(*s, intensity); }))
            function.intensity.push_back(intensity);
    if (function.intensity.size() < every.size())
        function.note = fmt::format("{} of {} intensities are left out: no realization came to rest there. ",
                                    every.size() - function.intensity.size(), every.size());
    for (const StateFragility* s : states) {
        FragilityState state;
        for (const double intensity : function.intensity) {
            const StripeShare& share = *share_at(*s, intensity);
            state.probability.push_back({share.share, share.limits.lower, share.limits.upper});
        }
        function.states.push_back(std::move(state));
    }
    return function;
}

} // namespace

std::vector<FragilityModel> fragility_models(const Fragility& f, const std::string& study)
{
    std::vector<FragilityModel> models;
    for (const Group& group : groups) {
        std::vector<const StateFragility*> states;
        for (const StateFragility& s : f.states)
            if (s.state.kind == group.first || s.state.kind == DamageKind::collapse ||
                s.state.kind == DamageKind::total)
                states.push_back(&s);
        if (states.empty() || states.front()->state.kind != group.first)
            continue;
        FragilityModel model;
        model.id = group.id;
        model.description = fmt::format("{}: {}; {}; {}", study, group.describe, design_text(f),
                                        f.different < least_records ? "too few motions for intervals"
                                                                    : "intervals clustered by motion");
        for (const StateFragility* s : states)
            model.limit_states.push_back(s->state.name);
        if (states.front()->stripes)
            if (FragilityFunction shares = stripes(f, states); shares.intensity.size() >= 2)
                model.functions.push_back(std::move(shares));
        const bool curves = std::all_of(states.begin(), states.end(), [](const StateFragility* s) {
            return s->curve.maximum == Maximum::inside && s->curve.median.value > 0;
        });
        if (curves) {
            FragilityModel alone = model;
            alone.functions = {lognormal(f, states)};
            try {
                check_fragility_model(alone);
                model.functions.push_back(alone.functions.front());
            } catch (const InputError& error) {
                model.description += fmt::format("; the lognormal curves are omitted: {}", error.what());
            }
        } else {
            for (const StateFragility* s : states)
                if (!(s->curve.maximum == Maximum::inside && s->curve.median.value > 0))
                    model.description += fmt::format("; {}: no lognormal curve, {}", s->state.name,
                                                     median_bounds(s->curve.median.records, measure_of(f.measure)));
        }
        if (!model.functions.empty())
            models.push_back(std::move(model));
    }
    return models;
}

std::vector<std::pair<std::string, std::string>> model_files(const std::vector<FragilityModel>& models,
                                                             const std::string& format)
{
    std::vector<std::pair<std::string, std::string>> files;
    for (const FragilityModel& model : models) {
        if (format == "nrml")
            files.emplace_back(model.id + ".xml", fragility_nrml(model));
        else if (format == "json")
            files.emplace_back(model.id + ".json", fragility_json(model));
        else
            files.emplace_back("fragility_" + model.id + ".csv", fragility_csv(model));
    }
    return files;
}

Table motions_list(const MotionTable& motions)
{
    const std::size_t n = motions.names.size(), measures = motions.measures.size();
    std::vector<std::uint64_t> number(n);
    std::iota(number.begin(), number.end(), std::uint64_t{0});
    Table table("motions");
    table.add("motion", std::move(number));
    table.add("name", motions.names);
    for (std::size_t m = 0; m < measures; ++m) {
        std::vector<double> values;
        for (std::size_t i = 0; i < n; ++i)
            values.push_back(motions.value[i * measures + m]);
        table.add(motions.measures[m], std::move(values));
    }
    return table;
}

} // namespace stylobate
