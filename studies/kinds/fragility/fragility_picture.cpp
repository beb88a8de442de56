#include "studies/kinds/fragility/fragility_text.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/figure_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

std::string legend_of(const StateFragility& s)
{
    if (!has_curve(s))
        return s.state.describe + " (no curve)";
    return fmt::format("{} (lack of fit: p = {:.2g}{})", s.state.describe, s.fit.p_value,
                       s.fit.p_value < fit_significance ? ", does not fit" : "");
}

/// A probability with its limits inside 0 to 1; without an interval all three are the value.
void add_point(double x, double value, const Limits& limits, FigureSeries& to)
{
    to.x.push_back(x);
    to.y.push_back(value);
    to.low.push_back(std::isnan(limits.lower) ? value : std::max(limits.lower, 0.0));
    to.high.push_back(std::isnan(limits.upper) ? value : std::min(limits.upper, 1.0));
}

void add_stripes(const StateFragility& s, const std::string& name, Figure& figure)
{
    FigureSeries shares{name, SeriesKind::points, {}, {}, {}, {}, name, "shares of the stripes"};
    FigureSeries monotone{name, SeriesKind::line, {}, {}, {}, {}, name, "monotone curve"};
    for (const StripeShare& stripe : s.stripes->stripes) {
        add_point(stripe.intensity, stripe.share, stripe.limits, shares);
        monotone.x.push_back(stripe.intensity);
        monotone.y.push_back(stripe.monotone);
    }
    figure.series.push_back(std::move(shares));
    if (!has_curve(s) || s.fit.p_value < fit_significance)
        figure.series.push_back(std::move(monotone));
}

void add_state(const StateFragility& s, bool shown, Figure& figure)
{
    const std::string name = legend_of(s);
    const std::size_t first = figure.series.size();
    if (has_curve(s)) {
        FigureSeries curve{name, SeriesKind::line, {}, {}, {}, {}, name, "fitted curve"};
        for (const CurvePoint& at : s.curve.at)
            add_point(at.intensity[0], at.probability.value, at.probability.records, curve);
        figure.series.push_back(std::move(curve));
    }
    if (s.stripes)
        add_stripes(s, name, figure);
    for (std::size_t i = first; i < figure.series.size(); ++i)
        figure.series[i].shown = shown;
}

} // namespace

bool has_curve(const StateFragility& s)
{
    return s.curve.maximum == Maximum::inside && s.curve.median.value > 0 && std::isfinite(s.curve.median.value);
}

namespace {

constexpr std::size_t most_states = 7; ///< as many as there are colours

std::vector<const StateFragility*> chosen(const Fragility& f, const std::vector<std::string>& names)
{
    std::vector<const StateFragility*> all;
    for (const StateFragility& s : f.states)
        if (names.empty() ? s.state.kind == DamageState::Kind::peak || s.state.kind == DamageState::Kind::collapse
                          : std::find(names.begin(), names.end(), s.state.name) != names.end())
            all.push_back(&s);
    for (const std::string& name : names)
        if (std::none_of(all.begin(), all.end(), [&](const auto* s) { return s->state.name == name; })) {
            std::string known;
            for (const StateFragility& s : f.states)
                known += (known.empty() ? "" : ", ") + s.state.name;
            throw InputError(fmt::format("--limit {}: no limit state of this study; it has {}", name, known));
        }
    return all;
}

/// @param shown how many of them are shown at first
Figure figure_of(const Fragility& f, const std::vector<const StateFragility*>& states, std::size_t shown)
{
    Figure figure;
    figure.title = "Fragility curves";
    figure.x_label = describe_measure(f.measure);
    figure.y_label = "probability of reaching the limit state";
    figure.x_log = true;
    for (std::size_t i = 0; i < states.size(); ++i)
        add_state(*states[i], i < shown, figure);
    return figure;
}

} // namespace

const StateFragility* principal_state(const Fragility& f)
{
    const auto found = std::ranges::find_if(f.states, [](const StateFragility& s) {
        return s.state.kind == DamageState::Kind::collapse && s.state.shaking == 0;
    });
    return found != f.states.end() ? &*found : f.states.empty() ? nullptr : &f.states.back();
}

Figure fragility_figure(const Fragility& f)
{
    std::vector<const StateFragility*> states;
    if (const StateFragility* principal = principal_state(f))
        states.push_back(principal);
    for (const DamageState::Kind kind :
         {DamageState::Kind::collapse, DamageState::Kind::peak, DamageState::Kind::residual,
          DamageState::Kind::unseated, DamageState::Kind::total})
        for (const StateFragility& s : f.states)
            if (s.state.kind == kind && &s != states.front())
                states.push_back(&s);
    states.resize(std::min(states.size(), most_states));
    return figure_of(f, states, 1); // the bands of several hide each other
}

void plot_fragility(const Fragility& f, const std::vector<std::string>& names, const std::string& title,
                    const std::filesystem::path& png)
{
    if (f.states.empty())
        throw InputError("there is nothing to draw: " + (f.says.empty() ? "no valid realization" : f.says.front()));
    const std::vector<const StateFragility*> states = chosen(f, names);
    if (states.size() > most_states)
        throw InputError(fmt::format("{} limit states are too many for one picture", states.size()));
    Figure figure = figure_of(f, states, states.size());
    figure.y_range = {-0.015, 1.015};
    write_figure(figure, title,
                 fmt::format("{} · {}", design_text(f),
                             f.different < least_records ? "too few motions for intervals"
                                                         : "bands and bars: 95 % intervals, clustered by motion"),
                 png);
}

} // namespace stylobate
