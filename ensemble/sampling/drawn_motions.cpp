#include "ensemble/sampling/drawn_motions.hpp"

#include "ensemble/model/nominal.hpp"
#include "ensemble/motion/motions_in_space.hpp"
#include "ensemble/motion/synthetic_motion.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/sampling/sampler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace stylobate {

namespace {

/// Shakings of sequence `first`, in order.
std::vector<std::size_t> shakings_of(const Study& study, std::size_t first)
{
    const MotionSetSpec& f = *study.design().motions;
    const auto count = static_cast<std::size_t>(f.shakings), motions = static_cast<std::size_t>(f.motions);
    std::vector<std::size_t> order = {first};
    if (f.records.empty()) { // those beyond the first `motions` follow
        for (std::size_t k = 1; k < count; ++k)
            order.push_back(motions + first * (count - 1) + k - 1);
        return order;
    }
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < motions; ++i)
        if (i != first)
            others.push_back(i);
    for (std::size_t k = 1; k < count; ++k) {
        const double u = uniform01(study.seed, first, Stream::sequence, k);
        const auto at = static_cast<std::size_t>(u * static_cast<double>(others.size()));
        order.push_back(others[at]);
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(at));
    }
    return order;
}

} // namespace

Succession in_succession(std::span<const ScaledMotion> shakings, double pause_s)
{
    double dt = shakings.front().timing().dt_s;
    for (const ScaledMotion& shaking : shakings)
        dt = std::min(dt, shaking.timing().dt_s);
    std::vector<double> acceleration, ends;
    for (const ScaledMotion& shaking : shakings) {
        const Motion* motion = shaking.motion;
        const double scale = shaking.scale;
        if (!acceleration.empty())
            acceleration.resize(acceleration.size() + static_cast<std::size_t>(std::ceil(pause_s / dt)));
        const auto samples = static_cast<std::size_t>(std::ceil(shaking.timing().duration_s() / dt)) + 1;
        if (motion == nullptr)
            acceleration.resize(acceleration.size() + samples);
        for (std::size_t k = 0; motion != nullptr && k < samples; ++k) {
            const double at = static_cast<double>(k) * dt / motion->dt_s;
            const auto before = std::min(static_cast<std::size_t>(at), motion->acceleration_m_s2.size() - 1);
            const auto after = std::min(before + 1, motion->acceleration_m_s2.size() - 1);
            const double part = std::min(at - static_cast<double>(before), 1.0);
            acceleration.push_back(
                scale * std::lerp(motion->acceleration_m_s2[before], motion->acceleration_m_s2[after], part));
        }
        ends.push_back(static_cast<double>(acceleration.size() - 1) * dt);
    }
    return {motion_of(std::move(acceleration), dt), std::move(ends)};
}

MotionSet in_sequence(const Study& study, const MotionSet& set)
{
    const MotionSetSpec& f = *study.design().motions;
    const auto motions = static_cast<std::size_t>(f.motions);
    MotionSet sequences;
    for (std::size_t i = 0; i < motions; ++i) {
        const std::vector<std::size_t> order = shakings_of(study, i);
        std::vector<ScaledMotion> shakings, seconds, verticals;
        std::string name;
        for (const std::size_t shaking : order) {
            double scale = 1;
            if (f.method == FragilityMethod::stripes) {
                const MotionMeasure& measure = set.measure(measure_name(f.measure, f.period_s));
                scale = std::pow(measure.value[i] / measure.value[shaking], 1 / measure.exponent);
            }
            shakings.push_back({set.motions[shaking].get(), scale});
            seconds.push_back({set.second(shaking).get(), scale, shakings.back().motion});
            verticals.push_back({set.vertical(shaking).get(), scale, shakings.back().motion});
            name += (name.empty() ? "" : " + ") + set.names[shaking];
        }
        Succession succession = in_succession(shakings, shaking_pause_s(study));
        Motion& sequence = succession.motion;
        sequence.predominant_frequency_hz = set.motions[i]->predominant_frequency_hz;
        sequence.pga_m_s2 = set.motions[i]->pga_m_s2; // by which it is scaled: that of its first shaking
        sequence.source = name;
        sequences.motions.push_back(std::make_shared<const Motion>(std::move(sequence)));
        const auto other = [&](const std::vector<ScaledMotion>& components) {
            return std::make_shared<const Motion>(in_succession(components, shaking_pause_s(study)).motion);
        };
        if (!set.seconds.empty())
            sequences.seconds.push_back(other(seconds));
        if (!set.verticals.empty())
            sequences.verticals.push_back(other(verticals));
        sequences.names.push_back(name);
        sequences.ends_s.push_back(std::move(succession.ends_s));
    }
    for (const MotionMeasure& measure : set.measures)
        sequences.measures.push_back(
            {measure.name, measure.exponent, {measure.value.begin(), measure.value.begin() + f.motions}});
    return sequences;
}

MotionSet drawn_motions(const Study& study)
{
    const MotionSetSpec* spec = study.design().motions;
    if (spec == nullptr || !spec->records.empty())
        throw std::invalid_argument("only a fragility study without records draws motions");
    Study one = study.as_single(static_cast<std::uint64_t>(spec->motions * spec->shakings));
    std::erase_if(one.perturbations, [](const Perturbation& p) {
        return p.quantity != Quantity::phase && p.quantity != Quantity::pulse_frequency &&
               p.quantity != Quantity::pulse_gamma;
    });
    one.mechanism_perturbations.clear();
    const Sampler sampler(one, nullptr);
    MotionSet set;
    for (std::uint64_t i = 0; i < one.realizations; ++i) {
        const Realization r = sampler.realization(i);
        Motion motion = r.motion ? *r.motion : sampled(SyntheticMotion(one.excitation, r));
        motion.predominant_frequency_hz = r.frequency_hz;
        motion.source = fmt::format("motion {}", i);
        set.names.push_back(motion.source);
        if (r.second)
            set.seconds.push_back(r.second);
        else if (one.excitation.has_second())
            set.seconds.push_back(std::make_shared<const Motion>(
                sampled(SyntheticMotion(one.excitation, second_component(one.excitation, first_component(r))))));
        if (r.vertical)
            set.verticals.push_back(r.vertical);
        set.motions.push_back(std::make_shared<const Motion>(std::move(motion)));
    }
    return set;
}

} // namespace stylobate
