#pragma once
/// The fields of a diagnosis (`ensemble/model/fields.hpp`): its file and its JSON object are made from them.

#include "io/tables/rows.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"

#include <type_traits>

namespace stylobate {

template <>
struct FieldWords<Verdict> {
    static constexpr const char* words[] = {"none", "named", "unexplained"};
};
template <>
struct FieldWords<TestOutcome> {
    static constexpr const char* words[] = {"passed", "failed", "not_judged"};
};
template <>
struct FieldWords<Decision> {
    static constexpr const char* words[] = {"named", "in_set", "rejected", "not_judged"}; // rejected: not_shown
};
template <>
struct FieldWords<SeriesKind> {
    static constexpr const char* words[] = {"line", "points", "band", "bars", "spans"};
};
template <>
struct FieldWords<FigurePlace> {
    static constexpr const char* words[] = {"verdict",    "data",        "baseline", "wrong",
                                            "candidates", "unexplained", "gain"};
};
template <class F>
void visit_fields(std::type_identity<DataTest>, F&& f)
{
    f("name", &DataTest::name);
    f("place", &DataTest::place);
    f("value", &DataTest::value);
    f("sd", &DataTest::sd);
    f("threshold", &DataTest::threshold);
    f("unit", &DataTest::unit);
    f("outcome", &DataTest::outcome);
    f("sentence", &DataTest::sentence);
}

template <class F>
void visit_fields(std::type_identity<CalibratedParameter>, F&& f)
{
    f("name", &CalibratedParameter::name);
    f("unit", &CalibratedParameter::unit);
    f("value", &CalibratedParameter::value);
    f("low", &CalibratedParameter::low);
    f("high", &CalibratedParameter::high);
    f("determined", &CalibratedParameter::determined);
    f("note", &CalibratedParameter::note);
}

template <class F>
void visit_fields(std::type_identity<WrongStretch>, F&& f)
{
    f("run", &WrongStretch::run);
    f("block", &WrongStretch::block);
    f("coordinate", &WrongStretch::coordinate);
    f("from_s", &WrongStretch::from_s);
    f("to_s", &WrongStretch::to_s);
    f("excess", &WrongStretch::excess);
}

template <class F>
void visit_fields(std::type_identity<Evidence>, F&& f)
{
    f("run", &Evidence::run);
    f("gain_nats", &Evidence::gain_nats);
    f("text", &Evidence::text);
}

template <class F>
void visit_fields(std::type_identity<Candidate>, F&& f)
{
    f("mechanism", &Candidate::mechanism);
    f("place", &Candidate::place);
    f("probability", &Candidate::probability);
    f("parameter", &Candidate::parameter);
    f("size", &Candidate::size);
    f("low", &Candidate::low);
    f("high", &Candidate::high);
    f("unit", &Candidate::unit);
    f("neutral", &Candidate::neutral);
    f("gain_nats", &Candidate::gain_nats);
    f("null95", &Candidate::null95);
    f("p", &Candidate::p);
    f("decision", &Candidate::decision);
    f("why", &Candidate::why);
    f("evidence", &Candidate::evidence);
}

template <class F>
void visit_fields(std::type_identity<NullEnsemble>, F&& f)
{
    f("form", &NullEnsemble::form);
    f("campaigns", &NullEnsemble::campaigns);
    f("what", &NullEnsemble::what);
}

template <class F>
void visit_fields(std::type_identity<RegressionFeature>, F&& f)
{
    f("name", &RegressionFeature::name);
    f("gain", &RegressionFeature::gain);
    f("threshold", &RegressionFeature::threshold);
}

template <class F>
void visit_fields(std::type_identity<Unexplained>, F&& f)
{
    f("block", &Unexplained::block);
    f("coordinate", &Unexplained::coordinate);
    f("depends_on", &Unexplained::depends_on);
    f("text", &Unexplained::text);
    f("features", &Unexplained::features);
}

template <class F>
void visit_fields(std::type_identity<CollapsePrediction>, F&& f)
{
    f("runs", &CollapsePrediction::runs);
    f("score_before", &CollapsePrediction::score_before);
    f("score_after", &CollapsePrediction::score_after);
    f("right_before", &CollapsePrediction::right_before);
    f("right_after", &CollapsePrediction::right_after);
    f("text", &CollapsePrediction::text);
}

template <class F>
void visit_fields(std::type_identity<ModelGain>, F&& f)
{
    f("error_before", &ModelGain::error_before);
    f("error_after", &ModelGain::error_after);
    f("low", &ModelGain::low);
    f("high", &ModelGain::high);
    f("runs_left_out", &ModelGain::runs_left_out);
    f("unit", &ModelGain::unit);
    f("floor", &ModelGain::floor);
    f("text", &ModelGain::text);
    f("collapse", &ModelGain::collapse);
}

template <class F>
void visit_fields(std::type_identity<Missing>, F&& f)
{
    f("what", &Missing::what);
    f("why", &Missing::why);
}

template <class F>
void visit_fields(std::type_identity<DiagnosisCost>, F&& f)
{
    f("simulations", &DiagnosisCost::simulations);
    f("window_simulations", &DiagnosisCost::window_simulations);
    f("block_steps", &DiagnosisCost::block_steps);
    f("seconds", &DiagnosisCost::seconds);
    f("threads", &DiagnosisCost::threads);
    f("lockstep_speedup", &DiagnosisCost::lockstep_speedup);
}

template <class F>
void visit_fields(std::type_identity<FigureSeries>, F&& f)
{
    f("name", &FigureSeries::name);
    f("kind", &FigureSeries::kind);
    f("x", &FigureSeries::x);
    f("y", &FigureSeries::y);
    f("low", &FigureSeries::low);
    f("high", &FigureSeries::high);
}

template <class F>
void visit_fields(std::type_identity<DiagnosisFigure>, F&& f)
{
    f("place", &DiagnosisFigure::place);
    f("title", &Figure::title);
    f("caption", &Figure::caption);
    f("x_label", &Figure::x_label);
    f("y_label", &Figure::y_label);
    f("x_log", &Figure::x_log);
    f("y_log", &Figure::y_log);
    f("x_ticks", &Figure::x_ticks);
    f("series", &Figure::series);
}

template <class F>
void visit_fields(std::type_identity<Diagnosis>, F&& f)
{
    f("measured_file", &Diagnosis::measured_file);
    f("measured_fingerprint", &Diagnosis::measured_fingerprint);
    f("specimen", &Diagnosis::specimen);
    f("study_toml", &Diagnosis::study_toml);
    f("code_version", &Diagnosis::code_version);
    f("command", &Diagnosis::command);
    f("seed", &Diagnosis::seed);
    f("options", &Diagnosis::options);
    f("runs", &Diagnosis::runs);
    f("runs_used", &Diagnosis::runs_used);
    f("data_findings", &Diagnosis::data_findings);
    f("base_tests", &Diagnosis::base_tests);
    f("sensor_tests", &Diagnosis::sensor_tests);
    f("baseline", &Diagnosis::baseline);
    f("wrong", &Diagnosis::wrong);
    f("candidates", &Diagnosis::candidates);
    f("nulls", &Diagnosis::nulls);
    f("verdict", &Diagnosis::verdict);
    f("verdict_text", &Diagnosis::verdict_text);
    f("indistinguishable", &Diagnosis::indistinguishable);
    f("unexplained", &Diagnosis::unexplained);
    f("extended_study", &Diagnosis::extended_study);
    f("extended_study_file", &Diagnosis::extended_study_file);
    f("gain", &Diagnosis::gain);
    f("missing", &Diagnosis::missing);
    f("method", &Diagnosis::method);
    f("cost", &Diagnosis::cost);
    f("figures", &Diagnosis::figures);
    f("tests", &Diagnosis::tests, {.since = 4});
    f("motion", &Diagnosis::motion, {.since = 3});
}

} // namespace stylobate
