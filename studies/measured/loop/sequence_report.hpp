#pragma once
/// A sequence of tests, told step by step: what was believed, what was tested, what was seen in standard deviations,
/// what is believed now. Plain data; the text of the console and the part of a page are one function.

#include "studies/measured/loop/choice.hpp"
#include "studies/measured/loop/done_test.hpp"
#include "studies/report/document.hpp"
#include "studies/report/json.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// "nothing", "not listed", or a cause at its place.
struct BelievedShare {
    std::string what;
    double share = 0;
};

/// An estimate of a test, far from what was expected or not.
struct ToldEstimate {
    TestColumn column;
    SeenDeviation seen;
};

/// What the tests decide so far.
struct SequenceFinding {
    SequenceVerdict verdict = SequenceVerdict::open;
    double log_evidence = 0;          ///< ln E
    std::optional<std::string> cause; ///< named or suspected, at its place
    double share = 0;                 ///< its belief
    double size = 0;
    std::string unit;
    double deviations = 0; ///< along its shift
    bool doubtful = false;
    std::vector<TestColumn> off; ///< unexplained: the estimates that are off
};

struct SequenceStep {
    RunKind test = RunKind::pull;
    std::optional<int> joint;
    bool repeat = false;               ///< the same test was done before
    std::vector<BelievedShare> before; ///< the largest first
    std::vector<ToldEstimate> seen;    ///< the farthest first
    std::vector<BelievedShare> after;
    SequenceFinding finding;
};

struct SequenceReport {
    std::vector<BelievedShare> prior;
    std::vector<SequenceStep> steps;
    SequenceFinding finding;
    std::vector<SizeLimit> limits;     ///< of the causes that the tests would have shown
    std::vector<std::string> untested; ///< mechanisms that they would not
    std::vector<RatedTest> next;       ///< what may be done now, the best first
};

/// @param next options as rated after the last test; empty: nothing is proposed
SequenceReport sequence_report(const SequenceModel& model, const std::vector<DoneTest>& tests,
                               std::vector<RatedTest> next);

/// The finding in a sentence.
std::string finding_words(const SequenceFinding& finding);

/// Adds the finding, the proposal, the steps and the limits: to a text of the console and to a page alike.
void add_sequence(Document& document, const SequenceReport& report);

/// Adds planned tests (`planned_tests`), or why there is none. @param rated all options, for the reasons
void add_test_plan(Document& document, const std::vector<RatedTest>& plan, const std::vector<RatedTest>& rated);

/// {"verdict", "cause", "size", "ln_evidence", ..., "steps": [...], "limits": [...], "next": [...]}
Json json_of(const SequenceReport& report);

} // namespace stylobate
