#include "studies/decisions/compare/comparison_text.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/plots/figure_file.hpp"
#include "io/plots/plot_maps.hpp"
#include "io/study/study_file.hpp"
#include "studies/decisions/compare/study_difference.hpp"
#include "studies/experiment/conventions.hpp"
#include "studies/kinds/fragility/fragility.hpp"
#include "studies/report/html_figure.hpp"
#include "studies/report/left_out.hpp"
#include "studies/results/structure_sketch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

namespace stylobate {

namespace {

/// The shares of a limit state of the base and of all variants, by stripe.
Figure stripes_figure(const Comparison& c, const std::string& limit)
{
    Figure figure;
    figure.title = "Shares of " + limit;
    figure.x_label = describe_measure(c.measure);
    figure.y_label = "probability of reaching the limit state";
    figure.x_log = true;
    const auto add = [&](const LimitComparison& of, const std::string& name, Share PlaceComparison::*side) {
        FigureSeries points{name, SeriesKind::points, c.intensity, {}, {}, {}, name, "shares"};
        FigureSeries line{name, SeriesKind::line, c.intensity, {}, {}, {}, name, "lines"};
        for (const PlaceComparison& place : of.cells) {
            points.y.push_back((place.*side).probability);
            points.low.push_back((place.*side).lower);
            points.high.push_back((place.*side).upper);
            line.y.push_back((place.*side).probability);
        }
        figure.series.push_back(std::move(line));
        figure.series.push_back(std::move(points));
    };
    add(limit_of(c.variants.front(), limit), c.base_name, &PlaceComparison::base);
    for (const VariantComparison& variant : c.variants)
        add(limit_of(variant, limit), variant.name, &PlaceComparison::variant);
    return figure;
}

namespace fs = std::filesystem;

std::string unknown_text(const VariantComparison& variant, const LimitComparison& limit)
{
    const std::uint64_t unknown = variant.unknown(limit);
    return unknown > 0 ? fmt::format(" ({} pairs left out: still moving at the end)", unknown) : std::string();
}

/// "dowels: the probability of collapse changes by -10.2 to +5.8 percentage points (95 % interval)"
std::string answer_title(const Comparison& comparison, const VariantComparison& variant)
{
    const LimitComparison& limit = variant.limits.front();
    if (limit.overall.counts.pairs() == 0)
        return variant.name;
    return fmt::format("{}: the probability of {} changes by {} ({:g} % interval)", variant.name, limit.name,
                       points_text(limit.overall), 100 * comparison.level);
}

Html verdict_tag(const LimitComparison& limit, const PlaceComparison& place)
{
    switch (limit.verdict(place)) {
    case ChangeVerdict::better:
        return tag("good", "better");
    case ChangeVerdict::worse:
        return tag("bad", "worse");
    default:
        return verdict_text(limit, place);
    }
}

class ComparisonPage {
public:
    ComparisonPage(const Comparison& comparison, const std::string& file, const std::optional<std::string>& title,
                   std::vector<std::string>& warnings)
        : c_(comparison), file_(file), warnings_(warnings),
          page_(title.value_or("Comparison with " + (c_.title.empty() ? c_.base_name : c_.title)),
                fmt::format("{}. Made by stylobate {}.", file, c_.code_version))
    {
    }

    Document page()
    {
        page_.section("The answer");
        answers();
        page_.section("The intervention");
        interventions();
        page_.section("What the answer depends on");
        dependence();
        page_.section("What changes");
        page_.paragraph(
            common_text(c_) +
            fmt::format(" Differences are variant minus base, with paired intervals at {:g} %.", 100 * c_.level));
        overall();
        capacities();
        pictures();
        named();
        page_.section("What is common");
        common();
        page_.section("Reproduction");
        commands();
        page_.details("The study of the base, " + c_.base_name, [&] { page_.block(c_.base_toml); });
        for (const VariantComparison& variant : c_.variants)
            page_.details("The study of " + variant.name, [&] { page_.block(variant.study_toml); });
        return std::move(page_);
    }

private:
    void answers()
    {
        for (const VariantComparison& variant : c_.variants) {
            if (variant.limits.empty())
                continue;
            const LimitComparison& limit = variant.limits.front();
            const ChangeVerdict verdict = limit.verdict(limit.overall);
            page_.box(verdict == ChangeVerdict::better  ? "good"
                      : verdict == ChangeVerdict::worse ? "bad"
                                                        : "warn",
                      answer_title(c_, variant), answer_text(c_, variant));
            if (const std::optional<std::string> harm = harm_text(c_, variant))
                page_.note(variant.name + ": " + *harm);
        }
        if (const std::optional<std::string> conventions = conventions_text_of(c_.base_toml))
            page_.note(fmt::format("Conventions of {}: {}.", c_.base_name, *conventions));
        add_left_out_of(page_, c_.base_toml);
    }

    /// Draws it, or says why not.
    void picture(const char* what, const std::string& caption, const std::function<void(const fs::path& png)>& draw)
    {
        try {
            const TemporaryFolder folder;
            const fs::path png = folder / "picture.svg";
            draw(png);
            page_.figure(svg_image(png, caption), caption);
        } catch (const InputError& error) {
            warnings_.push_back(fmt::format("{} was not drawn: {}", what, error.what()));
            page_.note(fmt::format("{} was not drawn: {}", what, error.what()));
        }
    }

    /// The structures beside each other, and the keys in which the studies differ.
    void interventions()
    {
        const Study base = parse_study(c_.base_toml, c_.base_name);
        Html drawings = Html::ready("<div class=\"beside\">");
        const auto add = [&](const std::string& name, const Html& drawing) {
            drawings += Html::ready("<div><strong>");
            drawings += name;
            drawings += Html::ready("</strong>");
            drawings += drawing;
            drawings += Html::ready("</div>");
        };
        add(c_.base_name, structure_sketch(base, &base));
        std::vector<std::string> texts{c_.base_toml};
        for (const VariantComparison& variant : c_.variants) {
            add(variant.name, structure_sketch(parse_study(variant.study_toml, variant.name), &base));
            texts.push_back(variant.study_toml);
        }
        drawings += Html::ready("</div>");
        page_.figure(drawings, sketch_caption(base) + " Marked in colour: what the base does not have.");
        differences(texts);
    }

    void differences(const std::vector<std::string>& texts)
    {
        const std::vector<DifferentKey> keys = different_keys(texts);
        if (keys.empty()) {
            page_.paragraph("The studies have the same values in all keys.");
            return;
        }
        HtmlTable table{"l", {"key"}, {}, "The keys in which the studies differ"};
        for (std::size_t i = 0; i < texts.size(); ++i) {
            table.align += "l";
            table.head.emplace_back(i == 0 ? c_.base_name : c_.variants[i - 1].name);
        }
        for (const DifferentKey& different : keys) {
            std::vector<Html>& row = table.rows.emplace_back(std::vector<Html>{code(different.key)});
            for (const std::optional<std::string>& value : different.values)
                row.push_back(value ? code(*value) : Html("–"));
        }
        page_.table(table);
    }

    void dependence()
    {
        if (c_.motions > 0)
            page_.paragraph("Pairs share motions here, so no test by drawn quantity was made. How much the answer "
                            "depends on the motions is in the width of its intervals, which take motions, and not "
                            "pairs, as independent.");
        else if (c_.adaptive_budget > 0)
            page_.paragraph("No test by drawn quantity was made: an adaptive comparison chooses the number of pairs of "
                            "a cell by their outcomes.");
        else if (std::ranges::all_of(c_.variants, [](const auto& variant) { return variant.depends.empty(); }))
            page_.paragraph("No test by drawn quantity was made: none varies among the pairs of the base.");
        else
            page_.paragraph(fmt::format(
                "Differences of the first limit state in the lower, middle and upper third of each drawn quantity, "
                "means over the cells. A quantity counts where the adjusted p-value of its rank test is at most {:g}.",
                c_.rate));
        for (const VariantComparison& variant : c_.variants) {
            if (variant.limits.empty())
                continue;
            HtmlTable table{
                "lrrrr", {"quantity", "lower third", "middle third", "upper third", "adjusted p"}, {}, variant.name};
            for (const InputDependence& input : variant.depends) {
                std::vector<Html> row = {input.input};
                for (const PairedDifference& third : input.found.thirds)
                    row.emplace_back(
                        fmt::format("{:+.3f} ({:+.3f} to {:+.3f})", third.value, third.lower, third.upper));
                row.emplace_back(fmt::format("{:.2g}", input.p_adjusted));
                table.rows.push_back(std::move(row));
            }
            if (!table.rows.empty())
                page_.table(table);
            page_.heading("What would change it: " + variant.name);
            std::vector<Html> items;
            for (const std::string& sentence : what_would_change_it(c_, variant))
                items.emplace_back(sentence);
            page_.list(items);
        }
        page_.note(
            "Not examined: what the studies hold fixed. Another structure, shaking, contact form or range of the "
            "drawn quantities can have another answer.");
    }

    void commands()
    {
        std::string studies = "base.toml", results = c_.base_results;
        for (std::size_t i = 0; i < c_.variants.size(); ++i) {
            studies += fmt::format(" variant_{}.toml", i + 1);
            results += " " + c_.variants[i].results;
        }
        const std::string file = fs::path(file_).filename().string();
        std::string options = " -o " + file;
        if (c_.level != interval_level)
            options += fmt::format(" --level {}", c_.level);
        const std::string again = "The studies above, in files of their own, give the same numbers with the same "
                                  "version of the program.";
        if (c_.adaptive_budget > 0) {
            page_.paragraph(again);
            page_.block(fmt::format("stylobate compare {} --adaptive {} --margin {}{}\nstylobate report {}\n", studies,
                                    c_.adaptive_budget, c_.adaptive_margin, options, file));
            return;
        }
        page_.paragraph(again + " The second command uses the results that exist.");
        page_.block(fmt::format("stylobate compare {0}{2}\nstylobate compare {1}{2}\nstylobate report {3}\n", studies,
                                results, options, file));
    }

    void overall()
    {
        for (const VariantComparison& variant : c_.variants) {
            HtmlTable table{"lrrrrl",
                            {"limit state", "base", variant.name, "difference", "saved by pairing", "verdict"},
                            {},
                            fmt::format("{}: {} pairs", variant.name, variant.pairs)};
            if (variant.dropped > 0)
                table.caption += fmt::format(", {} dropped as invalid in either", variant.dropped);
            for (const LimitComparison& limit : variant.limits)
                table.rows.push_back({limit.describe + unknown_text(variant, limit), share_text(limit.overall.base),
                                      share_text(limit.overall.variant), difference_text(limit.overall),
                                      std::isfinite(limit.overall.unpaired)
                                          ? fmt::format("a factor of {:.2g}", limit.overall.saving())
                                          : "unknown",
                                      verdict_tag(limit, limit.overall)});
            page_.table(table);
        }
    }

    /// Of the first limit state, a column for each variant.
    void capacities()
    {
        HtmlTable table{"l", {"shaking"}, {}, {}};
        for (const VariantComparison& variant : c_.variants) {
            const std::vector<CapacityRow> rows = capacity_rows(c_, variant.limits.front());
            if (rows.empty())
                return;
            table.align += "r";
            table.head.emplace_back(variant.name);
            table.rows.resize(rows.size());
            for (std::size_t i = 0; i < rows.size(); ++i) {
                if (table.rows[i].empty())
                    table.rows[i].emplace_back(rows[i].place);
                table.rows[i].emplace_back(capacity_text(rows[i].ratio));
            }
        }
        table.caption = fmt::format("Capacity ({} at {}) over that of the base", capacity_measure(c_),
                                    c_.variants.front().limits.front().name);
        page_.table(table);
        page_.note(
            "The ratio of the geometric means over the realizations. Capacities beyond the range of the study "
            "count as at its end, and between two intensities of the study (\"steps\") the shares are not known, "
            "so that the ratio may be off by this factor: more intensities make it sharper. The ratio is a bound where "
            "the two still differ there, and drawn towards 1 "
            "where a part of both stands at the strongest shaking or falls at the weakest.");
    }

    void pictures()
    {
        const std::string limit = c_.variants.front().limits.front().name;
        if (!c_.intensity.empty())
            return stripes(limit);
        if (c_.cells() == 0)
            return;
        picture("the map",
                "Change of " + limit + " over " + c_.row_quantity().name +
                    " and PGA. Cells in full colours are named: " + adjustment_text(c_) + ".",
                [&](const fs::path& png) { comparison_picture(c_, limit, std::nullopt, png); });
    }

    void stripes(const std::string& limit)
    {
        page_.figure(
            figure_svg(stripes_figure(c_, limit)),
            fmt::format("Shares of {} by stripe, with intervals of each share by the motions. The intervals of "
                        "differences are narrower.",
                        limit));
    }

    void named()
    {
        if (c_.places() == 1)
            return;
        page_.section("Where it changes");
        page_.paragraph("Cells that are named by the exact test of their discordant pairs, over all cells of a limit "
                        "state: " +
                        adjustment_text(c_) + ".");
        for (const VariantComparison& variant : c_.variants) {
            std::string none; // limit states of which no cell is named
            for (const LimitComparison& limit : variant.limits) {
                if (!limit.damage)
                    continue;
                const bool worse = list(variant, limit, true), better = list(variant, limit, false);
                if (!worse && !better)
                    none += (none.empty() ? "" : ", ") + limit.name;
            }
            if (!none.empty())
                page_.note(fmt::format("{}: no cell is named of {}.", variant.name, none));
        }
    }

    /// @returns whether a cell is named
    bool list(const VariantComparison& variant, const LimitComparison& limit, bool worse)
    {
        const std::vector<std::size_t> cells = limit.named(c_.rate, worse);
        const std::string what = fmt::format("{}: {} {} in {} of {} cells", variant.name, limit.name,
                                             worse ? "worse" : "better", cells.size(), limit.cells.size());
        if (cells.empty())
            return false;
        HtmlTable table{"lrrrr", {"place", "base", variant.name, "difference", "adjusted p"}, {}, what};
        for (const std::size_t cell : cells)
            table.rows.push_back({c_.place(cell), fmt::format("{:.3f}", limit.cells[cell].base.probability),
                                  fmt::format("{:.3f}", limit.cells[cell].variant.probability),
                                  difference_text(limit.cells[cell]),
                                  fmt::format("{:.2g}", limit.cells[cell].p_adjusted)});
        page_.table(table);
        return true;
    }

    void common()
    {
        page_.paragraph("A drawn number depends on the seed, the realization, the quantity and the joint or block, and "
                        "on nothing else of the study. The table is found in the numbers of the results.");
        for (const VariantComparison& variant : c_.variants) {
            HtmlTable table{"lrl", {"quantity", "numbers", "draws"}, {}, variant.name};
            for (const CommonInput& input : variant.inputs)
                table.rows.push_back({input.name, fmt::format("{}", input.numbers), to_string(input.draws)});
            if (!table.rows.empty())
                page_.table(table);
            for (const std::string& note : variant.notes)
                page_.note(variant.name + ": " + note);
        }
    }

    const Comparison& c_;
    const std::string& file_;
    std::vector<std::string>& warnings_;
    Document page_;
};

} // namespace

Document comparison_page(const Comparison& comparison, const std::string& file, const std::optional<std::string>& title,
                         std::vector<std::string>& warnings)
{
    return ComparisonPage(comparison, file, title, warnings).page();
}

namespace {

constexpr double large = 0.2; ///< a difference that has the full colour

/// Numbers of the classes below.
enum Shade { better_much, better, not_named_less, none, not_named_more, worse, worse_much };

/// @param damage whether less of it is better
std::vector<MapClass> classes(bool damage)
{
    const char *less = damage ? "better" : "less", *more = damage ? "worse" : "more";
    return {{better_much, "#2166ac", fmt::format("{}, ≥ {:g}", less, large)},
            {better, "#74add1", less},
            {not_named_less, "#d8e8f1", "less, not named"},
            {none, "#f7f7f7", "no change"},
            {not_named_more, "#fbe3d4", "more, not named"},
            {worse, "#ef8a62", more},
            {worse_much, "#b2182b", fmt::format("{}, ≥ {:g}", more, large)}};
}

double shade_of(const PlaceComparison& place, double rate)
{
    if (place.counts.pairs() == 0)
        return std::numeric_limits<double>::quiet_NaN();
    const double d = place.difference;
    if (d == 0)
        return none;
    if (place.p_adjusted > rate)
        return d < 0 ? not_named_less : not_named_more;
    return d < 0 ? (d <= -large ? better_much : better) : d >= large ? worse_much : worse;
}

void draw_maps(const Comparison& comparison, const std::string& limit, const std::string& title,
               const std::filesystem::path& file)
{
    MapPicture picture;
    picture.title = title;
    picture.subtitle = fmt::format("named: {}", adjustment_text(comparison));
    picture.axes() = comparison;
    const std::size_t n = comparison.variants.size();
    picture.columns = n == 1 ? 1 : n <= 4 ? 2 : 3;
    picture.key = "lines: probability of the base 5, 50 and 95 % · grey: no pair";
    for (const VariantComparison& variant : comparison.variants) {
        const LimitComparison& of = limit_of(variant, limit);
        MapPanel panel;
        panel.title = fmt::format("{}: {}", variant.name, difference_text(of.overall));
        panel.classes = classes(of.damage);
        const bool first = picture.line.empty();
        for (const PlaceComparison& place : of.cells) {
            panel.value.push_back(shade_of(place, comparison.rate));
            if (first)
                picture.line.push_back(place.base.probability);
        }
        picture.panels.push_back(std::move(panel));
    }
    plot_maps(picture, file);
}

void draw_stripes(const Comparison& comparison, const std::string& limit, const std::string& title,
                  const std::filesystem::path& file)
{
    write_figure(stripes_figure(comparison, limit), title,
                 fmt::format("{} motions · bars: {:g} % intervals of each share, clustered by motion",
                             comparison.motions, 100 * comparison.level),
                 file);
}

} // namespace

const LimitComparison& limit_of(const VariantComparison& variant, const std::optional<std::string>& limit)
{
    const auto found =
        limit ? std::ranges::find(variant.limits, *limit, &LimitComparison::name) : variant.limits.begin();
    if (found != variant.limits.end())
        return *found;
    std::string names;
    for (const LimitComparison& each : variant.limits)
        names += (names.empty() ? "" : ", ") + each.name;
    throw InputError(
        fmt::format("--limit {}: no limit state of {}; it has {}", limit.value_or(""), variant.name, names));
}

void comparison_picture(const Comparison& comparison, const std::optional<std::string>& limit,
                        const std::optional<std::string>& title, const std::filesystem::path& file)
{
    const std::string name = limit_of(comparison.variants.front(), limit).name;
    const std::string heading = title.value_or(fmt::format("Change of {}: base {}", name, comparison.base_name));
    if (comparison.cells() > 0)
        draw_maps(comparison, name, heading, file);
    else if (!comparison.intensity.empty())
        draw_stripes(comparison, name, heading, file);
    else
        throw InputError("a comparison without cells or stripes has no picture; --to csv writes its numbers");
}

} // namespace stylobate
