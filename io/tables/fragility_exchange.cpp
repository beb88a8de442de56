#include "io/tables/fragility_exchange.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/utf8.hpp"
#include "io/tables/table.hpp"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>

namespace stylobate {

namespace {

constexpr double standard_gravity = 9.80665;

[[noreturn]] void refuse(const FragilityFunction& function, const std::string& text)
{
    throw InputError(fmt::format("fragility function '{}': {}", function.id, text));
}

void check_value(const FragilityFunction& function, const std::string& what, const FragilityValue& value, double least,
                 double most)
{
    if (!(value.value >= least && value.value <= most && std::isfinite(value.value)))
        refuse(function, fmt::format("{} = {} is outside [{}, {}].\n  Where an estimate has no curve, export its "
                                     "bounds as a discrete function.",
                                     what, value.value, least, most));
    const bool no_interval = std::isnan(value.lower) && std::isnan(value.upper); // too few motions
    if (!no_interval && !(value.lower <= value.value && value.value <= value.upper))
        refuse(function,
               fmt::format("{} = {} is outside its interval [{}, {}].", what, value.value, value.lower, value.upper));
}

double probability(const FragilityState& state, double intensity)
{
    return std::erfc(-std::log(intensity / state.median.value) / state.dispersion.value / std::sqrt(2.0)) / 2;
}

/// Damage is shared out by differences of neighbours: a later state that is more probable makes one negative.
void check_order(const FragilityModel& model, const FragilityFunction& function)
{
    const auto refuse_order = [&](std::size_t state, double intensity, double before, double here) {
        refuse(function,
               fmt::format("limit states in the wrong order: at intensity {:.4g} '{}' has probability {:.4g}, "
                           "but '{}' before it {:.4g}.\n  Order them from the first to be reached, narrow the range, "
                           "or export shares by stripe.",
                           intensity, model.limit_states[state], here, model.limit_states[state - 1], before));
    };
    for (std::size_t s = 1; s < function.states.size(); ++s) {
        const FragilityState &before = function.states[s - 1], &here = function.states[s];
        if (function.discrete) {
            for (std::size_t i = 0; i < function.intensity.size(); ++i)
                if (here.probability[i].value > before.probability[i].value + 1e-9)
                    refuse_order(s, function.intensity[i], before.probability[i].value, here.probability[i].value);
            continue;
        }
        // two lognormal curves cross once at most: their order at the ends of the range decides
        for (const double intensity : {function.least, function.most})
            if (probability(here, intensity) > probability(before, intensity) + 1e-3)
                refuse_order(s, intensity, probability(before, intensity), probability(here, intensity));
    }
}

} // namespace

double per_si_unit(const std::string& measure)
{
    if (measure == "PGA")
        return 1 / standard_gravity;
    if (measure == "PGV" || measure == "PGD")
        return 100;
    if (measure == "IA")
        return 1;
    if (measure == "CAV")
        return 1 / standard_gravity;
    if (measure.starts_with("SA(") && measure.ends_with(")")) {
        double period = 0;
        const char* const end = measure.data() + measure.size() - 1;
        const auto [rest, error] = std::from_chars(measure.data() + 3, end, period);
        if (error == std::errc() && rest == end && period > 0)
            return 1 / standard_gravity;
    }
    throw InputError(fmt::format("fragility: '{}' is not a known intensity measure of OpenQuake.\n  Known: PGA, "
                                 "PGV, PGD, SA(period), IA, CAV.",
                                 measure));
}

const char* openquake_unit(const std::string& measure)
{
    per_si_unit(measure); // refuses an unknown one
    return measure == "PGV"   ? "cm/s"
           : measure == "PGD" ? "cm"
           : measure == "IA"  ? "m/s"
           : measure == "CAV" ? "g s"
                              : "g";
}

void check_fragility_model(const FragilityModel& model)
{
    if (model.limit_states.empty() || model.functions.empty())
        throw InputError("fragility model: it has no limit states or no functions.");
    std::set<std::string> names;
    for (const std::string& name : model.limit_states)
        if (name.empty() || name.find_first_of(" \t\r\n") != std::string::npos || !names.insert(name).second)
            throw InputError(fmt::format("fragility model: limit state '{}' is empty, has a blank, or comes twice.\n  "
                                         "NRML separates limit states by blanks: write fallen_drum.",
                                         name));
    std::set<std::string> ids;
    for (const FragilityFunction& function : model.functions) {
        if (function.id.empty() || !ids.insert(function.measure + ' ' + function.id).second)
            refuse(function, "its name is empty or comes twice.");
        per_si_unit(function.measure);
        if (function.states.size() != model.limit_states.size())
            refuse(function, fmt::format("it has {} limit states, the model {}.", function.states.size(),
                                         model.limit_states.size()));
        if (function.discrete) {
            const auto& at = function.intensity;
            if (at.size() < 2 || !(at.front() > 0) ||
                std::adjacent_find(at.begin(), at.end(), [](double a, double b) { return !(a < b); }) != at.end())
                refuse(function, "its intensities are not two or more, above 0 and ascending.");
        } else if (!(function.least > 0 && function.least < function.most && std::isfinite(function.most)))
            refuse(function, fmt::format("its range of intensity [{}, {}] is not above 0 and ascending.",
                                         function.least, function.most));
        for (std::size_t s = 0; s < function.states.size(); ++s) {
            const FragilityState& state = function.states[s];
            const std::string& name = model.limit_states[s];
            if (!function.discrete) {
                check_value(function, name + ": median", state.median, 1e-300, 1e300);
                check_value(function, name + ": dispersion", state.dispersion, 1e-6, 10);
                continue;
            }
            if (state.probability.size() != function.intensity.size())
                refuse(function, fmt::format("{}: {} probabilities at {} intensities.", name, state.probability.size(),
                                             function.intensity.size()));
            for (const FragilityValue& value : state.probability)
                check_value(function, name + ": probability", value, 0, 1);
        }
        check_order(model, function);
    }
}

namespace {

constexpr const char* nrml_namespace = "http://openquake.org/xmlns/nrml/0.5";

void set(pugi::xml_node node, const char* name, const std::string& value)
{
    node.append_attribute(name).set_value(replaced_text(value).c_str());
}

/// Two hyphens end a comment.
void append_comment(pugi::xml_node node, std::string text)
{
    for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--"))
        text.replace(at, 2, "- ");
    if (text.ends_with('-'))
        text += ' ';
    node.append_child(pugi::node_comment).set_value((" " + replaced_text(text) + " ").c_str());
}

std::string interval(const FragilityValue& value, double scale)
{
    if (std::isnan(value.lower))
        return fmt::format("{:.6g} (no interval)", value.value * scale);
    return fmt::format("{:.6g} ({:.6g} to {:.6g})", value.value * scale, value.lower * scale, value.upper * scale);
}

void append_function(pugi::xml_node model_node, const FragilityModel& model, const FragilityFunction& function)
{
    const double scale = per_si_unit(function.measure);
    pugi::xml_node node = model_node.append_child("fragilityFunction");
    set(node, "id", function.id);
    set(node, "format", function.discrete ? "discrete" : "continuous");
    if (!function.discrete)
        set(node, "shape", "logncdf");
    pugi::xml_node imls = node.append_child("imls");
    set(imls, "imt", function.measure);
    set(imls, "noDamageLimit", "0");
    if (function.discrete) {
        std::string text;
        for (const double intensity : function.intensity)
            text += fmt::format("{}{}", text.empty() ? "" : " ", intensity * scale);
        imls.text().set(text.c_str());
    } else {
        set(imls, "minIML", fmt::format("{}", function.least * scale));
        set(imls, "maxIML", fmt::format("{}", function.most * scale));
    }
    append_comment(node, fmt::format("intensities in {}", openquake_unit(function.measure)));
    if (!function.note.empty())
        append_comment(node, function.note);
    for (std::size_t s = 0; s < function.states.size(); ++s) {
        const FragilityState& state = function.states[s];
        if (function.discrete) {
            std::string text, bounds;
            for (const FragilityValue& value : state.probability) {
                text += fmt::format("{}{}", text.empty() ? "" : " ", value.value);
                bounds += bounds.empty() ? " " : ", ";
                bounds += std::isnan(value.lower) ? "none" : fmt::format("{:.6g} to {:.6g}", value.lower, value.upper);
            }
            append_comment(node, fmt::format("{} at {:g} %:{}", model.limit_states[s], 100 * model.level, bounds));
            pugi::xml_node poes = node.append_child("poes");
            set(poes, "ls", model.limit_states[s]);
            poes.text().set(text.c_str());
        } else {
            const double square = state.dispersion.value * state.dispersion.value;
            const double mean = state.median.value * scale * std::exp(square / 2);
            append_comment(node, fmt::format("{} at {:g} %: median {}, dispersion {}", model.limit_states[s],
                                             100 * model.level, interval(state.median, scale),
                                             interval(state.dispersion, 1)));
            pugi::xml_node params = node.append_child("params");
            set(params, "ls", model.limit_states[s]);
            set(params, "mean", fmt::format("{}", mean));
            set(params, "stddev", fmt::format("{}", mean * std::sqrt(std::expm1(square))));
        }
    }
}

} // namespace

std::string fragility_nrml(const FragilityModel& model)
{
    check_fragility_model(model);
    pugi::xml_document document;
    pugi::xml_node declaration = document.append_child(pugi::node_declaration);
    set(declaration, "version", "1.0");
    set(declaration, "encoding", "UTF-8");
    pugi::xml_node nrml = document.append_child("nrml");
    set(nrml, "xmlns", nrml_namespace);
    pugi::xml_node node = nrml.append_child("fragilityModel");
    set(node, "id", model.id);
    set(node, "assetCategory", "buildings");
    set(node, "lossCategory", "structural");
    // OpenQuake refuses a model without a description
    node.append_child("description")
        .text()
        .set(model.description.empty() ? "Fragility functions; their intervals are in the comments."
                                       : model.description.c_str());
    std::string states;
    for (const std::string& state : model.limit_states)
        states += (states.empty() ? "" : " ") + state;
    node.append_child("limitStates").text().set(states.c_str());
    for (const FragilityFunction& function : model.functions)
        append_function(node, model, function);
    std::ostringstream out;
    document.save(out, "  ");
    return out.str();
}

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
