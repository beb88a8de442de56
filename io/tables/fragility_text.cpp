#include "io/files/utf8.hpp"
#include "io/tables/csv.hpp"
#include "io/tables/fragility_exchange.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace stylobate {
namespace {

std::string quoted(const std::string& text)
{
    std::string out = "\"";
    for (const char c : replaced_text(text))
        if (c == '"' || c == '\\')
            out += {'\\', c};
        else if (static_cast<unsigned char>(c) < 0x20)
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            out += c;
    return out + '"';
}

/// JSON has no infinity: an open end is null.
std::string number(double value)
{
    return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

std::string member(const char* name, const FragilityValue& value)
{
    return fmt::format("\"{}\": {}, \"{}_lower\": {}, \"{}_upper\": {}", name, number(value.value), name,
                       number(value.lower), name, number(value.upper));
}

std::string list(const char* name, const std::vector<FragilityValue>& values, double FragilityValue::*part)
{
    std::string out = fmt::format("\"{}\": [", name);
    for (std::size_t i = 0; i < values.size(); ++i)
        out += (i > 0 ? ", " : "") + number(values[i].*part);
    return out + ']';
}

} // namespace

std::string fragility_json(const FragilityModel& model)
{
    check_fragility_model(model);
    std::string out = fmt::format("{{\"format\": \"stylobate-fragility\", \"format_version\": 1,\n \"id\": {}, "
                                  "\"description\": {}, \"level\": {},\n \"limit_states\": [",
                                  quoted(model.id), quoted(model.description), model.level);
    for (std::size_t s = 0; s < model.limit_states.size(); ++s)
        out += (s > 0 ? ", " : "") + quoted(model.limit_states[s]);
    out += "],\n \"functions\": [";
    for (std::size_t f = 0; f < model.functions.size(); ++f) {
        const FragilityFunction& function = model.functions[f];
        out +=
            fmt::format("{}\n  {{\"id\": {}, \"measure\": {}, \"unit\": \"SI\", \"form\": \"{}\", \"note\": {},\n   ",
                        f > 0 ? "," : "", quoted(function.id), quoted(function.measure),
                        function.discrete ? "discrete" : "lognormal", quoted(function.note));
        if (function.discrete) {
            out += "\"intensity\": [";
            for (std::size_t i = 0; i < function.intensity.size(); ++i)
                out += (i > 0 ? ", " : "") + number(function.intensity[i]);
            out += "],";
        } else
            out += fmt::format("\"least\": {}, \"most\": {},", number(function.least), number(function.most));
        out += "\n   \"states\": [";
        for (std::size_t s = 0; s < function.states.size(); ++s) {
            const FragilityState& state = function.states[s];
            out += fmt::format("{}\n    {{\"limit_state\": {}, ", s > 0 ? "," : "", quoted(model.limit_states[s]));
            if (function.discrete)
                out += list("probability", state.probability, &FragilityValue::value) + ", " +
                       list("lower", state.probability, &FragilityValue::lower) + ", " +
                       list("upper", state.probability, &FragilityValue::upper);
            else
                out += member("median", state.median) + ", " + member("dispersion", state.dispersion);
            out += '}';
        }
        out += "]}";
    }
    return out + "]}\n";
}

std::string fragility_csv(const FragilityModel& model)
{
    check_fragility_model(model);
    std::string out = "function,measure,limit_state,intensity,probability,probability_lower,probability_upper,median,"
                      "median_lower,median_upper,dispersion,dispersion_lower,dispersion_upper\n";
    for (const FragilityFunction& function : model.functions)
        for (std::size_t s = 0; s < function.states.size(); ++s) {
            const FragilityState& state = function.states[s];
            const std::string start = csv_field(function.id) + ',' + csv_field(function.measure) + ',' +
                                      csv_field(model.limit_states[s]) + ',';
            if (function.discrete)
                for (std::size_t i = 0; i < function.intensity.size(); ++i)
                    fmt::format_to(std::back_inserter(out), "{}{},{},{},{},,,,,,\n", start, function.intensity[i],
                                   state.probability[i].value, state.probability[i].lower, state.probability[i].upper);
            else
                fmt::format_to(std::back_inserter(out), "{},,,,{},{},{},{},{},{}\n", start, state.median.value,
                               state.median.lower, state.median.upper, state.dispersion.value, state.dispersion.lower,
                               state.dispersion.upper);
        }
    return out;
}

} // namespace stylobate
