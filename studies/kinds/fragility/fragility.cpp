#include "studies/kinds/fragility/fragility.hpp"

#include "ensemble/estimators/fragility/curve_target.hpp"
#include "ensemble/model/input_error.hpp"
#include "ensemble/model/motion_set.hpp"
#include "ensemble/numerics/in_parallel.hpp"
#include "ensemble/numerics/interval.hpp"
#include "studies/experiment/motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace stylobate {

namespace {

constexpr std::size_t grid_points = 60;

/// 95 %, from the values that are found with each of the motions left out.
Limits jackknife_limits(double value, const std::vector<double>& without)
{
    const auto n = static_cast<double>(without.size());
    double mean = 0, squares = 0;
    for (const double w : without)
        mean += w / n;
    for (const double w : without)
        squares += (w - mean) * (w - mean);
    const double reach = student_quantile(0.975, n - 1) * std::sqrt((n - 1) / n * squares);
    return {value - reach, value + reach};
}

const char* pair_words(OfPair definition)
{
    switch (definition) {
    case OfPair::first:
        return "that of the first one";
    case OfPair::larger:
        return "the larger one of both";
    case OfPair::geometric_mean:
        return "the geometric mean of both";
    case OfPair::at_once:
        return "that of their vector at once";
    }
    return "";
}

/// Where a realization stands in the design.
struct Place {
    std::uint32_t motion = 0, stripe = 0, structure = 0;
    std::uint32_t ground = 0; ///< the ground motion that the motion is
    double scale = 1;         ///< of its motion
};

class Analysis {
public:
    /// @param rows by index
    Analysis(const Study& study, const ResultHeader& header, std::vector<FragilityOutcome> rows)
        : header_(header), study_(study), groups_(motion_groups(study, header.motions))
    {
        const FragilitySpec& spec = *study_.fragility;
        out_.method = spec.method;
        out_.measure = measure_of(spec);
        out_.motions = header_.motions.names.size();
        out_.different = groups_.groups;
        out_.structures = study_.realizations;
        for (FragilityOutcome& row : rows) {
            const Place at = place(row);
            out_.motion.push_back(static_cast<std::int32_t>(at.motion));
            out_.intensity.push_back(intensity(at, out_.measure));
            if (row.outcome.state == State::invalid) {
                ++out_.invalid;
                continue;
            }
            ++out_.valid;
            places_.push_back(at);
            outcomes_.push_back(std::move(row.outcome));
        }
    }

    Fragility run()
    {
        if (!results_suffice())
            return out_;
        grid();
        const std::vector<DamageState> states = damage_states(study_);
        out_.states.resize(states.size());
        const double width = base_width_m(study_.structure);
        std::vector<Reached> columns(states.size());
        for (std::size_t k = 0; k < states.size(); ++k)
            for (std::size_t i = 0; i < outcomes_.size(); ++i)
                columns[k].push_back(
                    reached(states[k], outcomes_[i], width, until_s(places_[i].motion, states[k].shaking)));
        in_parallel(std::size_t{0}, states.size(),
                    [&](std::size_t k) { out_.states[k] = state(states[k], columns[k]); });
        for (std::size_t k = 0; k < states.size(); ++k)
            if (states[k].kind == DamageState::Kind::collapse && states[k].shaking == 0)
                rank(columns[k]);
        if (study_.fragility->shakings > 1 && out_.method == FragilityMethod::stripes)
            sequence();
        return out_;
    }

private:
    /// (valid realizations) Whether each reached a limit state; nothing: not known.
    using Reached = std::vector<std::optional<bool>>;

    double until_s(std::size_t motion, int shaking) const
    {
        return next_shaking_s(study_, header_.motions, motion, shaking);
    }

    void sequence()
    {
        const auto stripes = static_cast<std::size_t>(study_.fragility->stripes());
        const int shakings = study_.fragility->shakings;
        // by ground motion, stripe and shaking: how many structures, and how many had fallen
        const auto at = [&](std::size_t motion, std::size_t stripe, int k) {
            return (motion * stripes + stripe) * static_cast<std::size_t>(shakings) + static_cast<std::size_t>(k - 1);
        };
        const std::size_t grounds = out_.different;
        std::vector<double> trials(grounds * stripes), fallen(grounds * stripes * static_cast<std::size_t>(shakings));
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Place& p = places_[i];
            trials[p.ground * stripes + p.stripe] += 1;
            for (int k = 1; k <= shakings; ++k)
                fallen[at(p.ground, p.stripe, k)] +=
                    outcomes_[i].state == State::collapsed && outcomes_[i].collapse_time_s <= until_s(p.motion, k);
        }
        // mean over the stripes without one motion (or with all)
        const auto shares = [&](int k, std::size_t without) {
            std::pair<double, double> mean{0, 0};
            for (std::size_t s = 0; s < stripes; ++s) {
                double n = 0, first = 0, by_k = 0;
                for (std::size_t m = 0; m < grounds; ++m)
                    if (m != without) {
                        n += trials[m * stripes + s];
                        first += fallen[at(m, s, 1)];
                        by_k += fallen[at(m, s, k)];
                    }
                if (n == 0)
                    continue;
                mean.first += by_k / n / static_cast<double>(stripes);
                mean.second += (1 - std::pow(1 - first / n, k)) / static_cast<double>(stripes);
            }
            return mean;
        };
        for (int k = 1; k <= shakings; ++k) {
            const auto [by_k, fresh] = shares(k, grounds);
            std::vector<double> without;
            for (std::size_t m = 0; m < grounds; ++m) {
                const auto [a, b] = shares(k, m);
                without.push_back(a - b);
            }
            const double none = std::nan("");
            out_.sequence.push_back({k, by_k, fresh,
                                     k == 1                    ? Limits{0, 0}
                                     : grounds < least_records ? Limits{none, none}
                                                               : jackknife_limits(by_k - fresh, without)});
        }
    }

    Place place(const FragilityOutcome& row) const
    {
        const auto stripes = static_cast<std::uint64_t>(study_.fragility->stripes());
        Place p;
        p.motion = static_cast<std::uint32_t>(row.cell / stripes);
        p.stripe = static_cast<std::uint32_t>(row.cell % stripes);
        p.ground = static_cast<std::uint32_t>(groups_.group.at(p.motion));
        p.structure = static_cast<std::uint32_t>(row.index % study_.realizations);
        p.scale = row.pga_m_s2 / measured(p.motion, "pga_m_s2");
        return p;
    }

    std::size_t column(const std::string& measure) const
    {
        const auto& names = header_.motions.measures;
        const auto at = std::find(names.begin(), names.end(), measure);
        if (at == names.end())
            throw InputError("the motions of the results were not measured by " + measure);
        return static_cast<std::size_t>(at - names.begin());
    }
    /// Of a motion as it stands.
    double measured(std::size_t motion, const std::string& measure) const
    {
        return header_.motions.value[motion * header_.motions.measures.size() + column(measure)];
    }
    double intensity(const Place& p, const std::string& measure) const
    {
        if (out_.method == FragilityMethod::stripes && measure == out_.measure)
            return study_.fragility->intensity.value(static_cast<int>(p.stripe)); // to the last bit, for the stripes
        return measured(p.motion, measure) * std::pow(p.scale, header_.motions.exponent[column(measure)]);
    }

    bool results_suffice()
    {
        if (places_.empty()) {
            out_.says.emplace_back("No realization is valid: there are no shares and no curve.");
            return false;
        }
        std::vector<bool> seen(out_.different);
        for (const Place& p : places_)
            seen[p.ground] = true;
        const auto grounds = static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true));
        if (out_.different < out_.motions)
            out_.says.push_back(fmt::format("{} of the {} motions are different; equal ones (up to a factor) count as "
                                            "one in all intervals.",
                                            out_.different, out_.motions));
        if (study_.has_pairs())
            out_.says.push_back(fmt::format("The intensity of two horizontal components is {} (fragility.of_pair).",
                                            pair_words(study_.fragility->of_pair)));
        if (grounds < least_records)
            out_.says.push_back(fmt::format("{} different motion{} too few for an interval over motions (at least {}): "
                                            "shares and curves are those of {}, and have no interval.",
                                            grounds, grounds == 1 ? " is" : "s are", least_records,
                                            grounds == 1 ? "this motion" : "these motions"));
        else if (grounds < enough_records)
            out_.says.push_back(fmt::format(
                "Intervals are from {} motions; with fewer than {} their coverage is below the nominal level.", grounds,
                enough_records));
        return true;
    }

    void grid()
    {
        double low = INFINITY, high = 0;
        for (const Place& p : places_) {
            low = std::min(low, intensity(p, out_.measure));
            high = std::max(high, intensity(p, out_.measure));
        }
        for (std::size_t i = 0; i < grid_points; ++i)
            out_.grid.push_back(low * std::pow(high / low, static_cast<double>(i) / (grid_points - 1)));
    }

    /// Summed by cell, as realizations of one have the same intensity.
    FragilityData data(const std::vector<std::string>& measures, const Reached& reached) const
    {
        std::map<std::pair<std::uint32_t, std::uint32_t>, FragilityRun> cells;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (!reached[i])
                continue;
            const Place& p = places_[i];
            FragilityRun& run = cells[{p.motion, p.stripe}];
            if (run.intensity.empty()) {
                run.record = p.ground;
                run.trials = 0;
                for (const std::string& measure : measures)
                    run.intensity.push_back(intensity(p, measure));
            }
            run.trials += 1;
            run.reached += *reached[i];
        }
        std::vector<FragilityRun> runs;
        for (auto& [cell, run] : cells)
            runs.push_back(std::move(run));
        return grouped(runs);
    }

    StateFragility state(const DamageState& damage, const Reached& reached) const
    {
        StateFragility s;
        s.state = damage;
        s.moving = static_cast<std::uint64_t>(std::ranges::count_if(reached, [](const auto& r) { return !r; }));
        if (s.moving == reached.size()) {
            without_curve(s.curve, "No realization fell or came to rest: nothing is known of this limit state. Give "
                                   "excitation.tail_s = \"rest\", or more damping.");
            return s;
        }
        try {
            estimate(reached, s);
        } catch (const InputError& error) { // the reason is reported, and the other states have their curves
            without_curve(s.curve, error.what());
        }
        return s;
    }

    void estimate(const Reached& reached, StateFragility& s) const
    {
        const FragilityData one = data({out_.measure}, reached);
        CurveOptions options;
        for (const double at : out_.grid)
            options.at.push_back({at});
        if (one.points() > 1) {
            s.curve = fragility_curve(one, options);
            s.fit = lack_of_fit(fitted_curve(one, log_predictors(one), Link::probit));
        } else {
            of_one_intensity(one, s.curve);
        }
        if (one.records < least_records)
            without_intervals(s.curve);
        if (out_.method == FragilityMethod::stripes) {
            s.stripes = stripe_shares(one);
            if (one.records < least_records)
                for (StripeShare& stripe : s.stripes->stripes)
                    stripe.limits = stripe.band = {std::nan(""), std::nan("")};
            count_resurrected(reached, s);
        }
        if (s.curve.reached > 0 && s.curve.reached < s.curve.trials && one.records > 1)
            s.shares = shares(reached);
        s.data = one;
    }

    static void of_one_intensity(const FragilityData& one, FragilityCurve& curve)
    {
        curve.records = one.records;
        for (const FragilityRow& row : one.rows) {
            curve.trials += row.trials;
            curve.reached += row.reached;
        }
        without_curve(curve, "All runs have one intensity: there is a share and no curve.");
    }

    static void without_curve(FragilityCurve& curve, const std::string& why)
    {
        curve.maximum = Maximum::none;
        curve.median.value = curve.dispersion.value = std::nan("");
        curve.says.push_back(why);
    }

    /// Of too few motions an interval over motions would be a guess.
    static void without_intervals(FragilityCurve& curve)
    {
        const auto none = [](CurveEstimate& estimate) {
            const Limits limits{std::nan(""), std::nan("")};
            estimate.records = estimate.profile_records = estimate.profile_runs = estimate.bootstrap = limits;
        };
        none(curve.median);
        none(curve.dispersion);
        for (CurvePoint& point : curve.at)
            none(point.probability);
    }

    void count_resurrected(const Reached& reached, StateFragility& s) const
    {
        const auto stripes = static_cast<std::size_t>(study_.fragility->stripes());
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<int>> of_structure; // stripe by stripe; -1: none
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (!reached[i])
                continue;
            auto& seen = of_structure[{places_[i].motion, places_[i].structure}];
            seen.resize(stripes, -1);
            seen[places_[i].stripe] = *reached[i];
        }
        for (const auto& [key, seen] : of_structure) {
            const auto first = std::find(seen.begin(), seen.end(), 1);
            s.reached_ever += first != seen.end();
            s.resurrected += std::find(first, seen.end(), 0) != seen.end();
        }
    }

    DispersionShares shares(const Reached& reached) const
    {
        const auto contacts = static_cast<std::uint32_t>(study_.fragility->contacts);
        const auto twins = static_cast<std::uint32_t>(study_.fragility->twins);
        std::vector<NestedRun> runs;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (!reached[i])
                continue;
            const Place& p = places_[i];
            const auto all = static_cast<std::uint32_t>(out_.structures), structure = p.motion * all + p.structure;
            runs.push_back(
                {p.ground, structure / (contacts * twins), structure / twins, p.stripe, *reached[i] ? 1.0 : 0.0});
        }
        return dispersion_shares(runs);
    }

    /// Intensity measures ranked by information on the collapse, and whether it tells all that scaling does not change.
    void rank(const Reached& reached)
    {
        const auto ones = std::ranges::count_if(reached, [](const auto& r) { return r && *r; });
        if (ones == 0 || ones == static_cast<std::ptrdiff_t>(reached.size()) || out_.different < least_records)
            return;
        std::vector<std::size_t> motion_of(out_.different, out_.motions); // one of each ground motion that was run
        for (const Place& p : places_)
            motion_of[p.ground] = p.motion;
        std::vector<std::string> scaling, features;
        std::vector<std::vector<double>> values;
        for (std::size_t m = 0; m < header_.motions.measures.size(); ++m) {
            const std::string& name = header_.motions.measures[m];
            if (header_.motions.exponent[m] > 0) {
                scaling.push_back(name);
                continue;
            }
            features.push_back(name);
            values.emplace_back();
            for (const std::size_t motion : motion_of)
                if (motion < out_.motions)
                    values.back().push_back(measured(motion, name));
        }
        try {
            out_.measures = ranked_measures(data(scaling, reached), scaling, features, values);
        } catch (const InputError& error) {
            out_.says.push_back(std::string("Measures are not ranked: ") + error.what());
        }
    }

    const ResultHeader& header_;
    const Study& study_;
    MotionGroups groups_;
    std::vector<Place> places_;
    std::vector<Outcome> outcomes_;
    Fragility out_;
};

} // namespace

Fragility fragility_of(const Study& study, const ResultHeader& header, std::vector<FragilityOutcome> rows)
{
    std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
    return Analysis(study, header, std::move(rows)).run();
}

FragilityTable stored(const Fragility& f)
{
    FragilityTable table;
    table.measure = f.measure;
    table.motion = f.motion;
    table.intensity = f.intensity;
    table.grid = f.grid;
    const auto add = [](IntervalArray& to, double value, const Limits& limits) {
        to.add(value, limits.lower, limits.upper);
    };
    const auto none = std::numeric_limits<double>::quiet_NaN();
    for (const StateFragility& s : f.states) {
        table.states.push_back(s.state.name);
        table.meanings.push_back(s.state.describe);
        table.trials.push_back(static_cast<std::uint64_t>(s.curve.trials));
        table.reached.push_back(static_cast<std::uint64_t>(s.curve.reached));
        add(table.median, s.curve.median.value, s.curve.median.records);
        add(table.dispersion, s.curve.dispersion.value, s.curve.dispersion.records);
        for (std::size_t i = 0; i < f.grid.size(); ++i)
            if (i < s.curve.at.size())
                add(table.curve, s.curve.at[i].probability.value, s.curve.at[i].probability.records);
            else // the data bore no curve at all
                add(table.curve, none, {none, none});
        if (s.stripes && table.stripe.empty())
            for (const StripeShare& share : s.stripes->stripes)
                table.stripe.push_back(share.intensity);
    }
    for (const StateFragility& s : f.states)
        for (std::size_t j = 0; j < table.stripe.size(); ++j)
            if (s.stripes)
                add(table.share, s.stripes->stripes[j].share, s.stripes->stripes[j].limits);
            else
                add(table.share, none, {none, none});
    return table;
}

Study with_structures(Study study, std::uint64_t structures)
{
    study.realizations = structures;
    study.fragility->contacts = study.fragility->twins = 1;
    return study;
}

std::string measure_of(const MotionSetSpec& spec)
{
    return spec.method == FragilityMethod::stripes ? measure_name(spec.measure, spec.period_s) : "pga_m_s2";
}

} // namespace stylobate
