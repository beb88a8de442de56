#include "io/keys/spread_key.hpp"

#include "io/keys/mechanism_keys.hpp"
#include "io/keys/study_keys.hpp"
#include "io/keys/words.hpp"

#include <fmt/format.h>

#include <memory>
#include <numbers>

namespace stylobate {

namespace {

constexpr Name<Per> joint{"joint", Per::joint}, block{"block", Per::block}, structure{"structure", Per::structure};

std::vector<Name<DistributionKind>> distributions(bool relative)
{
    std::vector<Name<DistributionKind>> allowed;
    for (const auto& name : distribution_names)
        if (relative || name.value == DistributionKind::normal || name.value == DistributionKind::uniform)
            allowed.push_back(name);
    return allowed;
}

/// A full turn of an angle, over which a uniform distribution goes without ends; 0 of what is no such angle.
double turn_of(Quantity quantity)
{
    return quantity == Quantity::phase ? 2 * std::numbers::pi : quantity == Quantity::direction ? 360 : 0;
}

/// The same for people.
std::string turn_words(double turn)
{
    return turn == 360 ? "360" : "2 pi";
}

std::unique_ptr<SpreadKey> make(Quantity quantity)
{
    const auto key = [&](const Range& value, bool relative, const char* sd, std::vector<Name<Per>> allowed,
                         const char* means, KeyFacts facts = {}) {
        facts.absent = "not perturbed";
        SpreadKey::Quality quality{value, sd, relative, std::move(allowed)};
        quality.turn = turn_of(quantity);
        if (quantity == Quantity::normal_stiffness || quantity == Quantity::tangential_stiffness)
            quality.deviation_models = in_plane(); // in space a stiffness is per area
        return std::make_unique<SpreadKey>(to_string(quantity), means, quality, std::move(facts));
    };
    using Motion = ExcitationKind;
    switch (quantity) {
    case Quantity::friction:
        return key(friction_range, true, "sd", {joint, structure}, "coefficient of friction, each joint about its own",
                   {.example = "{ distribution = \"normal\", cov = 0.1, min = 0.36, max = 0.84 }"});
    case Quantity::normal_stiffness:
        return key(normal_stiffness_range, true, "sd_n_m2", {structure, joint},
                   "K_N, in space the stiffness per area, each joint about its own",
                   {.used = {compliant()}, .example = "{ distribution = \"lognormal\", sigma_ln = 0.7 }"});
    case Quantity::tangential_stiffness:
        return key(tangential_stiffness_range, true, "sd_n_m", {structure, joint},
                   "K_T, in space that per area, each joint about its own", {.used = {compliant()}});
    case Quantity::damping_ratio:
        return key(damping_ratio_range, true, "sd", {structure}, "both damping ratios at once",
                   {.used = {compliant()}});
    case Quantity::drum_width:
        return key(length_range, true, "sd_m", {block, structure}, "width of each block; of an epistyle its length");
    case Quantity::drum_height:
        return key(length_range, true, "sd_m", {block, structure}, "height of each block");
    case Quantity::drum_offset:
        return key(structure_keys::offset_range, false, "sd_m", {block},
                   "displacement of each block from its nominal place; in space one along x and one along z");
    case Quantity::density:
        return key(density_range, true, "sd_kg_m3", {block, structure}, "density of each block at its size");
    case Quantity::tilt:
        return key(tilt_range, false, "sd_rad", {structure}, "tilt of the base; in space one about z and one about x");
    case Quantity::phase:
        return key(phase_range, false, "sd_rad", {structure}, "phase of a harmonic, tapered or pulse excitation",
                   {.used = {for_motions({Motion::harmonic, Motion::tapered, Motion::pulse})},
                    .example = "{ distribution = \"uniform\" }"});
    case Quantity::pulse_frequency:
        return key(frequency_range, true, "sd_hz", {structure}, "frequency of a velocity pulse",
                   {.used = {for_motions({Motion::pulse}), without_frequencies()},
                    .example = "{ distribution = \"lognormal\", sigma_ln = 0.4 }"});
    case Quantity::direction:
        return key(azimuth_range, false, "sd_deg", {structure}, "direction of the shaking in space, in degrees",
                   {.used = {not_for_motions({Motion::none}), without_directions()},
                    .example = "{ distribution = \"uniform\" }",
                    .models = in_space()});
    case Quantity::pulse_gamma:
    case Quantity::drum_offset_z: // drawn with their other direction
    case Quantity::tilt_x:
        break;
    }
    return key(
        gamma_range, true, "sd", {structure}, "oscillatory character of a velocity pulse",
        {.used = {for_motions({Motion::pulse})}, .example = "{ distribution = \"uniform\", from = 1.5, to = 3.0 }"});
}

std::unique_ptr<SpreadKey> make(const MechanismRule& rule, const MechanismParameter& parameter)
{
    const SpreadKey::Quality quality{range_of(parameter), std::string("sd") + parameter.suffix, parameter.low >= 0,
                                     rule.place == MechanismPlace::joint   ? std::vector{joint, structure}
                                     : rule.place == MechanismPlace::block ? std::vector{block, structure}
                                                                           : std::vector{structure}};
    KeyFacts facts{.absent = "not perturbed"};
    if (parameter.models != MechanismModels::both)
        facts.models = parameter.models == MechanismModels::planar ? in_plane() : in_space();
    return std::make_unique<SpreadKey>(parameter.key(), parameter.says, quality, std::move(facts));
}

} // namespace

SpreadKey::SpreadKey(std::string key, std::string means, const Quality& quality, KeyFacts facts)
    : TableKey(std::move(key), std::move(means), {}, std::move(facts)), relative(quality.relative), turn(quality.turn),
      value(quality.value),
      distribution("distribution", distributions(quality.relative), "the distribution", {.example = "\"normal\""}),
      sd(quality.deviation_key, {0, value.high, true, value.hint, value.slips},
         "standard deviation of a normal distribution",
         {.absent = quality.relative ? "`cov`" : "needed for a normal distribution",
          .example = "...",
          .models = quality.deviation_models}),
      cov("cov", cov_range, "the same as a fraction of the nominal value",
          {.absent = "`" + quality.deviation_key + "`"}),
      sigma_ln("sigma_ln", sigma_ln_range, "standard deviation of the logarithm of a lognormal distribution",
               {.absent = "needed for a lognormal distribution"}),
      from("from", quality.value, "lower end of a uniform or log_uniform distribution",
           {.absent =
                quality.turn > 0 ? "0, with `to` = " + turn_words(quality.turn) : "needed for a uniform distribution"}),
      to("to", quality.value, "upper end of a uniform or log_uniform distribution",
         {.absent = quality.turn > 0 ? turn_words(quality.turn) : "needed for a uniform distribution"}),
      min("min", quality.value, "truncates a normal or lognormal distribution", {.absent = "not truncated"}),
      max("max", quality.value, "truncates a normal or lognormal distribution", {.absent = "not truncated"}),
      per("per", quality.allowed.front().value, quality.allowed, "whether each has its own value, or all the same")
{
    keys = {&distribution, &sd};
    if (relative)
        keys.insert(keys.end(), {&cov, &sigma_ln});
    keys.insert(keys.end(), {&from, &to, &min, &max, &per});
}

std::vector<std::string> SpreadKey::names_of_all() const
{
    return {distribution.name, sd.name, cov.name, sigma_ln.name, from.name, to.name, min.name, max.name, per.name};
}

std::vector<std::string> SpreadKey::names_for(DistributionKind kind) const
{
    switch (kind) {
    case DistributionKind::normal:
        if (relative)
            return {distribution.name, sd.name, cov.name, min.name, max.name, per.name};
        return {distribution.name, sd.name, min.name, max.name, per.name};
    case DistributionKind::lognormal:
        return {distribution.name, sigma_ln.name, min.name, max.name, per.name};
    case DistributionKind::uniform:
    case DistributionKind::log_uniform:
        break;
    }
    return {distribution.name, from.name, to.name, per.name};
}

const SpreadKey& spread_key(Quantity quantity)
{
    static const auto all = [] {
        std::vector<std::unique_ptr<SpreadKey>> made;
        for (int i = 0; i < perturbable_count; ++i)
            made.push_back(make(static_cast<Quantity>(i)));
        return made;
    }();
    return *all[static_cast<std::size_t>(quantity)];
}

const TableKey& perturbed_parameters(Mechanism mechanism)
{
    static std::vector<std::unique_ptr<SpreadKey>> keys;
    static const std::vector<TableKey> tables = [] {
        std::vector<TableKey> made;
        for (const MechanismRule& rule : mechanism_rules()) {
            made.emplace_back(rule.name, std::string("parameters of ") + rule.name, std::vector<const TomlKey*>{},
                              KeyFacts{.absent = "not perturbed", .models = mechanism_key(rule.mechanism).models});
            for (const MechanismParameter& parameter : rule.parameters)
                made.back().keys.push_back(keys.emplace_back(make(rule, parameter)).get());
        }
        return made;
    }();
    return tables[static_cast<std::size_t>(mechanism)];
}

const SpreadKey& spread_key(Mechanism mechanism, std::size_t parameter)
{
    return static_cast<const SpreadKey&>(*perturbed_parameters(mechanism).keys[parameter]);
}

const TableKey& perturbed_mechanisms()
{
    static const TableKey table = [] {
        std::vector<const TomlKey*> keys;
        for (const MechanismRule& rule : mechanism_rules())
            keys.push_back(&perturbed_parameters(rule.mechanism));
        return TableKey("mechanisms", "perturbed parameters of the mechanisms that [mechanisms] names", std::move(keys),
                        {.absent = "not perturbed"});
    }();
    return table;
}

const TableKey& perturbation_table()
{
    static const TableKey table = [] {
        std::vector<const TomlKey*> keys;
        for (int i = 0; i < perturbable_count; ++i)
            keys.push_back(&spread_key(static_cast<Quantity>(i)));
        keys.push_back(&perturbed_mechanisms());
        return TableKey("perturbation", "what differs from one realization to the next", std::move(keys),
                        {.absent = "nothing is perturbed"});
    }();
    return table;
}

} // namespace stylobate
