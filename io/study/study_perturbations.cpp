#include "ensemble/model/nominal.hpp"
#include "io/keys/spread_key.hpp"
#include "io/keys/words.hpp"
#include "io/study/study_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

/// No double-precision uniform number maps to a normal one beyond this: without `min`, draws go down to here.
constexpr double farthest_sd = 9;
/// Less probability than this between `min` and `max` is a mistake, and its quantiles are not accurate.
constexpr double least_kept = 1e-6;

/// What the study states of a quantity, beside its keys.
struct Rule {
    const SpreadKey* key;
    std::vector<double> nominal;       ///< the values that are perturbed, each once
    Range value;                       ///< what a value may be
    Range sd;                          ///< what a standard deviation may be
    bool by_cov = false;               ///< a normal distribution is given by `cov` alone
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

Rule rule_for(Quantity quantity, const Study& study, const Layout& layout)
{
    const SpreadKey& key = spread_key(quantity);
    Rule rule{&key, distinct(nominal_values(study, layout, quantity)), key.value, key.sd.range};
    if (quantity == Quantity::drum_width || quantity == Quantity::drum_height || quantity == Quantity::density)
        rule.section = "[structure]";
    else if (quantity == Quantity::pulse_frequency || quantity == Quantity::pulse_gamma)
        rule.section = "[excitation]";
    rule.by_cov = !key.sd.used_where(model_key, dimensions_word(study.structure));
    if (quantity == Quantity::damping_ratio) {
        rule.nominal = {study.contact.normal_damping_ratio, study.contact.tangential_damping_ratio};
        rule.one_for_all = true;
    } else if (quantity == Quantity::drum_offset) {
        double widest = 0;
        for (const ColumnSpec& column : study.structure.columns)
            for (const DrumSpec& drum : column.drums)
                widest = std::max(widest, drum.width_m);
        rule.value.low = -widest;
        rule.value.high = rule.sd.high = widest;
    } else if (key.relative) {
        rule.sd.high = rule.nominal.front(); // no more than the least
    }
    return rule;
}

/// @pre the study names the mechanism
Rule rule_for(const MechanismRule& mechanism, std::size_t parameter, const Study& study)
{
    const SpreadKey& key = spread_key(mechanism.mechanism, parameter);
    Rule rule{&key, {}, key.value, key.sd.range};
    for (const MechanismSpec& spec : study.mechanisms)
        if (spec.mechanism == mechanism.mechanism)
            rule.nominal.push_back(spec.values[parameter]);
    rule.nominal = distinct(std::move(rule.nominal));
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
    range.slips = {};
    p.min = keys.maybe_number(rule.key->min.name, range);
    p.max = keys.maybe_number(rule.key->max.name, range);
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
        if (!(normal_between(low, high) >= least_kept)) // the end that cuts off more is the wrong one
            keys.refuse(
                p.min && -low < high ? "min" : "max", "leaves less than one draw in a million",
                fmt::format("The nominal value in {} is {}: min and max must enclose it.", rule.section, nominal));
    }
}

void read_normal(const KeyReader& keys, const Rule& rule, Spread& p)
{
    const SpreadKey& key = *rule.key;
    if (key.relative && keys.has(key.sd) && keys.has(key.cov))
        keys.refuse(key.cov.name, "and " + key.sd.name + " exclude each other", "Give one of the two.");
    if (key.relative && keys.has(key.cov))
        p.cov = keys.read(key.cov);
    else if (keys.has(key.sd) || !key.relative)
        p.sd = keys.read_within(key.sd, rule.sd);
    else
        keys.missing(rule.by_cov ? key.cov.name : key.sd.name,
                     rule.by_cov ? "Give the standard deviation as a fraction of the nominal value."
                                 : "Give it, or cov, the standard deviation as a fraction of the nominal value.");
    read_ends(keys, rule, p);

    if (!key.relative)
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
    if (rule.key->turn > 0 && !keys.has(rule.key->from) && !keys.has(rule.key->to)) {
        p.from = 0;
        p.to = rule.key->turn;
        return;
    }
    Range range = rule.value;
    if (p.distribution == DistributionKind::log_uniform && range.low == 0)
        range.open = true;
    p.from = keys.read_within(rule.key->from, range);
    p.to = keys.read_within(rule.key->to, range);
    if (!(p.from < p.to))
        keys.refuse("from", fmt::format("is not below to = {}", p.to));
}

Spread read_spread(const KeyReader& keys, const Rule& rule)
{
    const SpreadKey& key = *rule.key;
    keys.allow_only(key.names_of_all());
    Spread p;
    p.distribution = keys.read(key.distribution);
    p.per = keys.read(key.per);

    const auto why = fmt::format("distribution = \"{}\"", word_for(distribution_names, p.distribution));
    const bool about_nominal =
        p.distribution == DistributionKind::normal || p.distribution == DistributionKind::lognormal;
    const double least_nominal = *std::min_element(rule.nominal.begin(), rule.nominal.end());
    if (about_nominal && key.relative && !(least_nominal > 0))
        keys.refuse("distribution", "needs a nominal value above 0",
                    fmt::format("Give the nominal value in {}, or use uniform or log_uniform.", rule.section));
    keys.refuse_unused(key.names_for(p.distribution), why);
    switch (p.distribution) {
    case DistributionKind::normal:
        read_normal(keys, rule, p);
        break;
    case DistributionKind::lognormal:
        p.sigma_ln = keys.read(key.sigma_ln);
        read_ends(keys, rule, p);
        break;
    case DistributionKind::uniform:
    case DistributionKind::log_uniform:
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

/// Refuses what the excitation and the contacts have not.
void check_used(const KeyReader& section, Quantity quantity, const Study& study)
{
    const TomlKey& key = spread_key(quantity);
    const char* motion = word_for(excitation_kind_names, study.excitation.kind);
    if (!key.used_where("excitation.kind", motion))
        section.refuse(key.name, fmt::format("is not used by excitation.kind = \"{}\"", motion),
                       quantity == Quantity::phase
                           ? "Remove it: only a harmonic, a tapered and a pulse excitation have a phase."
                           : "Remove it, or give excitation.kind = \"pulse\".");
    const char* form = word_for(contact_form_names, study.contact.form);
    if (!key.used_where("contact.form", form))
        section.refuse(key.name, fmt::format("is not used by contact.form = \"{}\"", form),
                       "Remove it: rigid contacts have no stiffness and no dashpot.");
    for (const auto& [axis, word] : key_use(study).kinds)
        if (word == key_given && !key.used_where(axis, word))
            section.refuse(key.name, "is not used by a study with " + axis,
                           "Remove it: the axis gives it, the same in all realizations of a row.");
}

/// [perturbation.mechanisms]: NAME.PARAMETER = { distribution, per, ... }
void read_of_mechanisms(const KeyReader& section, Study& study)
{
    for (const MechanismRule& rule : mechanism_rules()) {
        if (!section.has(rule.name))
            continue;
        if (!study.names(rule.mechanism))
            section.refuse(rule.name, "is not used: [mechanisms] does not name it",
                           fmt::format("Give its nominal values there: {} = {{ ... }}.", rule.name));
        if (rule.mechanism == Mechanism::vertical_motion && study.vertical)
            section.refuse(rule.name, "is not used by a vertical motion with a file", "Remove it.");
        const KeyReader keys = section.table(perturbed_parameters(rule.mechanism));
        for (std::size_t i = 0; i < rule.parameters.size(); ++i) {
            const SpreadKey& key = spread_key(rule.mechanism, i);
            if (!keys.has(key))
                continue;
            MechanismPerturbation perturbation{read_spread(keys.table(key.name), rule_for(rule, i, study)),
                                               rule.mechanism, i};
            study.mechanism_perturbations.push_back(perturbation);
        }
    }
}

} // namespace

void read_perturbations(const KeyReader& section, Study& study)
{
    const Layout layout = lay_out(study.structure);
    for (int i = 0; i < perturbable_count; ++i) {
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
    read_of_mechanisms(section.table(perturbed_mechanisms()), study);
}

} // namespace stylobate
