#include "studies/measured/diagnosis/findings/diagnosis_json.hpp"

#include "studies/measured/diagnosis/findings/diagnosis_fields.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"

namespace stylobate {
namespace {

/// An item of `causes`.
Json cause(const Candidate* c)
{
    return json_of(*c, {{"name", "mechanism"}, "place", "probability", "parameter", "size", "low", "high"});
}

Json candidate(const Candidate& c)
{
    Json json = cause(&c);
    return add_members(json, c, {"unit", "neutral", "gain_nats", "null95", "p", "decision", "why", "evidence"});
}

Json data_test(const DataTest& t)
{
    return json_of(t, {"name", "place", "value", "sd", "threshold", "unit", "outcome", {"text", "sentence"}});
}

} // namespace

Json diagnosis_json(const Diagnosis& d)
{
    Json json = json_of(d, {"verdict"});
    json.member("causes", json_list(named_causes(d), cause));
    add_members(json, d, {"indistinguishable", "unexplained", "wrong", "gain", "next_test"});
    add_member(json, "extended_study",
               d.extended_study_file.empty() ? std::nullopt : std::optional<std::string>(d.extended_study_file));
    add_members(json, d.cost, {"simulations", "seconds"});

    json.member("heading", verdict_heading(d)).member("text", verdict_words(d));
    add_members(json, d,
                {"specimen",
                 {"measured", "measured_file"},
                 "measured_fingerprint",
                 "runs",
                 "runs_used",
                 "code_version",
                 "seed",
                 "options",
                 "data_findings"});
    json.member("base_tests", json_list(d.base_tests, data_test))
        .member("sensor_tests", json_list(d.sensor_tests, data_test));
    add_members(json, d, {"baseline"});
    json.member("candidates", json_list(d.candidates, candidate));
    add_members(json, d, {"nulls", "missing"});
    return add_members(json, d.cost, {"window_simulations", "block_steps", "threads", "lockstep_speedup"});
}

} // namespace stylobate
