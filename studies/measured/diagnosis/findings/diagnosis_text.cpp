#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"

#include "io/files/suggest.hpp"
#include "studies/measured/diagnosis/findings/story_document.hpp"
#include "studies/report/document.hpp"
#include "studies/report/left_out.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stylobate {
namespace {

constexpr std::size_t most_rows = 12; ///< of a table; the file has all

std::string heading(const std::string& text)
{
    return "\n" + text + "\n";
}

using Row = std::vector<Html>;

/// At most so many of them as rows, and how many more there are.
template <class T, class F>
std::string table_of(const std::vector<T>& items, Row head, F row)
{
    HtmlTable table{"", std::move(head), {}, ""};
    for (std::size_t i = 0; i < std::min(items.size(), most_rows); ++i)
        table.rows.push_back(row(items[i]));
    Document document;
    document.table(table);
    return console_text(document) +
           (items.size() > most_rows ? fmt::format("  and {} more\n", items.size() - most_rows) : "");
}

std::string data_part(const Diagnosis& d)
{
    std::string out;
    for (const std::string& finding : d.data_findings)
        out += wrapped("- " + finding, 2);
    for (const std::vector<DataTest>* tests : {&d.base_tests, &d.sensor_tests})
        for (const DataTest& test : *tests)
            if (test.outcome != TestOutcome::passed)
                out += wrapped(
                    fmt::format("- {}, {}: {}. {}", test.name, test.place, to_string(test.outcome), test.sentence), 2);
    const auto passed = [](const std::vector<DataTest>& tests) {
        return static_cast<std::uint64_t>(std::count_if(
            tests.begin(), tests.end(), [](const DataTest& test) { return test.outcome == TestOutcome::passed; }));
    };
    if (const std::uint64_t n = passed(d.base_tests) + passed(d.sensor_tests); n > 0)
        out += wrapped(fmt::format("- {} of base and sensors passed", counted(n, "test")), 2);
    return out.empty() ? out : heading("The data") + out;
}

std::string size_words(const Candidate& c)
{
    if (!c.size)
        return "";
    return c.parameter + " " + estimate_words(c.size, c.low, c.high, c.unit);
}

std::string wrong_part(const Diagnosis& d)
{
    if (d.wrong.empty())
        return "";
    return heading(d.verdict == Verdict::none ? "Errors of the baseline, largest first" : "Errors, largest first") +
           table_of(d.wrong, {"run", "where", "coordinate", "from", "to", "excess"},
                    [](const WrongStretch& w) {
                        return Row{w.run,
                                   block_words(w.block),
                                   w.coordinate,
                                   fmt::format("{:.2f} s", w.from_s),
                                   fmt::format("{:.2f} s", w.to_s),
                                   fmt::format("{:.1f}", w.excess)};
                    }) +
           wrapped(wrong_words(d), 2);
}

std::string candidates_part(const Diagnosis& d)
{
    if (d.candidates.empty())
        return "";
    const bool compared = compared_with_nulls(d);
    const bool probable = std::any_of(d.candidates.begin(), d.candidates.end(),
                                      [](const Candidate& c) { return c.probability.has_value(); });
    std::string words = nats_words();
    if (compared)
        words += " " + chance_words(d);
    if (probable)
        words += " prob. is the probability of being the cause, given that one of the tested candidates is.";
    return heading(fmt::format("Candidates (gain in nats over the calibrated baseline{})",
                               compared ? "; null: 95 % quantile of the null distribution" : "")) +
           wrapped(words, 2) +
           table_of(d.candidates, {"mechanism", "place", "size", "gain", "null", "p", "prob.", "decision"},
                    [](const Candidate& c) {
                        const auto blank = [](const std::string& found) { return found == "not known" ? "" : found; };
                        return Row{c.mechanism,
                                   c.place,
                                   size_words(c),
                                   blank(number_words(c.gain_nats)),
                                   blank(number_words(c.null95)),
                                   blank(probability_words(c.p)),
                                   blank(probability_words(c.probability)),
                                   to_string(c.decision)};
                    });
}

std::string unexplained_part(const Diagnosis& d)
{
    if (!d.unexplained)
        return "";
    std::string out = heading("Not explained");
    out += wrapped(d.unexplained->text.empty()
                       ? fmt::format("{}, {}: depends on {}", block_words(d.unexplained->block),
                                     d.unexplained->coordinate, d.unexplained->depends_on.value_or(""))
                       : d.unexplained->text,
                   2);
    return out;
}

std::string gain_part(const Diagnosis& d)
{
    if (!d.gain)
        return "";
    std::string out = heading("Gain of the extended model");
    for (const std::optional<std::string>& text : {gain_words(*d.gain), collapse_words(*d.gain), d.gain->text})
        if (text)
            out += wrapped(*text, 2);
    return out;
}

std::string tests_part(const Diagnosis& d)
{
    if (!d.tests)
        return "";
    Document document;
    add_story(*d.tests, document);
    return heading("Tests of single joints") + console_text(document, console_width);
}

std::string baseline_part(const Diagnosis& d)
{
    if (d.baseline.empty())
        return "";
    std::string out = heading("The calibrated baseline (95 % interval)");
    std::vector<CalibratedParameter> numbers, words; // parameters with a value, and those with words alone
    for (const CalibratedParameter& p : d.baseline)
        (p.value ? numbers : words).push_back(p);
    if (!numbers.empty())
        out += table_of(numbers, {"parameter", "value", ""}, [](const CalibratedParameter& p) {
            return Row{p.name, estimate_words(p.value, p.low, p.high, p.unit), parameter_words(p)};
        });
    for (const CalibratedParameter& p : words)
        out += wrapped(p.name + ": " + (parameter_words(p).empty() ? "not known" : parameter_words(p)), 2);
    return out;
}

} // namespace

std::string diagnosis_text(const Diagnosis& d)
{
    std::string out = fmt::format("DIAGNOSIS  {}{}\n", d.specimen.empty() ? "" : d.specimen + ", ", d.measured_file);
    const bool tested = d.tests && !d.tests->steps.empty(); // tests decide, the first diagnosis is their prior
    if (tested)
        out += tests_part(d);
    out += heading((tested ? "First diagnosis: " : "Verdict: ") + verdict_heading(d)) + wrapped(verdict_words(d), 2);
    out += wrapped(left_out_text(2), 2); // the model of every diagnosis is planar
    out += wrong_part(d) + candidates_part(d);
    if (d.indistinguishable.size() > 1)
        out += wrapped("Not distinguished by these data: " + list_words(d.indistinguishable) + ".", 2);
    out += unexplained_part(d) + gain_part(d);
    if (d.extended_study_file)
        out += wrapped("The extended study: " + *d.extended_study_file, 2);
    out += (tested ? "" : tests_part(d)) + data_part(d) + baseline_part(d);
    if (!d.missing.empty()) {
        out += heading("Tests that were not possible");
        for (const Missing& missing : d.missing)
            out += wrapped("- " + missing.what + ": " + missing.why, 2);
    }
    if (d.command)
        out += heading("Again") + "  " + *d.command + "\n"; // in one line, to be copied
    return out + heading("Cost") + wrapped(cost_words(d.cost), 2);
}

} // namespace stylobate
