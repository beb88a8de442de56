#include "io/study/study_perturbations.hpp"

#include "ensemble/model/nominal.hpp"
#include "io/study/study_mechanisms.hpp"
#include "io/study/study_names.hpp"
#include "io/study/study_ranges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stylobate {

namespace {

/// No double-precision uniform number maps to a normal one beyond this: without `min`, draws go down to here.
constexpr double farthest_sd = 9;
/// Less probability than this between `min` and `max` is a mistake, and its quantiles are not accurate.
constexpr double least_kept = 1e-6;

struct Rule {
    std::vector<double> nominal;       ///< the values that are perturbed, each once
    Range value;                       ///< what a value may be
    Range sd;                          ///< what a standard deviation may be
    bool relative = true;              ///< has a nominal value to scale: cov, lognormal, log_uniform make sense
    std::vector<Name<Per>> allowed;    ///< the first is the default
    std::string sd_key = {};           ///< of a standard deviation, with its unit
    bool turns = false;                ///< a phase: without ends a uniform one is a full turn
    bool one_for_all = false;          ///< one value is drawn in place of nominal ones that may differ
    const char* section = "[contact]"; ///< where nominal values are given
};

/// Each value once, in ascending order.
std::vector<double> distinct(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

/// All of a quantity's rule but the key of its deviation.
/// @param nominal the quantity's nominal values, each once, ascending
Rule values_for(Quantity quantity, const Study& study, std::vector<double> nominal)
{
    constexpr Name<Per> joint{"joint", Per::joint}, block{"block", Per::block}, structure{"structure", Per::structure};
    const auto below = [](Range range, double high) {
        range.low = 0;
        range.high = high;
        range.open = true;
        return range;
    };
    const double least = nominal.front();
    switch (quantity) {
    case Quantity::friction:
        return {std::move(nominal), friction_range, below(friction_range, least), true, {joint, structure}};
    case Quantity::normal_stiffness:
        return {
            std::move(nominal), normal_stiffness_range, below(normal_stiffness_range, least), true, {structure, joint}};
    case Quantity::tangential_stiffness:
        return {std::move(nominal),
                tangential_stiffness_range,
                below(tangential_stiffness_range, least),
                true,
                {structure, joint}};
    case Quantity::damping_ratio:
        return {{study.contact.normal_damping_ratio, study.contact.tangential_damping_ratio},
                damping_ratio_range,
                below(damping_ratio_range, damping_ratio_range.high),
                true,
                {structure}};
    case Quantity::drum_width:
    case Quantity::drum_height:
        return {std::move(nominal), length_range, below(length_range, least), true, {block, structure}};
    case Quantity::drum_offset: {
        double widest = 0;
        for (const ColumnSpec& column : study.structure.columns)
            for (const DrumSpec& drum : column.drums)
                widest = std::max(widest, drum.width_m);
        Range offset = length_range;
        offset.low = -widest;
        offset.high = widest;
        offset.open = false;
        return {std::move(nominal), offset, below(length_range, widest), false, {block}};
    }
    case Quantity::density:
        return {std::move(nominal), density_range, below(density_range, least), true, {block, structure}};
    case Quantity::tilt:
        return {std::move(nominal), tilt_range, below(tilt_range, tilt_range.high), false, {structure}};
    case Quantity::pulse_frequency:
        return {std::move(nominal), frequency_range, below(frequency_range, least), true, {structure}};
    case Quantity::pulse_gamma:
        return {std::move(nominal), gamma_range, below(gamma_range, least), true, {structure}};
    case Quantity::phase:
        break;
    }
    return {std::move(nominal), phase_range, below(phase_range, phase_range.high), false, {structure}};
}

Rule rule_for(Quantity quantity, const Study& study, const Layout& layout)
{
    Rule rule = values_for(quantity, study, distinct(nominal_values(study, layout, quantity)));
    rule.sd_key = sd_key(quantity);
    rule.turns = quantity == Quantity::phase;
    rule.one_for_all = quantity == Quantity::damping_ratio;
    return rule;
}

/// @pre the study names the mechanism
Rule rule_for(const MechanismRule& mechanism, std::size_t parameter, const Study& study)
{
    const MechanismParameter& p = mechanism.parameters[parameter];
    Rule rule;
    for (const MechanismSpec& spec : study.mechanisms)
        if (spec.mechanism == mechanism.mechanism)
            rule.nominal.push_back(spec.values[parameter]);
    rule.nominal = distinct(std::move(rule.nominal));
    rule.value = range_of(p);
    rule.sd = {0, p.high, true, rule.value.hint, 0};
    rule.relative = p.low >= 0;
    constexpr Name<Per> joint{"joint", Per::joint}, block{"block", Per::block}, structure{"structure", Per::structure};
    if (mechanism.place == MechanismPlace::joint)
        rule.allowed = {joint, structure};
    else if (mechanism.place == MechanismPlace::block)
        rule.allowed = {block, structure};
    else
        rule.allowed = {structure};
    rule.sd_key = std::string("sd") + p.suffix;
    rule.section = "[mechanisms]";
    return rule;
}

/// Probability of a standard normal number between a and b.
double normal_between(double a, double b)
{
    const auto upper = [](double z) { return 0.5 * std::erfc(z / std::numbers::sqrt2); };
    return a > 0 ? upper(a) - upper(b) : upper(-b) - upper(-a); // differences of small tails, not of ones
}

/// min and max: inside the physical range, in order, and with something left between them.
void read_ends(const KeyReader& keys, const Rule& rule, Spread& p)
{
    Range range = rule.value;
    range.guess = 0;
    p.min = keys.maybe_number("min", range);
    p.max = keys.maybe_number("max", range);
    if (p.min && p.max && !(*p.min < *p.max))
        keys.refuse("min", fmt::format("is not below max = {}", *p.max));
    if (!p.min && !p.max)
        return;
    for (const double nominal : rule.nominal) {
        const double sd = p.distribution == DistributionKind::lognormal ? p.sigma_ln
                          : p.cov > 0                                   ? p.cov * nominal
                                                                        : p.sd;
        const auto standard = [&](double value) {
            return (p.distribution == DistributionKind::lognormal ? std::log(value / nominal) : value - nominal) / sd;
        };
        const double low = p.min ? standard(*p.min) : -HUGE_VAL;
        const double high = p.max ? standard(*p.max) : HUGE_VAL;
        if (!(normal_between(low, high) >= least_kept))
            keys.refuse(p.min ? "min" : "max", "leaves less than one draw in a million",
                        fmt::format("The nominal value is {}: min and max must enclose it.", nominal));
    }
}

void read_normal(const KeyReader& keys, const Rule& rule, Spread& p)
{
    const std::string& sd = rule.sd_key;
    if (rule.relative && keys.has(sd) && keys.has("cov"))
        keys.refuse("cov", "and " + sd + " exclude each other", "Give one of the two.");
    if (rule.relative && keys.has("cov"))
        p.cov = keys.number("cov", cov_range);
    else if (keys.has(sd) || !rule.relative)
        p.sd = keys.number(sd, rule.sd);
    else
        keys.missing(sd, "Give it, or cov, the standard deviation as a fraction of the nominal value.");
    read_ends(keys, rule, p);

    if (!rule.relative)
        return; // may have either sign
    for (const double nominal : rule.nominal) {
        const double lowest = p.cov > 0 ? nominal * (1 - farthest_sd * p.cov) : nominal - farthest_sd * p.sd;
        if (!p.min && !rule.value.contains(lowest))
            keys.missing("min", fmt::format("The nominal value is {}, and draws can leave {}: truncate the "
                                            "distribution, for example min = {:.3g}.",
                                            nominal, rule.value.text(), nominal / 2));
    }
}

void read_uniform(const KeyReader& keys, const Rule& rule, Spread& p)
{
    if (rule.turns && !keys.has("from") && !keys.has("to")) {
        p.from = 0;
        p.to = 2 * std::numbers::pi;
        return;
    }
    Range range = rule.value;
    if (p.distribution == DistributionKind::log_uniform && range.low == 0)
        range.open = true;
    p.from = keys.number("from", range);
    p.to = keys.number("to", range);
    if (!(p.from < p.to))
        keys.refuse("from", fmt::format("is not below to = {}", p.to));
}

Spread read_spread(const KeyReader& keys, const Rule& rule)
{
    const std::string& sd = rule.sd_key;
    keys.allow_only({"distribution", sd, "cov", "sigma_ln", "from", "to", "min", "max", "per"});

    std::vector<Name<DistributionKind>> distributions;
    for (const auto& name : distribution_names)
        if (rule.relative || name.value == DistributionKind::normal || name.value == DistributionKind::uniform)
            distributions.push_back(name);

    Spread p;
    p.distribution = keys.choice("distribution", distributions);
    p.per = keys.choice_or("per", rule.allowed, rule.allowed.front().value);

    const auto why = fmt::format("distribution = \"{}\"", word_for(distribution_names, p.distribution));
    const bool about_nominal =
        p.distribution == DistributionKind::normal || p.distribution == DistributionKind::lognormal;
    const double least_nominal = *std::min_element(rule.nominal.begin(), rule.nominal.end());
    if (about_nominal && rule.relative && !(least_nominal > 0))
        keys.refuse("distribution", "needs a nominal value above 0",
                    fmt::format("Give the nominal value in {}, or use uniform or log_uniform.", rule.section));
    switch (p.distribution) {
    case DistributionKind::normal:
        if (rule.relative)
            keys.refuse_unused({"distribution", sd, "cov", "min", "max", "per"}, why);
        else
            keys.refuse_unused({"distribution", sd, "min", "max", "per"}, why);
        read_normal(keys, rule, p);
        break;
    case DistributionKind::lognormal:
        keys.refuse_unused({"distribution", "sigma_ln", "min", "max", "per"}, why);
        p.sigma_ln = keys.number("sigma_ln", sigma_ln_range);
        read_ends(keys, rule, p);
        break;
    case DistributionKind::uniform:
    case DistributionKind::log_uniform:
        keys.refuse_unused({"distribution", "from", "to", "per"}, why);
        // densities from masses and sizes differ in their last digits
        if (!rule.one_for_all && rule.nominal.back() - rule.nominal.front() > 1e-9 * rule.nominal.back())
            keys.refuse("distribution",
                        fmt::format("replaces nominal values that differ, from {} to {}", rule.nominal.front(),
                                    rule.nominal.back()),
                        "Use normal or lognormal, which are centred on each nominal value.");
        read_uniform(keys, rule, p);
        break;
    }
    return p;
}

/// Refuses what the excitation has not.
void check_used(const KeyReader& section, Quantity quantity, const Study& study)
{
    const ExcitationKind kind = study.excitation.kind;
    const bool pulse = kind == ExcitationKind::pulse;
    const bool phase = pulse || kind == ExcitationKind::harmonic || kind == ExcitationKind::tapered;
    const auto unused = fmt::format("is not used by excitation.kind = \"{}\"", word_for(excitation_kind_names, kind));
    if (quantity == Quantity::phase && !phase)
        section.refuse(to_string(quantity), unused,
                       "Remove it: only a harmonic, a tapered and a pulse excitation have a phase.");
    if ((quantity == Quantity::pulse_frequency || quantity == Quantity::pulse_gamma) && !pulse)
        section.refuse(to_string(quantity), unused, "Remove it, or give excitation.kind = \"pulse\".");
    if (quantity == Quantity::pulse_frequency && study.surface)
        section.refuse(to_string(quantity), "is not used by study.kind = \"surface\"",
                       "Remove it: the frequency comes from the axis of [surface].");
}

/// [perturbation.mechanisms]: NAME.PARAMETER = { distribution, per, ... }
void read_of_mechanisms(const KeyReader& section, Study& study)
{
    std::vector<std::string> known;
    for (const MechanismRule& rule : mechanism_rules())
        known.emplace_back(rule.name);
    section.allow_only(known);
    for (const MechanismRule& rule : mechanism_rules()) {
        if (!section.has(rule.name))
            continue;
        if (!study.names(rule.mechanism))
            section.refuse(rule.name, "is not used: [mechanisms] does not name it",
                           fmt::format("Give its nominal values there: {} = {{ ... }}.", rule.name));
        const KeyReader keys = section.table(rule.name);
        if (rule.mechanism == Mechanism::vertical_motion && study.vertical)
            section.refuse(rule.name, "is not used by a vertical motion with a file", "Remove it.");
        known.clear();
        for (const MechanismParameter& parameter : rule.parameters)
            known.push_back(parameter.key());
        keys.allow_only(known);
        for (std::size_t i = 0; i < rule.parameters.size(); ++i) {
            if (!keys.has(known[i]))
                continue;
            MechanismPerturbation perturbation{read_spread(keys.table(known[i]), rule_for(rule, i, study)),
                                               rule.mechanism, i};
            study.mechanism_perturbations.push_back(perturbation);
        }
    }
}

} // namespace

void read_perturbations(const KeyReader& section, Study& study)
{
    std::vector<std::string> known;
    for (int i = 0; i < quantity_count; ++i)
        known.emplace_back(to_string(static_cast<Quantity>(i)));
    known.emplace_back("mechanisms");
    section.allow_only(known);

    const Layout layout = lay_out(study.structure);
    for (int i = 0; i < quantity_count; ++i) {
        const auto quantity = static_cast<Quantity>(i);
        if (!section.has(to_string(quantity)))
            continue;
        const KeyReader keys = section.table(to_string(quantity));
        check_used(section, quantity, study);
        if (quantity == Quantity::damping_ratio &&
            (study.contact.normal_damping_n_s_m || study.contact.tangential_damping_n_s_m))
            section.refuse("damping_ratio", "is not used where [contact] gives a damping coefficient",
                           "Give contact.normal_damping_ratio and contact.tangential_damping_ratio instead.");
        study.perturbations.push_back({read_spread(keys, rule_for(quantity, study, layout)), quantity});
    }
    read_of_mechanisms(section.table("mechanisms"), study);
}

} // namespace stylobate
