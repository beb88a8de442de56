#pragma once
/// What a sequence of tests of single joints has shown, as plain data: what was believed, what was tested, what was
/// seen, what is believed now, and which test comes next. Part of a `Diagnosis`, of its file, its JSON and its page.

#include "io/tables/rows.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace stylobate {

enum class SequenceVerdict {
    open,        ///< something is suspected and nothing decided
    named,       ///< a cause acts
    unexplained, ///< an estimator is beyond healthy specimens, and no listed cause gives it
    none         ///< nothing acts that the tests would have shown
};
const char* to_string(SequenceVerdict verdict);

/// One number of a test, beside healthy specimens.
struct StoryEstimate {
    std::string name; ///< "pull.speed"
    std::string what; ///< in words
    int joint = 0;
    double value = 0;
    double sd = 0; ///< of the measurement
    std::string unit;
    double expected = 0;   ///< of healthy specimens, or by the other joints
    double deviations = 0; ///< from there, in standard deviations
    bool from_the_others = false;
    friend bool operator==(const StoryEstimate&, const StoryEstimate&) = default;
};

/// A share of belief before and after a test.
struct StoryBelief {
    std::string what; ///< "nothing", "stribeck at all", "what is not listed"
    double before = 0;
    double after = 0;
    friend bool operator==(const StoryBelief&, const StoryBelief&) = default;
};

struct StoryStep {
    std::string test;   ///< "pull"
    std::string joints; ///< "0, 1, 2"
    std::vector<StoryEstimate> seen;
    std::vector<StoryBelief> beliefs; ///< largest after the test first; small ones are left out
    double log_evidence = 0;          ///< ln E of all tests so far
    SequenceVerdict verdict = SequenceVerdict::open;
    std::string text; ///< what it showed
    friend bool operator==(const StoryStep&, const StoryStep&) = default;
};

/// The largest size of a cause that the tests leave possible.
struct StoryLimit {
    std::string cause; ///< "dowel at joint 1"
    std::string size;  ///< "yield_n = 0.12 N"; empty: the strongest that was simulated is not excluded
    friend bool operator==(const StoryLimit&, const StoryLimit&) = default;
};

/// A test that could come next.
struct StoryOption {
    std::string test;
    double cost = 1;
    double entropy_fall = 0; ///< of the belief, expected [nats]
    double belief_gain = 0;  ///< in what acts, expected
    double per_cost = 0;     ///< of the gain
    std::string left_out;    ///< why it is no choice; empty: it is one
    friend bool operator==(const StoryOption&, const StoryOption&) = default;
};

/// A cause that the tests name.
struct StoryCause {
    std::string mechanism, place, parameter, unit;
    double size = 0;                 ///< of its parameter
    std::optional<double> low, high; ///< 90 %
    double share = 0;                ///< of belief
    double log_evidence = 0;         ///< ln E; of a further cause with those before it given
    friend bool operator==(const StoryCause&, const StoryCause&) = default;
};

struct TestStory {
    SequenceVerdict verdict = SequenceVerdict::open;
    std::string text;               ///< the answer in one to three sentences
    std::vector<StoryCause> named;  ///< the strongest first, then those at other places beside it
    double share = 0;               ///< of belief
    double log_evidence = 0;        ///< ln E
    std::vector<StoryBelief> prior; ///< before the first test: `before` and `after` are equal
    std::vector<StoryStep> steps;
    std::vector<StoryLimit> limits;
    std::vector<StoryOption> options; ///< best first
    std::vector<std::string> next;    ///< tests to do next, the first first; empty: none
    std::vector<std::string> sheet;   ///< instructions for the first of them, a line each
    std::vector<std::string> notes;   ///< what could not be used
    std::uint64_t simulations = 0;
    double seconds = 0;
    friend bool operator==(const TestStory&, const TestStory&) = default;
};

template <>
struct FieldWords<SequenceVerdict> {
    static constexpr const char* words[] = {"open", "named", "unexplained", "none"};
};

template <class F>
void visit_fields(std::type_identity<StoryEstimate>, F&& f)
{
    f("name", &StoryEstimate::name);
    f("what", &StoryEstimate::what);
    f("joint", &StoryEstimate::joint);
    f("value", &StoryEstimate::value);
    f("sd", &StoryEstimate::sd);
    f("unit", &StoryEstimate::unit);
    f("expected", &StoryEstimate::expected);
    f("deviations", &StoryEstimate::deviations);
    f("from_the_others", &StoryEstimate::from_the_others);
}

template <class F>
void visit_fields(std::type_identity<StoryBelief>, F&& f)
{
    f("what", &StoryBelief::what);
    f("before", &StoryBelief::before);
    f("after", &StoryBelief::after);
}

template <class F>
void visit_fields(std::type_identity<StoryStep>, F&& f)
{
    f("test", &StoryStep::test);
    f("joints", &StoryStep::joints);
    f("seen", &StoryStep::seen);
    f("beliefs", &StoryStep::beliefs);
    f("log_evidence", &StoryStep::log_evidence);
    f("verdict", &StoryStep::verdict);
    f("text", &StoryStep::text);
}

template <class F>
void visit_fields(std::type_identity<StoryLimit>, F&& f)
{
    f("cause", &StoryLimit::cause);
    f("size", &StoryLimit::size);
}

template <class F>
void visit_fields(std::type_identity<StoryOption>, F&& f)
{
    f("test", &StoryOption::test);
    f("cost", &StoryOption::cost);
    f("entropy_fall", &StoryOption::entropy_fall);
    f("belief_gain", &StoryOption::belief_gain);
    f("per_cost", &StoryOption::per_cost);
    f("left_out", &StoryOption::left_out);
}

template <class F>
void visit_fields(std::type_identity<StoryCause>, F&& f)
{
    f("mechanism", &StoryCause::mechanism);
    f("place", &StoryCause::place);
    f("parameter", &StoryCause::parameter);
    f("unit", &StoryCause::unit);
    f("size", &StoryCause::size);
    f("low", &StoryCause::low);
    f("high", &StoryCause::high);
    f("share", &StoryCause::share);
    f("log_evidence", &StoryCause::log_evidence);
}

template <class F>
void visit_fields(std::type_identity<TestStory>, F&& f)
{
    f("verdict", &TestStory::verdict);
    f("text", &TestStory::text);
    f("named", &TestStory::named);
    f("share", &TestStory::share);
    f("log_evidence", &TestStory::log_evidence);
    f("prior", &TestStory::prior);
    f("steps", &TestStory::steps);
    f("limits", &TestStory::limits);
    f("options", &TestStory::options);
    f("next", &TestStory::next);
    f("sheet", &TestStory::sheet);
    f("notes", &TestStory::notes);
    f("simulations", &TestStory::simulations);
    f("seconds", &TestStory::seconds);
}

} // namespace stylobate
