#include "io/study/study_sensitivity.hpp"

#include "io/files/suggest.hpp"
#include "io/keys/kind_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace stylobate {

namespace {

/// Those named, in the order of `perturbed`; without the key all.
std::vector<std::string> read_factors(const KeyReader& keys, const std::vector<std::string>& perturbed)
{
    const TomlValue* list = keys.find(sensitivity_keys::factors.name);
    if (!list)
        return perturbed;
    const std::string known = fmt::format("Perturbed are {}.", fmt::join(perturbed, ", "));
    if (list->type != TomlValue::Type::array || list->entries.empty())
        keys.refuse(sensitivity_keys::factors.name, "is not a list of names",
                    "Give factors = [\"friction\", ...]. " + known);
    std::vector<std::string> named;
    for (const TomlValue& entry : list->entries) {
        if (entry.type != TomlValue::Type::string)
            keys.refuse(sensitivity_keys::factors.name,
                        fmt::format("has {}, which is {}", entry.shown(), entry.type_name()), known);
        if (std::find(perturbed.begin(), perturbed.end(), entry.text) == perturbed.end()) {
            const std::string near = nearest_word(entry.text, perturbed);
            keys.refuse(sensitivity_keys::factors.name,
                        fmt::format("names '{}', which [perturbation] does not", entry.text),
                        (near.empty() ? "" : fmt::format("Did you mean '{}'? ", near)) + known);
        }
        if (std::find(named.begin(), named.end(), entry.text) != named.end())
            keys.refuse(sensitivity_keys::factors.name, fmt::format("names '{}' twice", entry.text), "Name each once.");
        named.push_back(entry.text);
    }
    std::vector<std::string> factors;
    for (const std::string& name : perturbed)
        if (std::find(named.begin(), named.end(), name) != named.end())
            factors.push_back(name);
    return factors;
}

} // namespace

std::vector<std::string> perturbed_names(const Study& study)
{
    std::vector<std::string> names;
    for (const Perturbation& p : study.perturbations)
        names.emplace_back(to_string(p.quantity));
    for (const MechanismPerturbation& p : study.mechanism_perturbations)
        names.push_back(input_name(p.mechanism, rule_of(p.mechanism).parameters[p.parameter]));
    return names;
}

SensitivitySpec read_sensitivity(const KeyReader& keys, const Study& study)
{
    const std::vector<std::string> perturbed = perturbed_names(study);
    if (perturbed.empty())
        keys.refuse_all("study.kind = \"sensitivity\" needs perturbed quantities, and [perturbation] has none.\n  Give "
                        "distributions there, for example friction = { distribution = \"normal\", cov = "
                        "0.1 }.");
    SensitivitySpec spec;
    spec.method = keys.read(sensitivity_keys::method);
    spec.factors = read_factors(keys, perturbed);
    const bool rest = spec.factors.size() < perturbed.size() || study.excitation.kind == ExcitationKind::noise;
    spec.inner = keys.read_or(sensitivity_keys::inner, rest ? 4 : 1);
    if (rest && spec.inner == 1)
        keys.refuse(sensitivity_keys::inner.name, "cannot separate the factors from the other random quantities",
                    "Give 2 or more (4 is recommended), or name every perturbed quantity in factors.");
    if (!rest && spec.inner > 1)
        keys.refuse(sensitivity_keys::inner.name,
                    "would run the same realizations again: every perturbed quantity is a factor",
                    "Give 1, or omit some quantities from factors.");
    const std::uint64_t of_row = spec.points() * spec.inner;
    spec.samples = keys.whole(
        sensitivity_keys::samples.name, sensitivity_keys::samples.low, most_realizations / of_row,
        fmt::format("Rows of the design, each of {} points with {} realizations.", spec.points(), spec.inner));
    return spec;
}

RareSpec read_rare(const KeyReader& keys, const Study& study)
{
    if (perturbed_names(study).empty())
        keys.refuse_all(
            "study.kind = \"rare\" needs random quantities, and [perturbation] has none.\n  Give distributions there.");
    if (study.excitation.kind == ExcitationKind::noise)
        keys.refuse_all("study.kind = \"rare\" has no chains of synthetic earthquakes: excitation.kind = \"noise\" "
                        "draws thousands of numbers for each.\n  Give another excitation.");
    RareSpec spec;
    spec.samples = keys.read(rare_keys::samples);
    spec.repeats = keys.read(rare_keys::repeats);
    return spec;
}

} // namespace stylobate
