#include "studies/decisions/compare/comparison_text.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/plots/figure_file.hpp"
#include "io/plots/plot_maps.hpp"
#include "io/study/study_file.hpp"
#include "studies/decisions/compare/study_difference.hpp"
#include "studies/kinds/fragility/fragility.hpp"
#include "studies/report/html_figure.hpp"
#include "studies/results/structure_sketch.hpp"

#include <fmt/format.h>

#include <algorithm>
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

class ComparisonPage {
public:
    ComparisonPage(const Comparison& comparison, const std::string& file, const std::optional<std::string>& title,
                   std::vector<std::string>& warnings)
        : c_(comparison), file_(file), warnings_(warnings),
          page_(title.value_or(comparison_title(c_)), fmt::format("{}. Made by stylobate {}.", file, c_.code_version))
    {
    }

    Document page()
    {
        add_answer(c_, page_);
        page_.section("The intervention");
        interventions();
        add_dependence(c_, page_);
        page_.note("Not examined: what the studies hold fixed. Another structure, shaking, contact form or range of "
                   "the drawn quantities can have another answer.");
        add_changes(c_, page_);
        if (!capacity_rows(c_, c_.variants.front().limits.front()).empty())
            page_.note("The ratio of the geometric means over the realizations. Capacities beyond the range of the "
                       "study count as at its end, and between two intensities of the study (\"steps\") the shares are "
                       "not known, so that the ratio may be off by this factor: more intensities make it sharper. The "
                       "ratio is a bound where the two still differ there, and drawn towards 1 where a part of both "
                       "stands at the strongest shaking or falls at the weakest.");
        pictures();
        add_named(c_, page_, std::numeric_limits<std::size_t>::max());
        add_common(c_, page_);
        page_.note("A drawn number depends on the seed, the realization, the quantity and the joint or block, and on "
                   "nothing else of the study. Which draws are common is found in the numbers of the results.");
        page_.section("Reproduction");
        commands();
        page_.details("The study of the base, " + c_.base_name, [&] { page_.block(c_.base_toml); });
        for (const VariantComparison& variant : c_.variants)
            page_.details("The study of " + variant.name, [&] { page_.block(variant.study_toml); });
        return std::move(page_);
    }

private:
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
