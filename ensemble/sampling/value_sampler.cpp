#include "ensemble/sampling/value_sampler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace stylobate {
namespace {

/// In the order of `Quantity`.
constexpr std::array streams = {Stream::friction,      Stream::normal_stiffness, Stream::tangential_stiffness,
                                Stream::damping_ratio, Stream::drum_width,       Stream::drum_height,
                                Stream::drum_offset,   Stream::density,          Stream::tilt,
                                Stream::phase,         Stream::pulse_frequency,  Stream::pulse_gamma,
                                Stream::direction,     Stream::drum_offset_z,    Stream::tilt_x};
static_assert(streams.size() == quantity_count);

/// Quantities of which a value below 0 means nothing.
bool is_positive(Quantity quantity)
{
    return quantity != Quantity::drum_offset && quantity != Quantity::tilt && quantity != Quantity::phase &&
           quantity != Quantity::direction && quantity != Quantity::drum_offset_z && quantity != Quantity::tilt_x;
}

/// In space: the quantity of the other direction, which is drawn from the same distribution.
std::optional<Quantity> across(Quantity quantity)
{
    return quantity == Quantity::drum_offset ? std::optional(Quantity::drum_offset_z)
           : quantity == Quantity::tilt      ? std::optional(Quantity::tilt_x)
                                             : std::nullopt;
}

/// The name of its values in results. In space the stiffness of a bed is per area, in another unit.
std::string input_name_of(Quantity quantity, bool spatial)
{
    const bool of_area =
        spatial && (quantity == Quantity::normal_stiffness || quantity == Quantity::tangential_stiffness);
    return (of_area ? "bed_" : "") + std::string(to_string(quantity));
}

/// Quantities of which each bed has its own.
bool is_of_beds(Quantity quantity)
{
    return quantity == Quantity::friction || quantity == Quantity::normal_stiffness ||
           quantity == Quantity::tangential_stiffness;
}

} // namespace

Stream stream_of(Mechanism mechanism, std::size_t parameter)
{
    constexpr std::uint64_t room = 8; // for the parameters of one mechanism
    return static_cast<Stream>(static_cast<std::uint64_t>(Stream::mechanisms) +
                               room * static_cast<std::uint64_t>(mechanism) + parameter);
}

ValueSampler::ValueSampler(const Study& study, const RealizationValues& nominal,
                           const std::vector<ActingMechanism>& mechanisms)
    : nominal_(nominal), spatial_(study.structure.spatial())
{
    if (const double twin_m = study.design().twin_m; twin_m > 0) {
        Spread spread;
        spread.sd = twin_m;
        twin_.emplace(spread, "fragility.twin_m", 0.0);
    }
    for (const Perturbation& perturbation : study.perturbations) {
        const int factor = study.design().factor(to_string(perturbation.quantity));
        add(perturbation, factor);
        if (const auto other = study.structure.spatial() ? across(perturbation.quantity) : std::nullopt) {
            Perturbation along_other = perturbation;
            along_other.quantity = *other;
            add(along_other, factor);
        }
    }
    for (const MechanismPerturbation& perturbation : study.mechanism_perturbations)
        add(study, perturbation, mechanisms);

    std::vector<PointSet::Place> places;
    for (const Drawn& drawn : drawn_)
        for (std::size_t i = 0; i < drawn.draws(); ++i)
            places.push_back({drawn.stream, drawn.element(i), drawn.factor});
    // what is drawn once is the structure's as a whole, and so matters most
    std::map<Stream, int> draws;
    for (const PointSet::Place& place : places)
        ++draws[place.stream];
    std::stable_partition(places.begin(), places.end(),
                          [&](const PointSet::Place& place) { return draws[place.stream] == 1; });
    points_ = PointSet(study, places);
}

/// @param factor of a sensitivity study; -1: none
void ValueSampler::add(Perturbation perturbation, int factor)
{
    const Quantity quantity = perturbation.quantity;
    const bool once = perturbation.per == Per::structure;
    std::vector<double> about = nominal_[quantity];
    if (is_of_beds(quantity) && !once)
        about.pop_back(); // what meets elsewhere keeps its nominal value
    if (is_positive(quantity))
        perturbation.min = std::max(perturbation.min.value_or(0), quantity == Quantity::pulse_gamma ? 1.0 : 0.0);
    Drawn drawn{RealizationValues::slot(quantity), streams[static_cast<std::size_t>(quantity)], once,
                once ? 1 : about.size(), factor};
    for (std::size_t i = 0; i < about.size(); ++i) {
        drawn.places.push_back(i);
        drawn.distributions.emplace_back(perturbation, about[i]);
    }
    name(input_name_of(quantity, spatial_), once ? std::nullopt : std::optional(about.size()));
    drawn_.push_back(std::move(drawn));
}

void ValueSampler::add(const Study& study, MechanismPerturbation perturbation,
                       const std::vector<ActingMechanism>& mechanisms)
{
    const MechanismRule& rule = rule_of(perturbation.mechanism);
    const MechanismParameter& parameter = rule.parameters[perturbation.parameter];
    const auto acting =
        std::find_if(mechanisms.begin(), mechanisms.end(), [&](const ActingMechanism& a) { return a.rule == &rule; });
    if (parameter.low >= 0) // a value below means nothing
        perturbation.min = std::max(perturbation.min.value_or(parameter.low), parameter.low);

    const std::string input = input_name(rule.mechanism, parameter);
    const std::string key = fmt::format("perturbation.mechanisms.{}.{}", rule.name, parameter.key());
    Drawn drawn{RealizationValues::slot(static_cast<std::size_t>(acting - mechanisms.begin()), perturbation.parameter),
                stream_of(rule.mechanism, perturbation.parameter), perturbation.per == Per::structure, 1,
                study.design().factor(input)};
    const std::vector<double>& values = nominal_.all[drawn.slot];
    for (std::size_t place = 0; place < values.size(); ++place) {
        if (!acting->at[place])
            continue;
        drawn.places.push_back(place);
        drawn.distributions.emplace_back(perturbation, key, values[place]);
    }
    if (drawn.draws() != 1)
        drawn.inputs = values.size();
    name(input, drawn.draws() == 1 ? std::nullopt : std::optional(values.size()));
    drawn_.push_back(std::move(drawn));
}

/// @param numbered how many numbered inputs of this name there are; none: one without a number
void ValueSampler::name(const std::string& quantity, std::optional<std::size_t> numbered)
{
    if (!numbered)
        input_names_.push_back(quantity);
    for (std::size_t i = 0; i < numbered.value_or(0); ++i)
        input_names_.push_back(fmt::format("{}[{}]", quantity, i));
}

void ValueSampler::draw(const Drawn& drawn, const PointSet& points, std::uint64_t index, RealizationValues& values)
{
    for (std::size_t i = 0; i < drawn.places.size(); ++i)
        values.all[drawn.slot][drawn.places[i]] =
            drawn.distributions[i].value(points.uniform(index, drawn.stream, drawn.element(i)));
}

RealizationValues ValueSampler::rough_values(const PointSet& points, std::uint64_t index) const
{
    constexpr std::array quantities = {Quantity::normal_stiffness, Quantity::tangential_stiffness,
                                       Quantity::damping_ratio, Quantity::pulse_frequency, Quantity::pulse_gamma};
    RealizationValues values = nominal_;
    for (const Drawn& drawn : drawn_)
        if (std::any_of(quantities.begin(), quantities.end(),
                        [&](Quantity quantity) { return drawn.slot == RealizationValues::slot(quantity); }))
            draw(drawn, points, index, values);
    return values;
}

RealizationValues ValueSampler::values(const PointSet& points, std::uint64_t index, std::vector<double>& inputs) const
{
    RealizationValues values = nominal_;
    for (const Drawn& drawn : drawn_) {
        draw(drawn, points, index, values);
        const std::vector<double>& target = values.all[drawn.slot];
        if (drawn.inputs == 1)
            inputs.push_back(target[drawn.places.front()]);
        else
            inputs.insert(inputs.end(), target.begin(), target.begin() + static_cast<std::ptrdiff_t>(drawn.inputs));
    }
    if (twin_)
        for (std::size_t i = 0; i < values[Quantity::drum_offset].size(); ++i)
            values.twin_m.push_back(twin_->value(points.uniform(index, Stream::twin, i)));
    return values;
}

} // namespace stylobate
