#include "studies/measured/diagnosis/findings/diagnosis_json.hpp"

#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"

#include <algorithm>
#include <limits>

namespace stylobate {
namespace {

/// Not finite, hence null, where it is not known.
double known(MaybeReal value)
{
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

template <class T, class F>
Json objects(const std::vector<T>& list, F object)
{
    Json json = Json::list();
    for (const T& item : list)
        json.item(object(item));
    return json;
}

/// The member `key`: an object, or null where there is nothing.
template <class T, class F>
void add(Json& json, const char* key, const std::optional<T>& part, F object)
{
    if (part)
        json.member(key, object(*part));
    else
        json.member(key, std::numeric_limits<double>::quiet_NaN());
}

/// An item of `causes`.
Json cause(const Candidate& c)
{
    return Json::object()
        .member("name", c.mechanism)
        .member("place", c.place)
        .member("probability", known(c.probability))
        .member("parameter", c.parameter)
        .member("size", known(c.size))
        .member("low", known(c.low))
        .member("high", known(c.high));
}

Json evidence(const Evidence& e)
{
    return Json::object().member("run", e.run).member("gain_nats", known(e.gain_nats)).member("text", e.text);
}

Json candidate(const Candidate& c)
{
    return cause(c)
        .member("unit", c.unit)
        .member("neutral", known(c.neutral))
        .member("gain_nats", known(c.gain_nats))
        .member("null95", known(c.null95))
        .member("p", known(c.p))
        .member("decision", to_string(c.decision))
        .member("why", c.why)
        .member("evidence", objects(c.evidence, evidence));
}

Json unexplained(const Unexplained& u)
{
    return Json::object()
        .member("block", u.block)
        .member("coordinate", u.coordinate)
        .member("depends_on", u.depends_on)
        .member("text", u.text)
        .member("features", objects(u.features, [](const RegressionFeature& f) {
                    return Json::object()
                        .member("name", f.name)
                        .member("gain", known(f.gain))
                        .member("threshold", known(f.threshold));
                }));
}

Json wrong(const WrongStretch& w)
{
    return Json::object()
        .member("run", w.run)
        .member("block", w.block)
        .member("coordinate", w.coordinate)
        .member("from_s", w.from_s)
        .member("to_s", w.to_s)
        .member("excess", w.excess);
}

Json gain(const ModelGain& g)
{
    Json json = Json::object()
                    .member("error_before", known(g.error_before))
                    .member("error_after", known(g.error_after))
                    .member("low", known(g.low))
                    .member("high", known(g.high))
                    .member("runs_left_out", Json::list(g.runs_left_out))
                    .member("unit", g.unit)
                    .member("floor", known(g.floor))
                    .member("text", g.text);
    add(json, "collapse", g.collapse, [](const CollapsePrediction& c) {
        return Json::object()
            .member("runs", c.runs)
            .member("score_before", known(c.score_before))
            .member("score_after", known(c.score_after))
            .member("right_before", c.right_before)
            .member("right_after", c.right_after)
            .member("text", c.text);
    });
    return json;
}

Json next_test(const NextTest& n)
{
    return Json::object()
        .member("excitation", n.excitation)
        .member("separates", Json::list(n.separates))
        .member("text", n.text)
        .member("motions", objects(n.motions, [](const MotionChoice& m) {
                    return Json::object()
                        .member("motion", m.motion)
                        .member("separation", known(m.separation))
                        .member("text", m.text);
                }));
}

Json data_test(const DataTest& t)
{
    return Json::object()
        .member("name", t.name)
        .member("place", t.place)
        .member("value", known(t.value))
        .member("sd", known(t.sd))
        .member("threshold", known(t.threshold))
        .member("unit", t.unit)
        .member("outcome", to_string(t.outcome))
        .member("text", t.sentence);
}

Json parameter(const CalibratedParameter& p)
{
    return Json::object()
        .member("name", p.name)
        .member("unit", p.unit)
        .member("value", known(p.value))
        .member("low", known(p.low))
        .member("high", known(p.high))
        .member("determined", p.determined)
        .member("note", p.note);
}

} // namespace

Json diagnosis_json(const Diagnosis& d)
{
    Json causes = Json::list();
    for (const Candidate* named : named_causes(d))
        causes.item(cause(*named));
    Json json = Json::object()
                    .member("verdict", to_string(d.verdict))
                    .member("causes", causes)
                    .member("indistinguishable", Json::list(d.indistinguishable));
    add(json, "unexplained", d.unexplained, unexplained);
    json.member("wrong", objects(d.wrong, wrong));
    add(json, "gain", d.gain, gain);
    add(json, "next_test", d.next_test, next_test);
    add(json, "extended_study",
        d.extended_study_file.empty() ? std::nullopt : std::optional<std::string>(d.extended_study_file),
        [](const std::string& file) { return std::string_view(file); });
    json.member("simulations", d.cost.simulations).member("seconds", d.cost.seconds);

    json.member("heading", verdict_heading(d))
        .member("text", verdict_words(d))
        .member("specimen", d.specimen)
        .member("measured", d.measured_file)
        .member("measured_fingerprint", d.measured_fingerprint)
        .member("runs", d.runs)
        .member("runs_used", d.runs_used)
        .member("code_version", d.code_version)
        .member("seed", d.seed)
        .member("options", Json::list(d.options))
        .member("data_findings", Json::list(d.data_findings))
        .member("base_tests", objects(d.base_tests, data_test))
        .member("sensor_tests", objects(d.sensor_tests, data_test))
        .member("baseline", objects(d.baseline, parameter))
        .member("candidates", objects(d.candidates, candidate))
        .member("nulls", objects(d.nulls,
                                 [](const NullEnsemble& n) {
                                     return Json::object()
                                         .member("form", n.form)
                                         .member("campaigns", n.campaigns)
                                         .member("what", n.what);
                                 }))
        .member("missing",
                objects(d.missing,
                        [](const Missing& m) { return Json::object().member("what", m.what).member("why", m.why); }))
        .member("window_simulations", d.cost.window_simulations)
        .member("block_steps", d.cost.block_steps)
        .member("threads", d.cost.threads)
        .member("lockstep_speedup", known(d.cost.lockstep_speedup));
    return json;
}

} // namespace stylobate
