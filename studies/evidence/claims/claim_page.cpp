#include "studies/evidence/claims/claim_page.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/tables/markdown.hpp"
#include "studies/evidence/claims/claim_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
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
            if (sample.why_not.empty() && picked(r.file->axes, sample.levels, split_words(words)))
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
    return text + (r.test->stand_ins.empty() ? "" : ", with stand-ins");
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
        if (!sample.why_not.empty())
            reasons.insert(sample.why_not);
    return reasons.empty() ? "no variant was run" : fmt::format("{}", fmt::join(reasons, "; "));
}

std::string reason_text(const Result& r)
{
    const Reasons& reasons = r.test->reasons;
    switch (r.verdict.judgement) {
    case Judgement::confirmed:
        return filled(reasons.confirmed.empty() ? "It holds in all the decided cases." : reasons.confirmed, r);
    case Judgement::refuted:
        return filled(reasons.refuted.empty() ? "It fails in all the decided cases." : reasons.refuted, r);
    case Judgement::depends:
        if (r.verdict.tie)
            return filled("The numbers are too close to separate. " + reasons.untestable, r);
        return filled(reasons.depends.empty() ? "It {split}." : reasons.depends, r);
    case Judgement::untestable: {
        if (!r.test->untestable.empty())
            return filled(r.test->untestable + " " + reasons.untestable, r);
        return filled(
            "The criterion was met in all the decided cases, but this is physically impossible: " + r.test->impossible +
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
    std::string head = "|", rule = "|", body;
    for (const std::size_t i : telling) {
        head += fmt::format(" {} |", i < r.file->axes.size() ? r.file->axes[i].label : "frequency");
        rule += "---|";
    }
    for (std::size_t c = 0; c < r.cases.front().size(); ++c) {
        const Case& one = r.cases.front()[c];
        body += "|";
        for (const std::size_t i : telling)
            body += fmt::format(" {} |", i < r.file->axes.size() ? r.file->axes[i].levels[one.levels[i]].name
                                                                 : r.test->ranges[one.range].name);
        body += fmt::format(" {} |", one.number_text);
        for (const std::vector<Case>& cases : r.cases)
            body += fmt::format(" {} |", to_string(cases[c].finding));
        body += "\n";
    }
    return fmt::format("{} number | margin 0 | 5 % | 20 % |\n{}---|---|---|---|\n{}", head, rule, body);
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
            run += sample.why_not.empty();
            for (const auto& cell : sample.cells)
                valid += cell.size();
            if (sample.why_not.empty())
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
    if (!test.contradiction.empty())
        text += fmt::format("**Inconsistency.** {}\n\n", filled(test.contradiction, r));
    if (!test.stand_ins.empty())
        text += fmt::format("**Stand-ins.** {}\n\n", filled(test.stand_ins, r));
    text +=
        fmt::format("**Criterion** (`{}.toml`). {}{}{}\n\n", r.file->name,
                    test.untestable.empty() ? "" : "For information only: ", criterion_text(*r.file, test),
                    test.after_trials.empty() ? "" : fmt::format(" Chosen after trial runs: {}", test.after_trials));
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
        if (!r.test->contradiction.empty())
            page += fmt::format("- {}: {}\n", r.test->id, filled(r.test->contradiction, r));
    page += "\n";
    std::map<std::string, std::string> shown;
    for (const Result& r : results)
        page += section(r, images, shown, figures);
    page += fmt::format("## The runs\n\n{}\nThis page was generated by version {}. The seeds are in the study files. "
                        "The numbers do not depend on the number of threads or the instruction set.\n",
                        runs_table(results), version);
    return page;
}

} // namespace stylobate::claims
