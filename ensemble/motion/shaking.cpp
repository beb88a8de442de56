#include "ensemble/motion/shaking.hpp"

#include "ensemble/motion/base_motion.hpp"
#include "ensemble/motion/motions_in_space.hpp"
#include "ensemble/motion/noise_in_space.hpp"
#include "ensemble/motion/synthetic_motion.hpp"
#include "ensemble/motion/synthetic_noise.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

namespace stylobate {

namespace {

bool is_sampled(ExcitationKind kind)
{
    return kind == ExcitationKind::record || kind == ExcitationKind::table;
}

BaseChange distortion_of(const MechanismSpec& spec)
{
    BaseChange change;
    const auto& parameters = rule_of(spec.mechanism).parameters; // fewer than there is room for values
    for (std::size_t i = 0; i < parameters.size(); ++i)
        change.*std::get<double BaseChange::*>(parameters[i].member) = spec.values[i];
    return change;
}

std::shared_ptr<const Motion> with_overtones(const Motion& motion, const BaseChange& change)
{
    return std::make_shared<const Motion>(Distortion(motion).distorted(motion, change));
}

/// PGA of the first component of a motion in closed form over that of the pair.
double share_of_first(const ExcitationSpec& excitation, const RealizationHeader& realization)
{
    const bool closed = excitation.kind != ExcitationKind::noise && !is_sampled(excitation.kind);
    return closed && excitation.second_ratio > 0 ? 1 / pga_of_pair_over_first(excitation, realization) : 1;
}

/// A motion in another time and of another size.
Motion scaled(Motion motion, double stretch, double scale)
{
    motion.dt_s *= stretch;
    motion.predominant_frequency_hz /= stretch;
    motion.pga_m_s2 *= scale;
    for (double& a : motion.acceleration_m_s2)
        a *= scale;
    for (double& v : motion.velocity_m_s)
        v *= scale * stretch;
    for (double& u : motion.displacement_m)
        u *= scale * stretch * stretch;
    return motion;
}

} // namespace

Shaking::Shaking(const Study& study, const Motion* record, const Motion* vertical,
                 std::shared_ptr<const MotionSet> motions, const Motion* second)
    : motions_(std::move(motions))
{
    const ExcitationSpec& excitation = study.excitation;
    if (const MotionSetSpec* set = study.design().motions) {
        if (!motions_ || motions_->size() != static_cast<std::size_t>(set->motions))
            throw std::invalid_argument("a fragility study was not given its motions");
        return;
    }
    if (is_sampled(excitation.kind)) {
        if (record == nullptr || record->empty())
            throw std::invalid_argument("a study with a record was given no base motion");
        predominant_hz_ = record->predominant_frequency_hz;
        record_s_ = record->duration_s();
        record_frequency_hz_ = record->predominant_frequency_hz / excitation.time_scale;
        record_pga_m_s2_ = record->pga_m_s2;
        if (excitation.second) {
            if (second == nullptr || second->empty())
                throw std::invalid_argument("a study with two components was given no second one");
            second_ = std::make_shared<const Motion>(*second);
            record_pga_m_s2_ = size_of_pair(excitation.pga_of_pair, record->pga_m_s2, second->pga_m_s2,
                                            peak_at_once(record->acceleration_m_s2, second->acceleration_m_s2));
            first_share_ = record->pga_m_s2 / record_pga_m_s2_;
        }
        if (study.names(Mechanism::harmonic_distortion)) {
            record_ = *record;
            distortion_ = Distortion(record_);
            const bool drawn = std::any_of(
                study.mechanism_perturbations.begin(), study.mechanism_perturbations.end(),
                [](const MechanismPerturbation& p) { return p.mechanism == Mechanism::harmonic_distortion; });
            if (!drawn) {
                BaseChange change;
                for (const MechanismSpec& spec : study.mechanisms)
                    if (spec.mechanism == Mechanism::harmonic_distortion)
                        change = distortion_of(spec);
                distorted_ = std::make_shared<const Motion>(distortion_.distorted(record_, change));
            }
        }
    }
    if (is_sampled(excitation.kind) && study.events() > 1)
        record_ = *record;
    if (study.vertical) {
        if (vertical == nullptr || vertical->empty())
            throw std::invalid_argument("a study with a vertical record was given none");
        vertical_ = std::make_shared<const Motion>(*vertical);
    }
    if (excitation.kind == ExcitationKind::noise && excitation.pga_of == PgaOf::mean) {
        const Axis* axis = study.design().frequency_hz;
        for (int i = 0; i < (axis ? axis->count : 1); ++i) {
            const double frequency = axis ? axis->value(i) : excitation.frequency_hz;
            mean_peak_.push_back(mean_peak(SyntheticNoise(excitation, frequency), excitation, study.seed));
        }
    }
}

std::size_t Shaking::set_cell(const Study& study, const StudyDesign& design, const DrawnShaking& drawn,
                              RealizationHeader& realization) const
{
    realization.phase_rad = drawn.phase_rad;
    realization.pulse_gamma = drawn.pulse_gamma;
    realization.direction_rad = drawn.direction_rad;
    const std::uint64_t cell = design.cell(realization.index);
    const auto row = static_cast<std::size_t>(cell / design.columns);
    if (design.motions != nullptr)
        return row;
    set_nominal(study.excitation, drawn, realization);
    if (design.frequency_hz)
        realization.frequency_hz = design.frequency_hz->value(static_cast<int>(row));
    if (design.direction_deg)
        realization.direction_rad = design.direction_deg->value(static_cast<int>(row)) * (std::numbers::pi / 180);
    if (design.pga_m_s2)
        realization.pga_m_s2 = design.pga_m_s2->value(static_cast<int>(cell % design.columns));
    return row;
}

double Shaking::duration_s(const Study& study, const DrawnShaking& drawn, const Scales& scales,
                           RealizationHeader& realization) const
{
    const ExcitationSpec& excitation = study.excitation;
    const StudyDesign design = study.design();
    const std::size_t row = set_cell(study, design, drawn, realization);
    if (design.motions != nullptr) {
        realization.frequency_hz = motions_->motions[row]->predominant_frequency_hz;
        const auto vertical = motions_->vertical(row);
        return std::max(motions_->motions[row]->duration_s(), vertical ? vertical->duration_s() : 0);
    }
    const double stretch = predominant_hz_ > 0 ? predominant_hz_ / realization.frequency_hz : 1;
    double one_s = 0;
    if (is_sampled(excitation.kind))
        one_s = record_s_ * stretch;
    else if (excitation.kind == ExcitationKind::noise)
        one_s = excitation.rise_s + excitation.strong_s + noise_decays * excitation.decay_s;
    else if (SyntheticMotion::covers(excitation.kind))
        one_s = SyntheticMotion::duration_s(excitation, realization);
    else
        one_s = BaseMotion(excitation, realization, nullptr).duration_s();
    if (vertical_)
        one_s = std::max(one_s, vertical_->duration_s() * stretch);
    const int events = design.events_of(realization.index);
    return events * one_s + (events - 1) * design.event_pause_s.value_or(pause_until_rest(scales));
}

void Shaking::apply(const Study& study, const DrawnShaking& drawn, const Scales& scales,
                    RealizationHeader& realization) const
{
    const ExcitationSpec& excitation = study.excitation;
    const StudyDesign design = study.design();
    const std::size_t row = set_cell(study, design, drawn, realization);
    if (design.motions != nullptr)
        return apply_motion(design, realization);
    if (excitation.kind == ExcitationKind::noise)
        shake_by_noise(study, design.motion_index(realization.index), design.frequency_hz ? row : 0, realization);
    else if (second_)
        realization.second = second_;
    realization.first_share = second_ ? first_share_ : share_of_first(excitation, realization);
    if (realization.change.distorts()) {
        if (excitation.has_second())
            distort_second(excitation, realization);
        distort(excitation, realization);
    }
    if (vertical_)
        move_vertically(realization);
    if (const int events = design.events_of(realization.index); events > 1)
        repeat(study, events, row, scales, realization);
}

void Shaking::shake_by_noise(const Study& study, std::uint64_t motion, std::size_t row,
                             RealizationHeader& realization) const
{
    const ExcitationSpec& excitation = study.excitation;
    const SyntheticNoise noise(excitation, realization.frequency_hz);
    HorizontalNoise pair =
        horizontal_noise(noise, excitation, study.seed, motion, Stream::base_noise, Stream::second_noise);
    const double scale =
        realization.pga_m_s2 / (excitation.pga_of == PgaOf::mean ? mean_peak_[row] : pair.peak(excitation.pga_of_pair));
    const auto motion_from = [&](std::vector<double> acceleration, double factor) {
        return std::make_shared<const Motion>(noise.motion_from(std::move(acceleration), factor));
    };
    realization.motion = motion_from(std::move(pair.first), scale);
    if (!pair.second.empty())
        realization.second = motion_from(std::move(pair.second), scale);
    if (excitation.vertical_ratio > 0)
        realization.vertical = motion_from(noise.acceleration(study.seed, motion, Stream::vertical_noise),
                                           scale * excitation.vertical_ratio);
}

void Shaking::repeat(const Study& study, int events, std::size_t row, const Scales& scales,
                     RealizationHeader& realization) const
{
    const ExcitationSpec& excitation = study.excitation;
    std::vector<Motion> motions;
    const StudyDesign design = study.design();
    double pause_s = design.event_pause_s.value_or(pause_until_rest(scales));
    if (excitation.kind == ExcitationKind::noise) {
        const SyntheticNoise noise(excitation, realization.frequency_hz);
        for (int k = 0; k < events; ++k) { // the first one is the realization's own
            const std::uint64_t index =
                design.motion_index(realization.index) + static_cast<std::uint64_t>(k) * design.total();
            motions.push_back(excitation.pga_of == PgaOf::mean
                                  ? noise.motion(study.seed, index, realization.pga_m_s2 / mean_peak_[row])
                                  : noise.motion_of_peak(study.seed, index, realization.pga_m_s2));
        }
    } else {
        Motion one;
        if (is_sampled(excitation.kind)) {
            one = record_;
            pause_s *= realization.frequency_hz / predominant_hz_; // its time is stretched
        } else if (SyntheticMotion::covers(excitation.kind)) {
            one = sampled(SyntheticMotion(excitation, realization));
        } else {
            one = sampled(BaseMotion(excitation, realization, nullptr), realization.frequency_hz);
        }
        motions.assign(static_cast<std::size_t>(events), one);
    }
    realization.motion = std::make_shared<const Motion>(repeated_motion(motions, pause_s));
}

void Shaking::apply_motion(const StudyDesign& design, RealizationHeader& realization) const
{
    const std::uint64_t cell = design.cell(realization.index);
    const auto motion = static_cast<std::size_t>(cell / design.columns);
    realization.motion = motions_->motions[motion];
    realization.motion_scale =
        motion_scale(*design.motions, *motions_, motion, static_cast<int>(cell % design.columns));
    realization.frequency_hz = realization.motion->predominant_frequency_hz;
    realization.second = motions_->second(motion);
    realization.pga_m_s2 = realization.motion_scale *
                           (realization.second ? motions_->measure(measure_name(IntensityMeasure::pga, 0)).value[motion]
                                               : realization.motion->pga_m_s2);
    if (const auto vertical = motions_->vertical(motion))
        realization.vertical = std::make_shared<const Motion>(scaled(*vertical, 1, realization.motion_scale));
}

/// Of a harmonic motion the formula does it (`BaseMotion`).
void Shaking::distort(const ExcitationSpec& excitation, RealizationHeader& realization) const
{
    if (is_sampled(excitation.kind)) {
        realization.motion = distorted_
                                 ? distorted_
                                 : std::make_shared<const Motion>(distortion_.distorted(record_, realization.change));
    } else if (excitation.kind == ExcitationKind::noise || SyntheticMotion::covers(excitation.kind)) {
        const Motion plain = excitation.kind == ExcitationKind::noise
                                 ? *realization.motion
                                 : sampled(SyntheticMotion(excitation, first_component(realization)));
        realization.motion = with_overtones(plain, realization.change);
    }
}

/// As the first component, which is not distorted yet.
void Shaking::distort_second(const ExcitationSpec& excitation, RealizationHeader& realization) const
{
    if (realization.second)
        realization.second = with_overtones(*realization.second, realization.change);
    else if (SyntheticMotion::covers(excitation.kind))
        realization.second = with_overtones(
            sampled(SyntheticMotion(excitation, second_component(excitation, first_component(realization)))),
            realization.change);
}

/// A vertical record is stretched and scaled as the horizontal one is: they are components of one shaking.
void Shaking::move_vertically(RealizationHeader& realization) const
{
    const bool alone = predominant_hz_ == 0;
    const double stretch = alone ? 1 : predominant_hz_ / realization.frequency_hz;
    const double scale = alone ? 1 : realization.pga_m_s2 / record_pga_m_s2_;
    realization.vertical =
        stretch == 1 && scale == 1 ? vertical_ : std::make_shared<const Motion>(scaled(*vertical_, stretch, scale));
}

/// Frequency and PGA where no axis gives them.
void Shaking::set_nominal(const ExcitationSpec& excitation, const DrawnShaking& drawn,
                          RealizationHeader& realization) const
{
    if (excitation.kind != ExcitationKind::none)
        realization.pga_m_s2 = excitation.pga_m_s2;
    switch (excitation.kind) {
    case ExcitationKind::none:
        break;
    case ExcitationKind::harmonic:
    case ExcitationKind::half_sine:
    case ExcitationKind::full_sine:
    case ExcitationKind::ricker:
    case ExcitationKind::tapered:
    case ExcitationKind::noise:
        realization.frequency_hz = excitation.frequency_hz;
        break;
    case ExcitationKind::pulse:
        realization.frequency_hz = drawn.pulse_frequency_hz;
        break;
    case ExcitationKind::sweep:
        realization.frequency_hz = excitation.central_frequency_hz();
        break;
    case ExcitationKind::record:
    case ExcitationKind::table:
        realization.frequency_hz = record_frequency_hz_;
        if (!(excitation.pga_m_s2 > 0))
            realization.pga_m_s2 = record_pga_m_s2_;
        break;
    }
}

Motion repeated_motion(std::span<const Motion> events, double pause_s)
{
    assert(!events.empty() && "a past without an event has no motion");
    const Motion& first = events.front();
    const auto pause = static_cast<std::size_t>(std::ceil(pause_s / first.dt_s));
    std::vector<double> acceleration;
    for (const Motion& event : events) {
        assert(event.dt_s == first.dt_s && "events have one spacing of samples");
        if (!acceleration.empty())
            acceleration.resize(acceleration.size() + pause);
        acceleration.insert(acceleration.end(), event.acceleration_m_s2.begin(), event.acceleration_m_s2.end());
    }
    Motion motion = motion_of(std::move(acceleration), first.dt_s);
    motion.pga_m_s2 = first.pga_m_s2; // by which it is scaled
    motion.predominant_frequency_hz = first.predominant_frequency_hz;
    motion.source = first.source;
    return motion;
}

} // namespace stylobate
