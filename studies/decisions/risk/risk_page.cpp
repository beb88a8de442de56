#include "studies/decisions/risk/risk_text.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/figure_file.hpp"
#include "studies/report/html_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

/// Of the axis that the three panels share.
std::array<double, 2> shared_range(const StateRisk& s)
{
    return {0.97 * s.estimate.parts.front().to, 1.03 * s.estimate.parts.back().from};
}

/// Intensities of a curve that is drawn over the range of a limit state's parts.
std::vector<double> grid_over(const StateRisk& s)
{
    constexpr int points = 80;
    const double low = s.estimate.parts.front().to, high = s.estimate.parts.back().from;
    std::vector<double> grid;
    for (int i = 0; i <= points; ++i)
        grid.push_back(low * std::pow(high / low, static_cast<double>(i) / points));
    return grid;
}

Figure hazard_figure(const Risk& risk, const StateRisk& s)
{
    Figure figure;
    figure.title = "Hazard";
    figure.y_label = "exceeded [1/year]";
    figure.x_log = figure.y_log = true;
    const HazardCurve best = best_curve(risk.hazard);
    FigureSeries line{"", SeriesKind::line, grid_over(s), {}, {}, {}};
    for (const double im : line.x)
        line.y.push_back(best.frequency(std::log(im)));
    if (!risk.hazard.fractiles.empty()) {
        const HazardCurve low = quantile_curve(risk.hazard, (1 - risk.level) / 2),
                          high = quantile_curve(risk.hazard, (1 + risk.level) / 2);
        for (const double im : line.x) {
            line.low.push_back(low.frequency(std::log(im)));
            line.high.push_back(high.frequency(std::log(im)));
        }
    }
    figure.series.push_back(std::move(line));
    return figure;
}

Figure state_figure(const StateRisk& s)
{
    Figure figure;
    figure.title = "Fragility";
    figure.y_label = "probability";
    figure.x_log = true;
    figure.y_range = {-0.02, 1.02};
    FigureSeries line{s.meaning, SeriesKind::line, {}, {}, {}, {}, s.meaning};
    FigureSeries points{s.meaning, SeriesKind::points, {}, {}, {}, {}, s.meaning};
    FigureSeries& limits = s.form == FragilityForm::shares ? points : line;
    const auto [from, to] = shared_range(s);
    for (const FragilityPoint& p : s.fragility) {
        if (p.intensity < from || p.intensity > to)
            continue;
        line.x.push_back(p.intensity);
        line.y.push_back(p.probability);
        limits.low.push_back(p.lower);
        limits.high.push_back(p.upper);
    }
    if (s.form == FragilityForm::shares) {
        points.x = line.x;
        points.y = line.y;
    }
    figure.series = {line, points};
    return figure;
}

Figure parts_figure(const Risk& risk, const StateRisk& s)
{
    Figure figure;
    figure.title = "Disaggregation";
    figure.x_label = describe_measure(risk.hazard.measure);
    figure.y_label = "parts [1/year]";
    figure.x_log = true;
    double most = 0, upper = 0;
    for (const FrequencyPart& part : s.estimate.parts)
        if (part.from > 0 && std::isfinite(part.to) && part.frequency.value > 0) {
            most = std::max(most, part.frequency.value);
            upper = std::max(upper, part.frequency.total.upper);
        }
    // by the values: limits may be far beyond, and are in the table
    if (most > 0)
        figure.y_range = {0, 1.05 * std::max(most, std::min(upper, 2.5 * most))};
    FigureSeries steps{"", SeriesKind::line, {}, {}, {}, {}, ""}, points = steps;
    points.kind = SeriesKind::points;
    for (const FrequencyPart& part : s.estimate.parts) {
        if (part.from == 0 || std::isinf(part.to))
            continue;
        const RiskNumber& f = part.frequency;
        steps.x.insert(steps.x.end(), {part.from, part.to});
        steps.y.insert(steps.y.end(), {f.value, f.value});
        points.x.push_back(std::sqrt(part.from * part.to));
        points.y.push_back(f.value);
        // limits of what no run has shown are in the table
        points.low.push_back(f.value > 0 ? f.total.lower : std::nan(""));
        points.high.push_back(f.value > 0 ? std::min(f.total.upper, (*figure.y_range)[1]) : std::nan(""));
    }
    figure.series = {std::move(steps), std::move(points)};
    return figure;
}

/// The three parts of one limit state, over the same intensities.
std::vector<Figure> risk_figures(const Risk& risk, const StateRisk& state)
{
    std::vector<Figure> figures{hazard_figure(risk, state), state_figure(state), parts_figure(risk, state)};
    for (Figure& figure : figures) // one axis of the intensity for all three
        figure.x_range = shared_range(state);
    return figures;
}

void add_part_figures(const Risk& risk, Document& page)
{
    const StateRisk& s = risk.principal();
    if (!s.determined || !(s.estimate.frequency.value > 0))
        return;
    const std::vector<Figure> figures = risk_figures(risk, s);
    page.figure(figure_svg(figures[0], 200),
                risk.hazard.fractiles.empty()
                    ? std::string("Hazard: how often an intensity is exceeded.")
                    : fmt::format("Hazard: how often an intensity is exceeded; band: {:g} %, by its fractiles.",
                                  100 * risk.level));
    page.figure(figure_svg(figures[1], 200),
                fmt::format("Fragility: probability of the limit state '{}'; band or bars: "
                            "{:g} %, by the motions.",
                            s.meaning, 100 * risk.fragility_level));
    page.figure(
        figure_svg(figures[2], 200),
        fmt::format("How often the limit state is reached by the intensities between two stripes; bars: {:g} %. "
                    "A bar that ends at the upper edge goes on: the table has its limit.",
                    100 * risk.level));
}

} // namespace

Document risk_page(const Risk& risk, const std::string& file, const std::optional<std::string>& title)
{
    Document page(title.value_or("Risk: " + risk.title),
                  fmt::format("Fragility of {}, hazard {}. Made by stylobate {}.", risk.fragility_file,
                              hazard_text(risk.hazard), risk.code_version));
    add_answer(risk, page);
    add_result(risk, page);
    add_parts(risk, page);
    add_part_figures(risk, page);
    add_notes(risk, page);
    page.section("Reproduction");
    page.facts({{"This estimate", std::filesystem::path(file).filename().string()},
                {"Fragility", risk.fragility_file},
                {"Hazard", risk.hazard.source}});
    page.details("The study of the fragility", [&] { page.block(risk.study_text); });
    return page;
}

namespace {

const StateRisk& state_named(const Risk& risk, const std::optional<std::string>& name)
{
    if (!name)
        return risk.principal();
    std::vector<std::string> names;
    for (const StateRisk* s : risk.chosen()) {
        if (s->state == name)
            return *s;
        names.push_back(s->state);
    }
    throw InputError(
        fmt::format("--limit {}: no limit state of this estimate; it has {}", *name, fmt::join(names, ", ")));
}

} // namespace

void plot_risk(const Risk& risk, const std::optional<std::string>& name, const std::optional<std::string>& title,
               const std::filesystem::path& picture)
{
    const StateRisk& s = state_named(risk, name);
    if (!s.determined)
        throw InputError(fmt::format("{}: the frequency of '{}' is not determined, so its parts are not drawn.\n  {}",
                                     picture.string(), s.state, s.note));
    if (std::ranges::none_of(s.estimate.parts, [](const FrequencyPart& p) {
            return p.from > 0 && std::isfinite(p.to) && p.frequency.value > 0;
        }))
        throw InputError(fmt::format("{}: no run of the study reached '{}' within its intensities, so there is nothing "
                                     "to draw.",
                                     picture.string(), s.state));
    write_figures(risk_figures(risk, s), 1, title.value_or("Risk: " + risk.title),
                  fmt::format("{}: {} a year; bands and bars: {:g} % (fragility: {:g} %)", s.state,
                              frequency_text(s.estimate.frequency), 100 * risk.level, 100 * risk.fragility_level),
                  picture);
}

namespace {

const StateChange& state_named(const RiskChange& change, const VariantChange& variant,
                               const std::optional<std::string>& name)
{
    if (!name)
        return variant.principal();
    std::string known;
    for (const StateChange& s : variant.states) {
        if (s.state == name)
            return s;
        known += (known.empty() ? "" : ", ") + s.state;
    }
    throw InputError(fmt::format("--limit {}: no limit state of {}; it has {}", *name, change.comparison_file, known));
}

/// Shares by stripe of the base and the variants.
Figure shares_figure(const RiskChange& change, const std::string& state)
{
    const StateChange& first = state_named(change, change.variants.front(), state);
    Figure figure;
    figure.title = "Shares of '" + first.meaning + "'";
    figure.x_label = describe_measure(change.hazard.measure);
    figure.y_label = "share";
    figure.x_log = true;
    figure.x_range = {0.97 * change.intensity.front(), 1.03 * change.intensity.back()};
    figure.y_range = {-0.02, 1.02};
    const auto add = [&](const std::string& name, const std::vector<double>& share) {
        const std::vector<double> x(change.intensity.begin(),
                                    change.intensity.begin() + static_cast<std::ptrdiff_t>(share.size()));
        figure.series.push_back({name, SeriesKind::line, x, share, {}, {}, name});
        figure.series.push_back({name, SeriesKind::points, x, share, {}, {}, name});
    };
    add(change.base_name, first.base_share);
    for (const VariantChange& variant : change.variants)
        add(variant.name, state_named(change, variant, state).variant_share);
    return figure;
}

/// Change of the probability over the years, a point for each variant of which it is determined.
Figure changes_figure(const RiskChange& change, const std::string& state)
{
    Figure figure;
    figure.title = "Change of the probability";
    figure.y_label = "change [percentage points]";
    FigureSeries points{"", SeriesKind::points, {}, {}, {}, {}};
    for (const VariantChange& variant : change.variants) {
        const double at = static_cast<double>(figure.x_ticks.size());
        figure.x_ticks.push_back(variant.name);
        const StateChange& s = state_named(change, variant, state);
        if (!s.determined)
            continue;
        const ChangeNumber& p = s.change.probability.back();
        points.x.push_back(at);
        points.y.push_back(100 * p.value);
        points.low.push_back(100 * p.total.lower);
        points.high.push_back(100 * p.total.upper);
    }
    const double last = static_cast<double>(change.variants.size()) - 0.4;
    figure.series = {{"", SeriesKind::line, {-0.6, last}, {0, 0}, {}, {}}, std::move(points)};
    figure.series[0].colour = "#5a6672"; // no change
    return figure;
}

} // namespace

void add_change_figures(const RiskChange& change, Document& page)
{
    const StateChange& first = change.variants.front().principal();
    const Figure changes = changes_figure(change, first.state);
    page.figure(figure_svg(shares_figure(change, first.state), 240),
                fmt::format("Share of the realizations that reach the limit state '{}', by stripe.", first.meaning));
    if (!changes.series.back().x.empty())
        page.figure(figure_svg(changes, 200),
                    fmt::format("Change of the probability in {:g} years, variant minus base; "
                                "bars: {:g} %.",
                                change.years.back(), 100 * change.level));
}

void plot_risk(const RiskChange& change, const std::optional<std::string>& state,
               const std::optional<std::string>& title, const std::filesystem::path& picture)
{
    const StateChange& first = state_named(change, change.variants.front(), state);
    const Figure shares = shares_figure(change, first.state), changed = changes_figure(change, first.state);
    if (changed.series.back().x.empty())
        throw InputError(fmt::format("{}: no change of '{}' is determined, so none is drawn.\n  {}", picture.string(),
                                     first.state, first.note));
    write_figures({shares, changed}, 1, title.value_or("Change of risk: " + change.title),
                  fmt::format("{} · {} motions · below: change of the probability in {:g} years, bars: {:g} %",
                              first.meaning, change.motions, change.years.back(), 100 * change.level),
                  picture);
}

} // namespace stylobate
