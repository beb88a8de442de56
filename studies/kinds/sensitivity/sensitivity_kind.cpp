#include "studies/kinds/sensitivity/sensitivity_kind.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/figure_file.hpp"
#include "io/store/surface_axis.hpp"
#include "io/tables/table.hpp"
#include "studies/report/html_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stylobate {

namespace {

std::string interval_text(const IntervalArray& of, std::size_t i)
{
    if (std::isnan(of.value[i]))
        return "not determined";
    return fmt::format("{:.3g} ({:.3g} to {:.3g})", of.value[i], of.lower[i], of.upper[i]);
}

/// An index of a factor. The rest has no part in the mean over it.
std::string index_text(const SensitivityTable& table, const SensitivityTable::Index& index, std::size_t outcome,
                       std::size_t factor)
{
    if (table.factors[factor] == rest_name && !index.name.starts_with("value_"))
        return "–";
    return interval_text(index.of, outcome * table.factors.size() + factor);
}

std::string spoken(std::string name)
{
    for (char& c : name)
        if (c == '_')
            c = ' ';
    return name;
}

/// Heading of a column.
std::string heading(const std::string& index)
{
    if (index == "first" || index == "total")
        return index + " index";
    if (index.starts_with("value_"))
        return index.substr(6) + ", of single outcomes";
    return index == "mu_star" ? "mu*" : index;
}

std::string design_text(const SensitivityTable& table)
{
    return fmt::format("{} rows of {} points{}", table.rows,
                       table.acts.size() + (table.method == "sobol" ? 2 : 1) -
                           (table.factors.back() == rest_name ? 1 : 0),
                       table.inner > 1 ? fmt::format(" with {} realizations", table.inner) : "");
}

std::string mean_text(const SensitivityTable& table, std::size_t outcome)
{
    const std::string unit = table.units[outcome].empty() ? "" : " " + table.units[outcome];
    std::string text = fmt::format("mean {}{}", interval_text(table.mean, outcome), unit);
    if (!table.explained.value.empty() && table.inner > 1 && !std::isnan(table.explained.value[outcome]))
        text += fmt::format("; the factors explain {} of the variance of single outcomes",
                            interval_text(table.explained, outcome));
    return text;
}

/// Wider intervals of Sobol's indices are reported as too wide.
constexpr double widest = 0.2;

/// Whether the rows were too few, and how many would do: the width falls as one over their root.
std::optional<std::string> too_few_rows(const SensitivityTable& table)
{
    const std::size_t n = table.factors.size();
    double width = 0;
    std::string widest_one;
    std::optional<std::string> impossible;
    const auto known = [&](const SensitivityTable::Index& index, std::size_t o) { // of any factor of the outcome
        for (std::size_t k = 0; k < n; ++k)
            if (!std::isnan(index.of.value[o * n + k]))
                return true;
        return false;
    };
    for (const char* name : {"first", "total"})
        for (std::size_t o = 0; o < table.outcomes.size(); ++o)
            for (std::size_t k = 0; k < n; ++k) {
                const SensitivityTable::Index* index = table.find(name);
                const std::size_t i = o * n + k;
                if (!index || table.factors[k] == rest_name || !known(*index, o))
                    continue;
                const std::string which = fmt::format("the {} of {} ({})", heading(name), spoken(table.factors[k]),
                                                      spoken(table.outcomes[o]));
                if (std::isnan(index->of.value[i]) && !impossible)
                    impossible = which;
                if (index->of.upper[i] - index->of.lower[i] > width) {
                    width = index->of.upper[i] - index->of.lower[i];
                    widest_one = which;
                }
            }
    if (!impossible && width <= widest)
        return std::nullopt;
    // where nothing of an interval is possible, half its width is asked for
    const double times = std::max(std::pow(width / widest, 2), impossible ? 4.0 : 1.0);
    const double wanted = times * static_cast<double>(table.rows + table.invalid_rows);
    const double unit = std::pow(10, std::floor(std::log10(wanted)) - 1);
    std::string text = "Too few samples: ";
    if (impossible)
        text += fmt::format("the interval of {} lies outside 0 to 1, so it is not determined; ", *impossible);
    if (width > 0)
        text += fmt::format("the widest interval, of {}, is {:.2g} wide. ", widest_one, width);
    return text + fmt::format("Raise sensitivity.samples to about {:.0f}.", std::ceil(wanted / unit) * unit);
}

std::string explanation(const SensitivityTable& table)
{
    if (table.method == "morris")
        return "Effects of a change of a factor by half its probability range, per range. mu*: their mean absolute "
               "value; rms: their root mean square without the noise of the trials; mu: their signed mean; sigma: "
               "their standard deviation over the design.";
    return table.inner > 1 ? "Shares of the variance: of the mean over all quantities that are not factors (of the "
                             "probability, where the outcome is a collapse), and of single outcomes. First: by the "
                             "factor alone; total: including its interactions."
                           : "Shares of the variance. First: by the factor alone; total: including its interactions.";
}

} // namespace

std::vector<std::string> sensitivity_remarks(const SensitivityTable& table)
{
    std::vector<std::string> remarks;
    for (std::size_t k = 0; k < table.factors.size(); ++k)
        if (!table.acts[k])
            remarks.push_back(
                fmt::format("{} has no effect: it changed no outcome of any realization.", spoken(table.factors[k])));
    for (std::size_t o = 0; o < table.outcomes.size(); ++o) {
        bool known = false;
        for (std::size_t k = 0; k < table.factors.size(); ++k)
            known = known || !std::isnan(table.indices[1].of.value[o * table.factors.size() + k]);
        if (std::isnan(table.mean.value[o])) // (nothing is known of it)
            remarks.push_back(
                fmt::format("{}: not determined, because in nearly every row of the design a structure still "
                            "moved at the end. Give excitation.tail_s = \"rest\", or more damping.",
                            spoken(table.outcomes[o])));
        else if (!known)
            remarks.push_back(fmt::format("{}: its {} not significantly different from zero, so it cannot be divided "
                                          "among the factors. More rows, or a shaking at which it varies, may help.",
                                          spoken(table.outcomes[o]),
                                          table.inner > 1 ? "mean's variance is" : "variance is"));
    }
    if (const std::optional<std::string> few = too_few_rows(table))
        remarks.push_back(*few);
    if (table.invalid_rows > 0)
        remarks.push_back(
            fmt::format("{} rows were omitted because they contain an invalid realization.", table.invalid_rows));
    return remarks;
}

void add_sensitivity(Document& page, const SensitivityTable& table)
{
    page.note(fmt::format("{}; in brackets: {}.", design_text(table), describe_interval(table.interval)));
    for (std::size_t o = 0; o < table.outcomes.size(); ++o) {
        HtmlTable of{"l" + std::string(table.indices.size(), 'r'), {"factor"}, {}, ""};
        of.caption = fmt::format("{} ({}): {}", spoken(table.outcomes[o]), table.meanings[o], mean_text(table, o));
        for (const SensitivityTable::Index& index : table.indices)
            of.head.emplace_back(heading(index.name));
        for (std::size_t k = 0; k < table.factors.size(); ++k) {
            std::vector<Html> row = {spoken(table.factors[k])};
            for (const SensitivityTable::Index& index : table.indices)
                row.emplace_back(index_text(table, index, o, k));
            of.rows.push_back(std::move(row));
        }
        page.table(of);
    }
    for (const std::string& remark : sensitivity_remarks(table))
        page.note(remark);
}

std::string sensitivity_text(const SensitivityTable& table)
{
    Document page;
    add_sensitivity(page, table);
    return console_text(page);
}

Json sensitivity_json(const SensitivityTable& table)
{
    const auto estimate = [](const IntervalArray& of, std::size_t i) {
        return Json::object().member("value", of.value[i]).member("lower", of.lower[i]).member("upper", of.upper[i]);
    };
    Json outcomes = Json::object();
    const std::size_t n = table.factors.size();
    for (std::size_t o = 0; o < table.outcomes.size(); ++o) {
        Json outcome = Json::object();
        outcome.member("unit", table.units[o]).member("meaning", table.meanings[o]);
        outcome.member("mean", estimate(table.mean, o));
        if (!table.explained.value.empty())
            outcome.member("explained", estimate(table.explained, o));
        Json factors = Json::object();
        for (std::size_t k = 0; k < n; ++k) {
            Json factor = Json::object();
            for (const SensitivityTable::Index& index : table.indices)
                factor.member(index.name, estimate(index.of, o * n + k));
            factors.member(table.factors[k], factor);
        }
        outcomes.member(table.outcomes[o], outcome.member("factors", factors));
    }
    return Json::object()
        .member("method", table.method)
        .member("interval", table.interval)
        .member("rows", table.rows)
        .member("invalid_rows", table.invalid_rows)
        .member("inner", table.inner)
        .member("outcomes", outcomes)
        .member("remarks", Json::list(sensitivity_remarks(table)));
}

Figure sensitivity_figure(const SensitivityTable& table, std::size_t outcome)
{
    const bool sobol = table.method == "sobol";
    Figure figure;
    figure.title = "Sensitivity of " + spoken(table.outcomes[outcome]);
    figure.y_label = sobol || table.units[outcome].empty() ? "index" : "index [" + table.units[outcome] + "]";
    for (const std::string& factor : table.factors)
        figure.x_ticks.push_back(spoken(factor));
    const std::size_t n = table.factors.size();
    for (const SensitivityTable::Index& index : table.indices) {
        FigureSeries bars{heading(index.name), SeriesKind::bars, {}, {}, {}, {}};
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t i = outcome * n + k;
            bars.x.push_back(static_cast<double>(k));
            bars.y.push_back(index.of.value[i]);
            bars.low.push_back(index.of.lower[i]);
            bars.high.push_back(index.of.upper[i]);
        }
        figure.series.push_back(std::move(bars));
    }
    return figure;
}

void plot_sensitivity(const SensitivityTable& table, const std::string& title, const std::filesystem::path& file)
{
    if (table.empty())
        throw InputError("there are no sensitivities to draw");
    std::vector<Figure> figures;
    for (std::size_t o = 0; o < table.outcomes.size(); ++o) {
        figures.push_back(sensitivity_figure(table, o));
        figures.back().title = spoken(table.outcomes[o]);
        if (table.method == "sobol")
            figures.back().y_range = {-0.03, 1.03};
    }
    write_figures(figures, 2, title, fmt::format("{} rows · bars: {}", table.rows, describe_interval(table.interval)),
                  file);
}

SensitivityKind::SensitivityKind(const Study& study, const ResultHeader& header)
    : Kind(study, header), outcomes_(study, header.input_names)
{
}

std::string SensitivityKind::text() const
{
    return Kind::text() + sensitivity_text(table_);
}

void SensitivityKind::add_to(Json& json) const
{
    json.member("sensitivity", sensitivity_json(table_));
}

Picture SensitivityKind::picture(const ResultReader& reader, const std::string& results, const PictureRequest&) const
{
    check_complete(reader, results);
    return {
        "sensitivity", "Sensitivity to the factors", "",
        [this](const std::string& title, const std::filesystem::path& file) { plot_sensitivity(table_, title, file); }};
}

std::vector<std::pair<std::string, std::string>> SensitivityKind::files(const std::string& format,
                                                                        const std::string& name) const
{
    auto files = Kind::files(format, name);
    files.emplace_back("sensitivity.csv", csv_text(listed(table_)));
    return files;
}

std::optional<Answer> SensitivityKind::answer() const
{
    const SensitivityTable::Index* index = table_.find("total");
    if (!index && !table_.indices.empty())
        index = &table_.indices.front();
    if (!index || table_.outcomes.empty())
        return std::nullopt;
    std::size_t most = table_.factors.size();
    for (std::size_t k = 0; k < table_.factors.size(); ++k) // of the first outcome, the collapse
        if (table_.factors[k] != rest_name && std::isfinite(index->of.value[k]) &&
            (most == table_.factors.size() || index->of.value[k] > index->of.value[most]))
            most = k;
    const std::string outcome = spoken(table_.outcomes.front());
    if (most == table_.factors.size())
        return Answer{"Which factor decides about " + outcome + " is not determined.", design_text(table_) + "."};
    bool apart = true;
    for (std::size_t k = 0; k < table_.factors.size(); ++k)
        apart = apart && (k == most || table_.factors[k] == rest_name || index->of.upper[k] < index->of.lower[most]);
    return Answer{fmt::format(fmt::runtime(apart ? "Of the factors, {1} decides most about {0}: {2} {3:.2g} to {4:.2g} "
                                                   "(95 % interval)."
                                                 : "Which factor decides most about {0} is open: {1} has the largest "
                                                   "{2}, {3:.2g} to {4:.2g} (95 % interval)."),
                              outcome, spoken(table_.factors[most]), heading(index->name), index->of.lower[most],
                              index->of.upper[most]),
                  fmt::format("Best estimate {:.2g}; {}.", index->of.value[most], design_text(table_))};
}

void SensitivityKind::sections(PageWriter& writer) const
{
    writer.page.section("Sensitivity to the factors");
    writer.page.paragraph(explanation(table_));
    for (std::size_t o = 0; o < table_.outcomes.size(); ++o)
        writer.page.figure(figure_svg(sensitivity_figure(table_, o), 220),
                           fmt::format("Indices of {}, with their intervals.", spoken(table_.outcomes[o])));
    add_sensitivity(writer.page, table_);
}

} // namespace stylobate
