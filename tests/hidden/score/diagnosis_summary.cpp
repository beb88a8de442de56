#include "tests/hidden/score/diagnosis_summary.hpp"

#include "ensemble/model/input_error.hpp"
#include "tests/program/json.hpp"

#include <fstream>
#include <iterator>
#include <limits>

namespace stylobate::hidden {

namespace {

using Kind = JsonValue::Kind;

double number_or_nan(const JsonValue& object, const char* key)
{
    if (!object.has(key) || object[key].kind != Kind::number)
        return std::numeric_limits<double>::quiet_NaN();
    return object[key].number;
}

std::string text_or_empty(const JsonValue& object, const char* key)
{
    return object.has(key) && object[key].kind == Kind::text ? object[key].text : "";
}

} // namespace

DiagnosisSummary parse_diagnosis(std::string_view text, const std::string& name)
{
    const auto fail = [&](const std::string& what) {
        throw InputError(name, 0, what + "\n  Give what 'stylobate diagnose --json' prints.");
    };
    JsonValue root;
    try {
        root = JsonParser::parse(text);
    } catch (const std::runtime_error& error) {
        fail(error.what());
    }
    DiagnosisSummary said;
    said.verdict = text_or_empty(root, "verdict");
    if (said.verdict != "none" && said.verdict != "named" && said.verdict != "unexplained")
        fail("'verdict' is none of none, named and unexplained.");
    if (root.has("causes"))
        for (const JsonValue& one : root["causes"].items) {
            SaidCause cause;
            cause.name = text_or_empty(one, "name");
            cause.place = text_or_empty(one, "place");
            cause.parameter = text_or_empty(one, "parameter");
            cause.probability = number_or_nan(one, "probability");
            if (cause.name.empty() || !(cause.probability >= 0 && cause.probability <= 1))
                fail("a cause lacks its name, or its probability is not from 0 to 1.");
            cause.size = number_or_nan(one, "size");
            cause.low = number_or_nan(one, "low");
            cause.high = number_or_nan(one, "high");
            said.causes.push_back(cause);
        }
    if (said.verdict == "named" && said.causes.empty())
        fail("the verdict is 'named' but there are no causes.");
    if (root.has("indistinguishable"))
        for (const JsonValue& one : root["indistinguishable"].items)
            said.indistinguishable.push_back(one.text);
    const double seconds = number_or_nan(root, "seconds");
    said.seconds = seconds >= 0 ? seconds : 0;
    return said;
}

DiagnosisSummary read_diagnosis(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw InputError(file.string(), 0, "cannot be read.");
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    return parse_diagnosis(text, file.string());
}

} // namespace stylobate::hidden
