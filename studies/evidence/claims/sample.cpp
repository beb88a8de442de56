#include "studies/evidence/claims/sample.hpp"

#include "ensemble/motion/base_motion.hpp"
#include "ensemble/motion/synthetic_motion.hpp"
#include "ensemble/statics/scales.hpp"
#include "ensemble/statics/step_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate::claims {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// The path of the base is summed over so many pieces of each period: the error is (pi / pieces)2 / 6 of it.
constexpr int pieces_per_cycle = 200;

/// When a motion first reaches half its PGA.
double half_peak_s(const ExcitationSpec& e, const Realization& r, const Motion* record)
{
    if (SyntheticMotion::covers(e.kind) && !r.motion) {
        const SyntheticMotion motion(e, r);
        const double dt = 1 / (motion.fastest_hz() * pieces_per_cycle);
        double t = 0;
        while (t < motion.duration_s() && std::fabs(motion.acceleration_m_s2(t)) < r.pga_m_s2 / 2)
            t += dt;
        return t;
    }
    const Motion& motion = r.motion ? *r.motion : *record;
    const auto& a = motion.acceleration_m_s2;
    const auto first = std::find_if(a.begin(), a.end(), [&](double v) { return std::fabs(v) >= motion.pga_m_s2 / 2; });
    // what each realization has of its own is in its own time
    const bool stretched = e.kind == ExcitationKind::record || e.kind == ExcitationKind::table;
    const double stretch = stretched ? record->predominant_frequency_hz / r.frequency_hz : 1;
    return static_cast<double>(first - a.begin()) * motion.dt_s * stretch;
}

double strong_start_s(const ExcitationSpec& e, const Realization& r, const Motion* record)
{
    switch (e.kind) {
    case ExcitationKind::harmonic:
        return e.start == HarmonicEdge::smooth ? e.ramp_cycles / r.frequency_hz : 0;
    case ExcitationKind::none:
    case ExcitationKind::half_sine:
    case ExcitationKind::full_sine:
        return 0;
    default:
        return half_peak_s(e, r, record);
    }
}

double base_path_m(const ExcitationSpec& e, const Realization& r, const Motion* record, double until_s)
{
    const BaseMotion motion(e, r, record);
    const double end = std::min(until_s, motion.duration_s());
    const auto pieces = static_cast<long>(std::ceil(end * r.frequency_hz * pieces_per_cycle));
    double path = 0, before = motion.displacement_m(0);
    for (long i = 1; i <= pieces; ++i) {
        const double now = motion.displacement_m(end * static_cast<double>(i) / static_cast<double>(pieces));
        path += std::fabs(now - before);
        before = now;
    }
    return path;
}

/// Without what is drawn.
Realization nominal_realization(const Study& study, const Motion* record)
{
    Study plain = study;
    plain.perturbations.clear();
    plain.mechanism_perturbations.clear();
    plain.vertical.reset(); // nothing that is asked of it moves
    return Sampler(plain, record).realization(0);
}

/// Rigid column on its lowest face: g (foot's width) / (twice the height of its centre of mass). NaN for a colonnade,
/// whose limit is no formula.
double rigid_limit(const Study& study, const Realization& r)
{
    if (study.structure.kind != StructureKind::column)
        return nan;
    double mass = 0, moment = 0;
    double bottom = std::numeric_limits<double>::infinity(), width = 0;
    for (const Block& block : r.blocks) {
        if (block.fixed)
            continue;
        mass += block.mass_kg;
        moment += block.mass_kg * block.y_m;
        if (block.y_m - block.half_height_m < bottom) {
            bottom = block.y_m - block.half_height_m;
            width = 2 * block.half_width_m;
        }
    }
    return r.gravity_m_s2 * width / (2 * (moment / mass - bottom));
}

} // namespace

bool Observation::has(Event event, double within_cycles) const
{
    switch (event) {
    case Event::rocked:
        return rocked;
    case Event::slid:
        return slid;
    case Event::collapsed:
        return collapsed;
    case Event::stood:
        return !rocked && !slid && !collapsed;
    case Event::rocked_only:
        return rocked && !slid;
    case Event::slid_only:
        return slid && !rocked;
    case Event::rocked_and_slid:
        return rocked && slid;
    case Event::rocked_or_slid:
        return rocked || slid;
    case Event::collapsed_early:
        return collapsed && cycles_to_collapse <= within_cycles;
    case Event::upright:
        return !collapsed;
    case Event::unseated:
        break;
    }
    return unseated;
}

Observation observe(const Study& study, const Realization& realization, const Motion* record, const Outcome& o,
                    bool path_needed)
{
    Observation seen;
    seen.index = realization.index;
    seen.collapsed = o.state == State::collapsed;
    seen.rocked = seen.collapsed || o.max_relative_rotation_rad > study.outcome.rocking_threshold_rad;
    seen.slid = o.total_sliding_m > study.outcome.sliding_threshold * scales_of(realization).width_m;
    seen.unseated = o.unseating_time_s >= 0;
    seen.cycles_to_collapse =
        seen.collapsed
            ? (o.collapse_time_s - strong_start_s(study.excitation, realization, record)) * realization.frequency_hz
            : nan;

    const double base = path_needed ? base_path_m(study.excitation, realization, record, o.end_time_s) : nan;
    const double dissipated = o.energy_friction_j + o.energy_damping_j;
    const auto set = [&](Amount amount, double value) { seen.amount[static_cast<std::size_t>(amount)] = value; };
    set(Amount::total_sliding_m, o.total_sliding_m);
    set(Amount::residual_sliding_m, o.residual_sliding_m);
    set(Amount::total_rocking_rad, o.total_rocking_rad);
    set(Amount::rocking_path_rad, o.rocking_path_rad);
    set(Amount::peak_top_m, o.peak_top_displacement_m);
    set(Amount::top_path_ratio, base > 0 ? o.top_path_m / base : nan);
    const auto columns = static_cast<double>(study.structure.columns.size());
    set(Amount::face_path_ratio, base > 0 ? o.sliding_path_m / (base * columns) : nan);
    set(Amount::friction_share, dissipated > 0 ? o.energy_friction_j / dissipated : nan);
    set(Amount::collapse_cycles, seen.collapsed ? o.collapse_time_s * realization.frequency_hz : nan);
    return seen;
}

Sample make_sample(const Study& study, const Sampler& sampler, const Motion* record, const std::vector<ResultRow>& rows,
                   bool path_needed)
{
    Sample sample;
    const Realization nominal = nominal_realization(study, record);
    sample.f1_hz = study.contact.form == ContactForm::rigid
                       ? std::numeric_limits<double>::infinity()
                       : first_mode_of_paper(nominal).frequency_hz;
    sample.rigid_m_s2 = rigid_limit(study, nominal);
    if (study.surface) {
        for (int i = 0; i < study.surface->frequency_hz.count; ++i)
            sample.frequency_hz.push_back(study.surface->frequency_hz.value(i));
        for (int i = 0; i < study.surface->pga_m_s2.count; ++i)
            sample.pga_m_s2.push_back(study.surface->pga_m_s2.value(i));
    } else {
        sample.frequency_hz = {nominal.frequency_hz};
        sample.pga_m_s2 = {nominal.pga_m_s2};
    }
    sample.cells.resize(sample.frequency_hz.size() * sample.pga_m_s2.size());
    for (const ResultRow& row : rows) {
        if (row.outcome.state == State::invalid)
            ++sample.invalid;
        else
            sample.cells.at(row.cell).push_back(
                observe(study, sampler.realization(row.index), record, row.outcome, path_needed));
    }
    for (std::vector<Observation>& cell : sample.cells)
        std::sort(cell.begin(), cell.end(),
                  [](const Observation& a, const Observation& b) { return a.index < b.index; });
    return sample;
}

} // namespace stylobate::claims
