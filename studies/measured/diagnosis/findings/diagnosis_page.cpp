#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"

#include "io/files/suggest.hpp"
#include "studies/measured/diagnosis/findings/story_document.hpp"
#include "studies/measured/windows/motion_page.hpp"
#include "studies/report/html_figure.hpp"
#include "studies/report/left_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace stylobate {
namespace {

constexpr std::size_t most_stretches = 40; ///< of the table of what is wrong; the file has all

/// Blank instead of "not known", for cells.
std::string cell(MaybeReal value)
{
    return value ? number_words(value) : "–";
}

Html decision_tag(Decision decision)
{
    return tag(decision == Decision::named ? "bad" : decision == Decision::in_set ? "warn" : "", to_string(decision));
}

Html outcome_tag(TestOutcome outcome)
{
    return tag(outcome == TestOutcome::passed   ? "good"
               : outcome == TestOutcome::failed ? "bad"
                                                : "",
               to_string(outcome));
}

std::string size_cell(const Candidate& c)
{
    return c.size ? fmt::format("{} = {}", c.parameter, estimate_words(c.size, c.low, c.high, c.unit)) : "–";
}

class DiagnosisPage {
public:
    DiagnosisPage(const Diagnosis& diagnosis, const std::string& file, const std::optional<std::string>& title)
        : d_(diagnosis), file_(file),
          page_(title.value_or("Diagnosis: " +
                               (diagnosis.specimen.empty() ? diagnosis.measured_file : diagnosis.specimen)),
                fmt::format("{}, {} of {} used. Made by stylobate {}.", diagnosis.measured_file, diagnosis.runs_used,
                            counted(diagnosis.runs, "run"), diagnosis.code_version))
    {
    }

    Document page()
    {
        const bool tested = d_.tests && !d_.tests->steps.empty(); // tests decide, the first diagnosis is their prior
        if (tested)
            tests();
        page_.section(tested ? "First diagnosis" : "Verdict");
        verdict();
        wrong();
        candidates();
        unexplained();
        gain();
        if (!tested)
            tests();
        data();
        baseline();
        missing();
        method();
        again();
        return page_;
    }

private:
    void figures(FigurePlace place)
    {
        for (const DiagnosisFigure& figure : d_.figures)
            if (figure.place == place) {
                Html caption = Html::ready("<b>" + html_escaped(figure.title) + "</b> ");
                caption += figure.caption;
                const bool curves = place == FigurePlace::wrong; // one below the other, with one time axis
                page_.figure(curves ? figure_svg(figure, 190) : figure_svg(figure), caption);
            }
    }

    void verdict()
    {
        // no colour for `none`: it does not show that the model is right
        const char* tone = d_.verdict == Verdict::none ? "" : d_.verdict == Verdict::named ? "warn" : "bad";
        const std::string said = verdict_words(d_);
        page_.box(tone, verdict_heading(d_), said);
        if (said.find("nats") != std::string::npos)
            page_.note(nats_words());
        std::vector<std::pair<std::string, Html>> facts;
        for (const Candidate* cause : named_causes(d_))
            facts.emplace_back(
                "Cause",
                fmt::format("{} ({}), {}: {}{}", cause->mechanism, mechanism_words(cause->mechanism), cause->place,
                            size_cell(*cause),
                            cause->probability ? "; probability " + probability_words(cause->probability) : ""));
        if (d_.indistinguishable.size() > 1)
            facts.emplace_back("Not distinguished by these data", list_words(d_.indistinguishable));
        if (!d_.wrong.empty() && d_.verdict != Verdict::none) {
            const WrongStretch& worst = d_.wrong.front();
            facts.emplace_back("Worst", fmt::format("run {}, {}, {}, from {:.2f} to {:.2f} s: error {:.1f} times that "
                                                    "of noise and a lag of some milliseconds",
                                                    worst.run, block_words(worst.block), worst.coordinate, worst.from_s,
                                                    worst.to_s, worst.excess));
        }
        if (d_.gain)
            if (const std::optional<std::string> words = gain_words(*d_.gain))
                facts.emplace_back("Gain", *words);
        if (d_.tests && !d_.tests->next.empty())
            facts.emplace_back("Next test", d_.tests->next.front());
        if (!d_.missing.empty())
            facts.emplace_back("Not judged", not_judged());
        if (!facts.empty())
            page_.facts(facts);
        add_left_out(page_, 2); // the model of every diagnosis is planar
        figures(FigurePlace::verdict);
    }

    std::string not_judged() const
    {
        std::string text;
        for (const Missing& missing : d_.missing)
            text += (text.empty() ? "" : "; ") + missing.what;
        return text;
    }

    void wrong()
    {
        page_.section(d_.verdict == Verdict::none ? "Errors of the baseline" : "Errors and their location");
        if (d_.wrong.empty()) {
            page_.paragraph(d_.cost.window_simulations > 0
                                ? "In every simulated window the error of the baseline is within noise and a lag of "
                                  "some milliseconds."
                                : "No window of any run could be simulated, so this was not tested.");
        } else {
            HtmlTable table{"lllrrr", {"run", "where", "coordinate", "from [s]", "to [s]", "excess"}, {}, ""};
            for (std::size_t i = 0; i < std::min(d_.wrong.size(), most_stretches); ++i) {
                const WrongStretch& w = d_.wrong[i];
                table.rows.push_back({w.run, block_words(w.block), w.coordinate, fmt::format("{:.2f}", w.from_s),
                                      fmt::format("{:.2f}", w.to_s), fmt::format("{:.1f}", w.excess)});
            }
            page_.table(table);
            page_.note((d_.wrong.size() > most_stretches
                            ? fmt::format("The worst {} of {} intervals; the file contains all of them. ",
                                          most_stretches, d_.wrong.size())
                            : std::string()) +
                       wrong_words(d_) + " Times are on the cameras' clock.");
        }
        motion();
        figures(FigurePlace::wrong);
    }

    void motion()
    {
        if (d_.motion && !d_.motion->windows.empty())
            add_motion(page_, *d_.motion);
        else if (d_.cost.window_simulations > 0)
            page_.note(no_motion_words(file_, d_.code_version));
    }

    void candidates()
    {
        if (d_.candidates.empty() && d_.nulls.empty())
            return;
        page_.section("Candidates");
        if (!d_.candidates.empty()) {
            const bool compared = compared_with_nulls(d_);
            page_.paragraph(nats_words() + (compared ? " " + chance_words(d_) : ""));
            double most = 0;
            for (const Candidate& c : d_.candidates)
                most = std::max({most, c.gain_nats.value_or(0), 1.3 * c.null95.value_or(0)});
            HtmlTable table{
                "lnlrlrrl",
                {"mechanism", "place", "size (95 % interval)", "gain [nats]", "", "null (95 %)", "p", "decision"},
                {},
                ""};
            for (const Candidate& c : d_.candidates) {
                Html decision = decision_tag(c.decision);
                if (c.probability && (c.decision == Decision::named || c.decision == Decision::in_set))
                    decision += Html::ready("<br><small>probability " + html_escaped(probability_words(c.probability)) +
                                            "</small>");
                Html name = c.mechanism;
                name += Html::ready("<br><small>" + html_escaped(mechanism_words(c.mechanism)) + "</small>");
                table.rows.push_back({name, c.place, size_cell(c), cell(c.gain_nats),
                                      c.gain_nats && most > 0 ? bar_svg(*c.gain_nats, c.null95, most) : Html(),
                                      cell(c.null95), c.p ? probability_words(c.p) : "–", decision});
            }
            page_.table(table);
            page_.note(
                std::string("Gain: log likelihood over the calibrated baseline. ") +
                (compared ? "Null (the mark on the bar): the 95 % quantile of the null distribution, from simulated "
                            "campaigns without the mechanism. A gain slightly above it is not sufficient (see Method). "
                          : "") +
                "Causes without a p-value were found by a test of base, sensors or rest with a separate threshold (see "
                "The data). Probabilities are among the tested candidates.");
            reasons();
            evidence();
        }
        for (const NullEnsemble& null : d_.nulls)
            page_.note(fmt::format("Null distribution: {} simulated campaigns without a hidden effect, contact form "
                                   "{}. They differ in: {}.",
                                   null.campaigns, null.form, null.what));
        figures(FigurePlace::candidates);
    }

    void reasons()
    {
        std::vector<Html> reasons;
        for (const Candidate& c : d_.candidates) {
            if (c.why.empty())
                continue;
            Html line = Html::ready("<b>" + html_escaped(c.mechanism + ", " + c.place) + ":</b> ");
            line += c.why;
            reasons.push_back(line);
        }
        if (reasons.empty())
            return;
        page_.heading("Why");
        page_.list(reasons);
    }

    void evidence()
    {
        for (const Candidate& c : d_.candidates) {
            if (c.evidence.empty() || (c.decision != Decision::named && c.decision != Decision::in_set))
                continue;
            page_.heading("Evidence for " + c.mechanism + ", " + c.place);
            HtmlTable table{"lrl", {"run", "gain [nats]", ""}, {}, ""};
            MaybeReal told;
            for (const Evidence& e : c.evidence) {
                table.rows.push_back({e.run, cell(e.gain_nats), e.text.value_or("")});
                if (e.gain_nats)
                    told = told.value_or(0) + *e.gain_nats;
            }
            if (c.gain_nats && told)
                table.rows.push_back({"all runs", cell(*c.gain_nats - *told),
                                      "without it, the scatter between specimens would have to be larger"});
            page_.table(table);
        }
    }

    void unexplained()
    {
        if (!d_.unexplained)
            return;
        const Unexplained& u = *d_.unexplained;
        page_.section("Unexplained error");
        page_.paragraph(u.text.empty() ? fmt::format("{}, {}", block_words(u.block), u.coordinate) : u.text);
        page_.facts({{"Where", block_words(u.block) + ", " + u.coordinate},
                     {"Depends on", u.depends_on.value_or("none of the tested features")}});
        if (!u.features.empty()) {
            HtmlTable table{"lrr", {"feature of the motion", "share of the remaining error", "null (95 %)"}, {}, ""};
            const auto share = [](MaybeReal value) { return value ? fmt::format("{:.1f} %", 100 * *value) : "–"; };
            for (const RegressionFeature& f : u.features)
                table.rows.push_back({f.name, share(f.gain), share(f.threshold)});
            page_.table(table);
        }
        figures(FigurePlace::unexplained);
    }

    void gain()
    {
        if (!d_.gain && !d_.extended_study)
            return;
        page_.section("The extended model and its gain");
        if (d_.gain) {
            const ModelGain& g = *d_.gain;
            for (const std::optional<std::string>& text : {gain_words(g), collapse_words(g), g.text})
                if (text)
                    page_.paragraph(*text);
            if (!g.runs_left_out.empty())
                page_.note("Held-out runs: " + list_words(g.runs_left_out) + ".");
        }
        figures(FigurePlace::gain);
        if (d_.extended_study) {
            page_.heading("The extended study");
            if (d_.extended_study_file) {
                Html text = "Also in ";
                text += code(*d_.extended_study_file);
                page_.note(text);
            }
            page_.block(*d_.extended_study);
        }
    }

    void tests()
    {
        if (!d_.tests)
            return;
        page_.section("Tests of single joints");
        add_story(*d_.tests, page_);
        add_story_figures(*d_.tests, page_);
    }

    void tests(const std::string& title, const std::vector<DataTest>& tests)
    {
        if (tests.empty())
            return;
        page_.heading(title);
        HtmlTable table{"lnrrll", {"test", "place", "value ± sd", "threshold", "outcome", ""}, {}, ""};
        for (const DataTest& t : tests) {
            const std::string unit = t.unit.empty() ? "" : " " + t.unit;
            table.rows.push_back(
                {t.name, t.place,
                 t.value ? number_words(t.value) + (t.sd ? " ± " + number_words(t.sd) : "") + unit : "–",
                 t.threshold ? number_words(t.threshold) + unit : "–", outcome_tag(t.outcome), t.sentence});
        }
        page_.table(table);
    }

    void data()
    {
        if (d_.data_findings.empty() && d_.base_tests.empty() && d_.sensor_tests.empty())
            return;
        page_.section("The data");
        if (!d_.data_findings.empty())
            page_.list({d_.data_findings.begin(), d_.data_findings.end()});
        tests("Base motion", d_.base_tests);
        tests("Sensors", d_.sensor_tests);
        figures(FigurePlace::data);
    }

    void baseline()
    {
        if (d_.baseline.empty())
            return;
        page_.section("The calibrated baseline");
        HtmlTable table{"lrnl", {"parameter", "value", "95 % interval", ""}, {}, ""};
        for (const CalibratedParameter& p : d_.baseline) {
            Html note = p.determined ? Html() : tag("warn", "not determined");
            if (!p.determined && !p.note.empty())
                note += " ";
            note += p.note;
            table.rows.push_back({p.name, p.value ? number_words(p.value) + (p.unit.empty() ? "" : " " + p.unit) : "–",
                                  interval_words(p.low, p.high).value_or(""), note});
        }
        page_.table(table);
        if (std::any_of(d_.baseline.begin(), d_.baseline.end(), [](const auto& p) { return !p.determined; }))
            page_.note("“Not determined”: these data do not determine the parameter; the value is nominal or assumed.");
        figures(FigurePlace::baseline);
    }

    void missing()
    {
        page_.section("Tests that were not possible");
        if (d_.missing.empty()) {
            page_.paragraph("All tests were possible.");
            return;
        }
        HtmlTable table{"ll", {"what", "why"}, {}, ""};
        for (const Missing& m : d_.missing)
            table.rows.push_back({m.what, m.why});
        page_.table(table);
    }

    void method()
    {
        page_.section("Method and cost");
        for (const std::string& paragraph : d_.method)
            page_.paragraph(paragraph);
        page_.paragraph(cost_words(d_.cost));
    }

    void again()
    {
        page_.section("Reproduction");
        std::vector<std::pair<std::string, Html>> facts = {
            {"Measured data", d_.measured_file + (d_.measured_fingerprint ? ", " + *d_.measured_fingerprint : "")},
            {"Program", "stylobate " + d_.code_version},
            {"Seed", fmt::format("{}", d_.seed)},
            {"This diagnosis", file_}};
        if (!d_.options.empty())
            facts.emplace_back("Options", list_words(d_.options));
        page_.facts(facts);
        if (d_.command)
            page_.block(*d_.command);
        if (!d_.study_toml.empty()) {
            page_.heading("The baseline study with all defaults");
            page_.block(d_.study_toml);
        }
    }

    const Diagnosis& d_;
    const std::string file_;
    Document page_;
};

} // namespace

Document diagnosis_page(const Diagnosis& diagnosis, const std::string& file, const std::optional<std::string>& title)
{
    return DiagnosisPage(diagnosis, std::filesystem::path(file).filename().string(), title).page();
}

} // namespace stylobate
