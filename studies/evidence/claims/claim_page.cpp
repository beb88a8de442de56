#include "studies/evidence/claims/claim_page.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/plots/figure_file.hpp"
#include "io/tables/table.hpp"
#include "studies/evidence/claims/claim.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <map>
#include <set>

namespace stylobate::claims {

namespace {

std::vector<std::string> split_words(const std::string& text)
{
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::size_t first = std::min(text.find_first_not_of(' ', begin), end);
        words.push_back(text.substr(first, end - first));
        begin = end + 1;
    }
    return words;
}

const Case* pick_case(const Result& r, std::vector<std::string> words)
{
    std::string range;
    std::erase_if(words, [&](const std::string& word) {
        if (!word.starts_with("range="))
            return false;
        range = word.substr(6);
        return true;
    });
    for (const Case& one : r.cases.front())
        if (picked(r.file->axes, one.levels, words) && (range.empty() || r.test->ranges[one.range].name == range))
            return &one;
    return nullptr;
}

std::string value_of(const std::string& name, const std::string& words, const Result& r)
{
    if (name == "cases")
        return fmt::format("{}", r.cases.front().size());
    if (name == "split")
        return r.verdict.split;
    if (name == "number" || name == "finding") {
        const Case* one = pick_case(r, split_words(words));
        return one == nullptr ? "(no such case)" : name == "number" ? one->number_text : to_string(one->finding);
    }
    if (name == "f1" || name == "rigid") {
        for (const Sample& sample : *r.samples)
            if (!sample.why_not && picked(r.file->axes, sample.levels, split_words(words)))
                return fmt::format("{:.4g}", name == "f1" ? sample.f1_hz : sample.rigid_m_s2);
        return "(not run)";
    }
    throw InputError(fmt::format("{}: claim {}: {{{}}} is no field.\n  Known: cases, split, number, finding, f1, "
                                 "rigid.",
                                 r.file->file, r.test->id, name));
}

constexpr std::array margin_names{"0", "5", "20 %"};

/// "depends on K_N (9 of 12), start (3 of 10)"
std::string verdict_text(const Result& r)
{
    const Verdict& v = r.verdict;
    std::string text = to_string(v.judgement);
    if (v.judgement == Judgement::depends) {
        std::vector<std::string> on;
        if (v.by_margin)
            on.emplace_back("the margin");
        for (const Influence& one : v.by)
            on.push_back(fmt::format("{} ({} of {})", one.label, one.flips, one.pairs));
        if (v.tie)
            text += ": a tie";
        else if (!on.empty())
            text += fmt::format(" on {}", fmt::join(on, ", "));
    }
    return text + (r.test->stand_ins ? ", with stand-ins" : "");
}

/// What the verdict is at each margin.
std::string margins_text(const Verdict& v)
{
    std::vector<std::string> parts;
    for (std::size_t m = 0; m < margins.size();) {
        std::size_t last = m; // margins with the same counts
        while (last + 1 < margins.size() && counts_text(v.at[last + 1]) == counts_text(v.at[m]))
            ++last;
        std::string at = margin_names[m];
        for (std::size_t k = m + 1; k <= last; ++k)
            at += fmt::format("{}{}", k == last ? " and " : ", ", margin_names[k]);
        if (!at.ends_with('%'))
            at += " %";
        parts.push_back(fmt::format("at a margin of {}: {}", at, counts_text(v.at[m])));
        m = last + 1;
    }
    return fmt::format("{}", fmt::join(parts, "; "));
}

/// Why a test has no case: the records that are absent.
std::string why_not_run(const Result& r)
{
    std::set<std::string> reasons;
    for (const Sample& sample : *r.samples)
        if (sample.why_not)
            reasons.insert(*sample.why_not);
    return reasons.empty() ? "no variant was run" : fmt::format("{}", fmt::join(reasons, "; "));
}

std::string reason_text(const Result& r)
{
    const Reasons& reasons = r.test->reasons;
    switch (r.verdict.judgement) {
    case Judgement::confirmed:
        return filled(reasons.confirmed.value_or("It holds in all the decided cases."), r);
    case Judgement::refuted:
        return filled(reasons.refuted.value_or("It fails in all the decided cases."), r);
    case Judgement::depends:
        if (r.verdict.tie)
            return filled("The numbers are too close to separate. " + reasons.untestable.value_or(""), r);
        return filled(reasons.depends.value_or("It {split}."), r);
    case Judgement::untestable: {
        if (r.test->untestable)
            return filled(*r.test->untestable + " " + reasons.untestable.value_or(""), r);
        return filled("The criterion was met in all the decided cases, but this is physically impossible: " +
                          *r.test->impossible +
                          " The criterion or the model is in error, and the claim is not confirmed.",
                      r);
    }
    case Judgement::not_run:
        break;
    }
    return why_not_run(r) + ".";
}

/// The axes that distinguish a test's cases, by number; `axes.size()` stands for the ranges.
std::vector<std::size_t> telling_axes(const Result& r)
{
    std::vector<std::size_t> telling;
    for (std::size_t i = 0; i < r.file->axes.size(); ++i) {
        std::set<std::size_t> seen;
        for (const Case& one : r.cases.front())
            seen.insert(one.levels[i]);
        if (seen.size() > 1)
            telling.push_back(i);
    }
    if (r.test->ranges.size() > 1)
        telling.push_back(r.file->axes.size());
    return telling;
}

std::string case_table(const Result& r)
{
    const std::vector<std::size_t> telling = telling_axes(r);
    std::vector<std::string> head;
    for (const std::size_t i : telling)
        head.push_back(i < r.file->axes.size() ? r.file->axes[i].label : "frequency");
    head.emplace_back("number | margin 0 | 5 % | 20 %");
    std::string text = markdown_head(fmt::format("{}", fmt::join(head, " | ")));
    for (std::size_t c = 0; c < r.cases.front().size(); ++c) {
        const Case& one = r.cases.front()[c];
        std::vector<std::string> row;
        for (const std::size_t i : telling)
            row.push_back(i < r.file->axes.size() ? r.file->axes[i].levels[one.levels[i]].name
                                                  : r.test->ranges[one.range].name);
        row.push_back(one.number_text);
        for (const std::vector<Case>& cases : r.cases)
            row.emplace_back(to_string(cases[c].finding));
        text += markdown_row("{}", fmt::join(row, " | "));
    }
    return text;
}

std::string runs_table(const std::vector<Result>& results)
{
    std::map<std::string, const Result*> files;
    for (const Result& r : results)
        files.emplace(r.file->name, &r);
    std::string table = markdown_head("study | structure | variants | realizations | invalid | computed by");
    for (const auto& [name, r] : files) {
        std::uint64_t valid = 0, invalid = 0, run = 0;
        std::set<std::string> versions;
        for (const Sample& sample : *r->samples) {
            invalid += sample.invalid;
            run += !sample.why_not;
            for (const auto& cell : sample.cells)
                valid += cell.size();
            if (!sample.why_not)
                versions.insert(sample.version);
        }
        table += markdown_row("`{}.toml` | {} | {} of {} | {} | {} | {}", name, r->file->what, run, r->samples->size(),
                              valid + invalid, invalid, fmt::join(versions, ", "));
    }
    return table;
}

std::string section(const Result& r, const std::string& images, std::map<std::string, std::string>& shown,
                    const std::map<std::string, const Figure*>& figures)
{
    const Test& test = *r.test;
    std::string text = fmt::format("## {}\n\n**{}, section {}.** {}\n\n", test.id,
                                   test.inference ? "Inferred from the paper" : "The paper, in our words", test.section,
                                   filled(test.says, r));
    if (test.contradiction)
        text += fmt::format("**Inconsistency.** {}\n\n", filled(*test.contradiction, r));
    if (test.stand_ins)
        text += fmt::format("**Stand-ins.** {}\n\n", filled(*test.stand_ins, r));
    text += fmt::format("**Criterion** (`{}.toml`). {}{}{}\n\n", r.file->name,
                        test.untestable ? "For information only: " : "", criterion_text(*r.file, test),
                        test.after_trials ? fmt::format(" Chosen after trial runs: {}", *test.after_trials) : "");
    text += fmt::format("**Verdict: {}** ({}). {}\n\n", verdict_text(r), margins_text(r.verdict), reason_text(r));
    if (!r.cases.front().empty())
        text += case_table(r) + "\n";
    for (const std::string& name : r.test->figures) {
        const auto figure = figures.find(name);
        if (figure == figures.end())
            throw InputError(
                fmt::format("{}: claim {} names the figure {}, and no file has it.", r.file->file, r.test->id, name));
        const auto [at, first] = shown.emplace(name, r.test->id);
        if (first)
            text += fmt::format("![{0}]({1}/{2}.png)\n\n*{0}.* {3}\n\n", figure->second->title, images, name,
                                figure->second->caption);
        else
            text += fmt::format("Figure: *{}*, under {}.\n\n", figure->second->title, at->second);
    }
    return text;
}

/// Confidence of the bars.
constexpr double bar_level = 0.95;

std::vector<std::size_t> inside(const std::vector<double>& values, const Window& window, double unit)
{
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (window.holds(values[i] / unit))
            found.push_back(i);
    return found;
}

/// What tells the variants of a figure apart: the axes of which it shows more than one level, but not `x`.
std::string distinguishing(const ClaimFile& file, const Figure& figure, const std::vector<Sample>& samples,
                           const Levels& levels)
{
    std::string text;
    for (std::size_t i = 0; i < file.axes.size(); ++i) {
        std::set<std::size_t> seen;
        for (const Sample& sample : samples)
            if (!sample.why_not && picked(file.axes, sample.levels, figure.only))
                seen.insert(sample.levels[i]);
        if (seen.size() > 1 && file.axes[i].name != figure.x)
            text += (text.empty() ? "" : ", ") + file.axes[i].label + ' ' + file.axes[i].levels[levels[i]].name;
    }
    return text;
}

bool shown(const Curve::Point& point)
{
    return point.y.known() && std::isfinite(point.y.value);
}

std::string joined(const std::string& a, const std::string& b)
{
    return a.empty() || b.empty() ? a + b : a + ", " + b;
}

/// One curve for the picture, its points beside those of the others where they would cover each other.
/// @param nudge of the points, in places from the middle
void add_curve(const Figure& figure, const Curve& curve, bool along_axis, double nudge, std::size_t curves,
               stylobate::Figure& drawn)
{
    FigureSeries line, points;
    line.name = points.name = curve.label.empty() ? " " : curve.label;
    points.kind = SeriesKind::points;
    const double scale = unit_text(figure.measures.front()) == "mm" ? 1000 : 1;
    bool any = false;
    for (const Curve::Point& point : curve.points) {
        const bool seen = shown(point) && !(figure.log_y && point.y.value <= 0);
        const double upper = std::isfinite(point.y.upper) ? point.y.upper : point.y.value;
        const double lower = figure.log_y && point.y.lower <= 0 ? point.y.value : point.y.lower;
        const double x = along_axis ? point.x + std::min(0.03, 0.3 / static_cast<double>(curves)) * nudge
                                    : point.x * std::pow(1.006, nudge);
        constexpr double gap = std::numeric_limits<double>::quiet_NaN();
        for (FigureSeries* s : {&line, &points}) {
            s->x.push_back(x);
            s->y.push_back(seen ? scale * point.y.value : gap);
        }
        points.low.push_back(seen ? scale * lower : gap);
        points.high.push_back(seen ? scale * upper : gap);
        any = any || seen;
    }
    if (!any)
        return;
    line.group = points.group = points.name;
    line.dashed = drawn.series.size() >= 14; // the colours come again
    drawn.series.push_back(std::move(line));
    drawn.series.push_back(std::move(points));
}

} // namespace

Result judged(const ClaimFile& file, const Test& test, const std::vector<Sample>& samples)
{
    Result result{&file, &test, &samples, {}, {}};
    for (std::size_t m = 0; m < margins.size(); ++m)
        result.cases[m] = judge(file, test, samples, margins[m]);
    result.verdict = verdict_of(file, test, result.cases);
    return result;
}

bool comes_before(const std::string& a, const std::string& b)
{
    const auto number = [](const std::string& id) {
        const std::size_t digit = std::min(id.find_first_of("0123456789"), id.size());
        return std::strtol(id.c_str() + digit, nullptr, 10);
    };
    return number(a) != number(b) ? number(a) < number(b) : a < b;
}

std::string filled(const std::string& text, const Result& result)
{
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t close = text[i] == '{' ? text.find('}', i) : std::string::npos;
        if (close == std::string::npos) {
            out += text[i++];
            continue;
        }
        const std::string inside = text.substr(i + 1, close - i - 1);
        const std::size_t colon = std::min(inside.find(':'), inside.size());
        out += value_of(inside.substr(0, colon), colon < inside.size() ? inside.substr(colon + 1) : "", result);
        i = close + 1;
    }
    return out;
}

std::string claims_page(std::vector<Result> results, const std::string& images, const std::string& version)
{
    std::stable_sort(results.begin(), results.end(),
                     [](const Result& a, const Result& b) { return comes_before(a.test->id, b.test->id); });
    std::size_t decided = 0, fewest = std::numeric_limits<std::size_t>::max();
    std::map<std::string, const Figure*> figures;
    std::map<Judgement, std::size_t> tally;
    for (const Result& r : results) {
        for (const Sample& sample : *r.samples)
            for (const auto& cell : sample.cells)
                fewest = std::min(fewest, cell.size());
        decided += r.verdict.at.front().holds + r.verdict.at.front().fails;
        ++tally[r.verdict.judgement];
        for (const Figure& figure : r.file->figures)
            figures.emplace(figure.name, &figure);
    }

    std::string page = fmt::format(
        "# Test of the paper's claims\n\n"
        "L. Papaloizou and P. Komodromos, \"Numerical analysis of ancient multi-drum columns with epistyles under "
        "dynamic "
        "loadings\", draw conclusions on multi-drum columns and colonnades from single runs of a planar "
        "discrete-element model. Here each conclusion is tested with ensembles. Every point has at least {} "
        "realizations with random perturbations of the uncertain quantities: friction, contact stiffness, damping, "
        "sizes, placement, level and phase. Quantities that the paper does not state are varied. This page is "
        "generated by `scripts/claims.sh` from the files in "
        "[studies/evidence/paper](../studies/evidence/paper/README.md); no "
        "verdict and "
        "no "
        "measured number is written by hand.\n\n"
        "A verdict is reached as follows. Each claim is restated in our words, with the section or figure where it "
        "stands; what the paper does not say but what follows from it is marked as inferred. A criterion is evaluated "
        "with confidence intervals in every case, that is in every variant and frequency range, at margins of 0, 5 and "
        "20 %: a difference counts where it certainly exceeds the margin, so the claim holds, fails or is undecided in "
        "that case. **Confirmed**: holds at all margins in all the decided cases, and most are decided. **Refuted**: "
        "fails so. **Depends**: cases differ, or the margin decides, or most cases are undecided (a tie). The axes are "
        "ranked by how much they move the answer: (9 of 12) says that of 12 pairs of decided cases that differ in this "
        "axis alone 9 have other findings, at a margin of 5 %. **Untestable**: the paper omits necessary information. "
        "One rule holds for what is missing: numbers of the paper that rest on it are untestable; an order is tested "
        "with stand-ins, and the verdict says so. Most criteria were fixed before the runs; what was chosen after "
        "trial "
        "runs stands beside the criterion. Numbers in brackets are intervals. Each case is decided at {} % confidence, "
        "and its numbers share the error probability (Bonferroni). Of the {} cases that are decided at a margin of 0 "
        "about {:.0f} may be decided wrongly, so a single case that contradicts its neighbours is weak evidence. An "
        "onset is the lowest PGA at which the event has probability 1/2; its interval ends at PGAs that were run, or "
        "at interpolated PGAs where onsets are compared. Definitions: "
        "[studies/evidence/claims](../studies/evidence/claims/README.md).\n\n",
        fewest == std::numeric_limits<std::size_t>::max() ? 0 : fewest, 100 * case_level, decided,
        (1 - case_level) * static_cast<double>(decided));
    page += "## Verdicts\n\n";
    for (const auto& [judgement, count] : tally)
        page += fmt::format("{}{} {}", judgement == tally.begin()->first ? "" : ", ", count, to_string(judgement));
    page += ".\n\n" + markdown_head("claim | statement | section | margin 0 | 5 % | 20 % | verdict");
    for (const Result& r : results)
        page += markdown_row(
            "[{}](#{}) | {} | {}{} | {} | {} | {} | **{}**", r.test->id,
            [&] {
                std::string anchor = r.test->id;
                std::transform(anchor.begin(), anchor.end(), anchor.begin(),
                               [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
                return anchor;
            }(),
            filled(r.test->says, r), r.test->section, r.test->inference ? " (inferred)" : "",
            counts_text(r.verdict.at[0]), counts_text(r.verdict.at[1]), counts_text(r.verdict.at[2]), verdict_text(r));

    page += "\n## Inconsistencies in the paper\n\n";
    for (const Result& r : results)
        if (r.test->contradiction)
            page += fmt::format("- {}: {}\n", r.test->id, filled(*r.test->contradiction, r));
    page += "\n";
    std::map<std::string, std::string> shown;
    for (const Result& r : results)
        page += section(r, images, shown, figures);
    page += fmt::format("## The runs\n\n{}\nThis page was generated by version {}. The seeds are in the study files. "
                        "The numbers do not depend on the number of threads or the instruction set.\n",
                        runs_table(results), version);
    return page;
}

std::vector<Curve> curves_of(const ClaimFile& file, const Figure& figure, const std::vector<Sample>& samples)
{
    std::vector<Curve> curves;
    const auto add = [&](const std::string& label, double x, const Estimate& y) {
        auto at = std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.label == label; });
        if (at == curves.end())
            at = curves.insert(curves.end(), {label, {}});
        at->points.push_back({x, y});
    };
    const bool along_f = figure.x == "frequency", along_p = figure.x == "pga";
    const std::size_t axis = axis_index(file.axes, figure.x);
    for (const Measure& measure : figure.measures)
        for (const Sample& sample : samples) {
            if (sample.why_not || !picked(file.axes, sample.levels, figure.only))
                continue;
            const bool of_onset = measure.kind == Measure::Kind::onset;
            const std::string name = joined(distinguishing(file, figure, samples, sample.levels),
                                            figure.measures.size() < 2 ? "" : short_text(measure));
            const auto rows =
                inside(sample.frequency_hz, figure.frequency, figure.frequency.over_f1 ? sample.f1_hz : 1);
            auto columns = inside(sample.pga_m_s2, figure.pga, 1);
            if (of_onset)
                columns = {0};
            for (const std::size_t f : rows)
                for (const std::size_t p : columns) {
                    std::string label = name;
                    if (!along_f && rows.size() > 1)
                        label = joined(label, fmt::format("{:.3g} Hz", sample.frequency_hz[f]));
                    if (!along_p && columns.size() > 1)
                        label = joined(label, fmt::format("{:.3g} m/s²", sample.pga_m_s2[p]));
                    const double x = along_f   ? sample.frequency_hz[f]
                                     : along_p ? sample.pga_m_s2[p]
                                               : static_cast<double>(sample.levels[axis]);
                    add(label, x, estimate(sample, f, p, measure, bar_level));
                }
        }
    return curves;
}

void draw_figure(const ClaimFile& file, const Figure& figure, const std::vector<Curve>& curves,
                 const std::filesystem::path& png)
{
    const bool along_axis = figure.x != "frequency" && figure.x != "pga";
    stylobate::Figure drawn;
    drawn.y_label = figure.y_label;
    for (std::size_t k = 0; k < curves.size(); ++k)
        add_curve(figure, curves[k], along_axis, static_cast<double>(k) - static_cast<double>(curves.size() - 1) / 2,
                  curves.size(), drawn);
    if (along_axis) {
        const VariantAxis& axis = file.axes[axis_index(file.axes, figure.x)];
        drawn.x_label = axis.label;
        for (const auto& level : axis.levels)
            drawn.x_ticks.push_back(level.name);
    } else {
        drawn.x_label = figure.x == "frequency" ? "frequency [Hz]" : "peak ground acceleration [m/s²]";
        drawn.x_log = true;
    }
    double left = along_axis ? -0.6 : 1e300, right = along_axis ? static_cast<double>(drawn.x_ticks.size()) - 0.4 : 0;
    double highest = figure.line.value_or(0);
    for (const FigureSeries& s : drawn.series)
        for (std::size_t i = 0; i < s.x.size(); ++i) {
            left = std::min(left, s.x[i]);
            right = std::max(right, s.x[i]);
            for (const double end : {s.y[i], s.high.empty() ? s.y[i] : s.high[i]})
                highest = std::isfinite(end) ? std::max(highest, end) : highest;
        }
    if (std::all_of(figure.measures.begin(), figure.measures.end(),
                    [](const Measure& m) { return m.kind == Measure::Kind::probability; }))
        drawn.y_range = {-0.02, 1.02};
    else if (figure.log_y)
        drawn.y_log = true;
    else
        drawn.y_range = {0, highest > 0 ? 1.05 * highest : 1};
    if (figure.line && left < right) {
        FigureSeries level{figure.line_label, SeriesKind::line, {left, right}, {*figure.line, *figure.line}, {}, {}};
        level.colour = "#808080";
        level.dashed = true;
        drawn.series.push_back(std::move(level));
    }
    write_figure(drawn, figure.title, file.what, png);
}

} // namespace stylobate::claims
