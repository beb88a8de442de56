#include "studies/check/weak_spots.hpp"

#include "ensemble/model/nominal.hpp"
#include "ensemble/motion/synthetic_sine.hpp"
#include "ensemble/numerics/interval.hpp"
#include "ensemble/planar/structure/nominal_statics.hpp"
#include "ensemble/planar/structure/scales.hpp"
#include "ensemble/planar/structure/step_bound.hpp"
#include "io/files/suggest.hpp"
#include "io/study/study_parts.hpp"
#include "studies/check/study_trial.hpp"
#include "studies/experiment/motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace stylobate {

namespace {

struct Subject {
    const LoadedStudy& loaded;
    const std::vector<Implausibility>& implausibilities;
    const Trial* trial;
    const FreeMotion* free;
    std::optional<StaticLimit> limit; ///< of the nominal structure
    const Study& study() const { return loaded.study(); }
    StudyDesign design() const { return study().design(); }
    /// The set of motions, where they are files; else null.
    const MotionSet* recorded() const
    {
        const MotionSetSpec* set = design().motions;
        return set && !set->records.empty() ? loaded.experiment().motions().drawn.get() : nullptr;
    }
    bool implausible_by(std::string_view check) const
    {
        return std::any_of(implausibilities.begin(), implausibilities.end(),
                           [&](const Implausibility& one) { return one.check == check; });
    }
    /// A few realizations, spread over the study.
    std::vector<Realization> sample(std::uint64_t count) const
    {
        TrialOrder order(study(), 0, design().drawn_alone(study().originals()));
        std::vector<Realization> all;
        for (const std::uint64_t index : order.next(count))
            all.push_back(loaded.sampler().realization(index));
        return all;
    }
};
using Found = std::optional<WeakSpot>;

WeakSpot spot(std::string text, std::string todo)
{
    return {"", std::move(text), std::move(todo)};
}

/// By how much the shaking may exceed its nominal PGA, which is that of the plateau: in the ramps of a displacement.
double overshoot(const ExcitationSpec& e)
{
    const bool ramps =
        e.kind == ExcitationKind::sweep ||
        (e.kind == ExcitationKind::harmonic && (e.start == HarmonicEdge::smooth || e.end == HarmonicEdge::smooth));
    return ramps ? ramp_overshoot(e.ramp_cycles) : 1;
}

/// The strongest of the shaking [m/s2], with its overshoots.
double strongest_m_s2(const Subject& s)
{
    double pga = 0;
    if (const Axis* axis = s.design().pga_m_s2)
        pga = std::max(axis->from, axis->to);
    else
        for (const Realization& r : s.sample(64))
            pga = std::max(pga, r.pga_m_s2);
    return pga * (s.design().motions ? 1 : overshoot(s.study().excitation)); // scaled by the peak of its samples
}

/// Below the limit of statics no rigid block moves, whatever the history of the shaking. (A rare event is one of the
/// drawn structures, not of the nominal one.)
Found below_limit(const Subject& s)
{
    const Study& study = s.study();
    if (study.excitation.kind == ExcitationKind::none || study.initial.tilt_rad != 0 || !study.mechanisms.empty() ||
        study.vertical || s.design().chained())
        return std::nullopt;
    const std::optional<StaticLimit>& limit = s.limit;
    const double pga = strongest_m_s2(s);
    if (s.implausible_by("weak_shaking")) // that the number may be in g
        return std::nullopt;
    if (!limit || pga >= limit->limit_m_s2)
        return std::nullopt;
    return spot(fmt::format("The strongest shaking has {:.4g} m/s2. Rigid blocks of this structure begin to move at "
                            "{:.4g} m/s2 (static limit; g B / H for a column that rocks): what moves below is the "
                            "compliance of the beds.",
                            pga, limit->limit_m_s2),
                fmt::format("Extend the shaking beyond {:.3g} m/s2, about twice the limit.", 2 * limit->limit_m_s2));
}

Found slides_first(const Subject& s)
{
    const std::optional<StaticLimit>& limit = s.limit;
    if (!limit || !s.study().mechanisms.empty() || limit->limit_m_s2 > 0.98 * limit->rocking_m_s2)
        return std::nullopt;
    // Epistyles that meet over a column slide on it as it rocks, whatever the friction: that is no limit by sliding,
    // which rises with the friction.
    if (limit->rough_m_s2 < 0.98 * std::min(1.1 * limit->limit_m_s2, limit->rocking_m_s2))
        return std::nullopt;
    return spot(fmt::format("Blocks slide at {:.4g} m/s2, before they can rock at {:.4g} m/s2 (friction below B / H; "
                            "Shenton, Journal of Engineering Mechanics 122 (1996) 690): sliding limits the "
                            "acceleration that reaches the blocks above.",
                            limit->limit_m_s2, limit->rocking_m_s2),
                "Check contact.friction; if it is right, look at the limit state `slid` beside the collapse.");
}

Found one_outcome(const Subject& s)
{
    constexpr std::uint64_t enough = 60; // the rule of three: then a share of 0.05 would have been seen
    if (!s.trial || s.design().traced || s.design().chained())
        return std::nullopt;
    const auto [valid, fell] = shares_of(s.trial->parts.front());
    if (valid < enough || (fell > 0 && fell < valid))
        return std::nullopt;
    const double limit = 3 / static_cast<double>(valid);
    if (fell == 0)
        return spot(fmt::format("None of the {} realizations of the trial fell: less than {:.2g} of the study falls "
                                "(95 %).",
                                valid, limit),
                    "Extend the range to stronger shaking or lower frequencies; for probabilities below 0.01 use "
                    "study.kind = \"rare\".");
    return spot(fmt::format("All {} realizations of the trial fell: less than {:.2g} of the study stands (95 %), and "
                            "the shaking from which it falls is not in the range.",
                            valid, limit),
                "Extend the range to weaker shaking.");
}

Found soft_contacts(const Subject& s)
{
    const Study& study = s.study();
    if (study.contact.form == ContactForm::rigid || study.structure.spatial() ||
        study.chose("contact.normal_stiffness_n_m2") || study.names(Mechanism::hertz) || s.implausible_by("sinkage") ||
        s.implausible_by("first_frequency") || s.implausible_by("stiffness"))
        return std::nullopt;
    const std::string todo = "For stiff joints give contact.form = \"rigid\" or a larger normal_stiffness_n_m2, or "
                             "leave it out and give run.accuracy. For joints that do yield so, perturb it "
                             "(perturbation.normal_stiffness).";
    if (study.contact.form == ContactForm::area) {
        constexpr double much = 0.2;
        const double lost = capacity_lost(study);
        if (lost <= much)
            return std::nullopt;
        return spot(fmt::format("On beds of normal_stiffness_n_m2 = {:.3g} a rigid column holds {:.0f} % less "
                                "acceleration than on rigid beds (closed form, docs/verification.md): the results "
                                "are those of this stiffness, not of stiff joints.",
                                study.contact.normal_stiffness_n_m2, 100 * lost),
                    todo);
    }
    const bool drawn = std::any_of(study.perturbations.begin(), study.perturbations.end(),
                                   [](const Perturbation& p) { return p.quantity == Quantity::normal_stiffness; });
    const double part = largest_sinkage_part(study);
    if (study.contact.form != ContactForm::two_corner || drawn || part <= two_corner_sinkage * 1.01)
        return std::nullopt;
    return spot(fmt::format("The weight presses a block into its bed by {:.2g} of its size. Contacts at two corners "
                            "are known to be within 0.1 of the limit of stiff ones (in collapse probability) from "
                            "{:g} on (docs/work_precision.md).",
                            part, two_corner_sinkage),
                fmt::format("Give a stiffness {:.2g} times as large, or leave it out and give run.accuracy.",
                            part / two_corner_sinkage));
}

Found wide_interval(const Subject& s)
{
    const Study& study = s.study();
    constexpr double wide = 0.2, wanted = 0.1;
    const std::optional<std::uint64_t> n = counted_trials(s.loaded);
    if (!n || worst_half_width(*n) <= wide)
        return std::nullopt;
    const char* more = !s.design().motions ? "study.realizations = "
                       : s.recorded()      ? "different ground motions: "
                                           : "fragility.motions = ";
    return spot(width_text(study, *n) + ".",
                fmt::format("For ±{} give {}{:.0f}; the width falls with the square root of the number.", wanted, more,
                            std::ceil(0.25 * std::pow(1.96 / wanted, 2))));
}

Found same_realizations(const Subject& s)
{
    const Study& study = s.study();
    if (study.realizations < 2 || !s.loaded.sampler().input_names().empty() ||
        study.excitation.kind == ExcitationKind::noise)
        return std::nullopt;
    return spot(fmt::format("Nothing is drawn: the {} realizations{} are one and the same, and their share is 0 or 1. "
                            "The response of such structures is chaotic, so that one realization says little.",
                            study.realizations, study.surface ? " of a cell" : ""),
                "Give [perturbation] what is uncertain: friction, sizes, offsets, tilt; or study.realizations = 1.");
}

Found coarse_axis(const Subject& s)
{
    const Study& study = s.study();
    if (!s.trial || !study.surface || study.surface->adaptive)
        return std::nullopt;
    std::vector<std::uint64_t> valid(study.cells()), fell(study.cells());
    for (const TrialRealization& r : s.trial->parts.front().run) {
        valid[r.cell] += r.state != State::invalid;
        fell[r.cell] += r.state == State::collapsed;
    }
    const Axis& axis = study.surface->pga_m_s2;
    const Jumps jumps = jumps_of(valid, fell, static_cast<std::size_t>(axis.count));
    if (jumps.rows < 2 || 4 * jumps.jumping <= 3 * jumps.rows)
        return std::nullopt;
    return spot(
        fmt::format("In {} of {} {} the probability of collapse rises from nearly 0 to nearly 1 "
                    "between two neighbouring PGAs: the curve between them is not seen, and the PGA of 1/2 is "
                    "known to a step of the axis only.",
                    jumps.jumping, jumps.rows, study.surface->row_quantity().plural),
        fmt::format("Give surface.pga_m_s2.count = {} or a shorter range, or surface.adaptive.", 2 * axis.count - 1));
}

/// Motions that are files, and not the same in all of a study.
std::vector<const Motion*> motions_of(const Subject& s)
{
    std::vector<const Motion*> all;
    if (s.loaded.record())
        all.push_back(s.loaded.record());
    else if (s.recorded())
        for (const auto& motion : s.recorded()->motions)
            all.push_back(motion.get());
    return all;
}

Found record_step(const Subject& s)
{
    constexpr double fewest = 8; // samples in a period: then sinc^2(1/8) = 0.95 of the amplitude is left
    for (const Motion* motion : motions_of(s)) {
        const double samples = 1 / (motion->predominant_frequency_hz * motion->dt_s);
        if (samples >= fewest)
            continue;
        const double x = std::numbers::pi / samples, left = std::pow(std::sin(x) / x, 2);
        return spot(fmt::format("{} has {:.2g} samples in a period of its predominant frequency ({:.3g} Hz, steps of "
                                "{:.3g} s). Between samples the acceleration is linear, which leaves {:.2g} of that "
                                "frequency's amplitude (sinc^2).",
                                motion->source, samples, motion->predominant_frequency_hz, motion->dt_s, left),
                    "Use the record with its original time step, or one that is band-limited below it.");
    }
    return std::nullopt;
}

Found record_end(const Subject& s)
{
    constexpr double end = 0.02, strong = 0.3; // parts of the duration, of the PGA
    if (s.study().excitation.kind != ExcitationKind::record)
        return std::nullopt;
    for (const Motion* motion : motions_of(s)) {
        const std::vector<double>& a = motion->acceleration_m_s2;
        const auto last =
            std::min(a.size(), std::max<std::size_t>(3, static_cast<std::size_t>(end * static_cast<double>(a.size()))));
        double most = 0;
        for (std::size_t i = a.size() - last; i < a.size(); ++i)
            most = std::max(most, std::fabs(a[i]));
        if (most < strong * motion->pga_m_s2)
            continue;
        return spot(fmt::format("{} still has {:.2g} of its PGA in its last {:.2g} s: it seems to be cut off in the "
                                "strong shaking, and the base stops at once.",
                                motion->source, most / motion->pga_m_s2, static_cast<double>(last) * motion->dt_s),
                    "Use the whole record.");
    }
    return std::nullopt;
}

/// With the usual time after the shaking no realization of the ready studies fell later (docs/check.md); a shorter one
/// is looked at.
Found cut_off(const Subject& s)
{
    constexpr double many = 0.01;
    const std::optional<double> tail = s.study().excitation.tail_s;
    const double usual = nominal_tail_s(s.study().structure);
    if (!s.trial || !tail || *tail >= usual)
        return std::nullopt;
    const std::uint64_t valid = s.trial->shares().valid;
    std::uint64_t cut = 0;
    for (const TrialPart& part : s.trial->parts)
        for (const TrialRealization& r : part.run)
            cut += r.cut_off;
    if (static_cast<double>(cut) <= many * static_cast<double>(valid))
        return std::nullopt;
    return spot(
        fmt::format("{} of {} realizations of the trial still moved when their time was over "
                    "(excitation.tail_s = {:g}), with more energy than it takes to topple a part of them: they "
                    "may still fall.",
                    cut, valid, *tail),
        fmt::format("Leave out excitation.tail_s; the usual time after the shaking is {:.3g} s (12 / p).", usual));
}

Found long_step(const Subject& s)
{
    const Study& study = s.study();
    constexpr double most = 0.95;
    double ratio = 0;
    const bool rigid = study.contact.form == ContactForm::rigid;
    if (!study.run.step_s && (rigid || study.run.step_fraction <= most))
        return std::nullopt;
    for (const Realization& r : s.sample(16)) {
        StepBound bound;
        if (!rigid && study.run.step_bound == StepBasis::structure)
            bound = structure_step_bound(r, step_bound(r));
        else if (!rigid)
            bound = study.outcome.follow == Follow::rest ? step_bound_to_rest(r) : step_bound(r);
        ratio = std::max(ratio, r.step_s / (rigid ? rigid_step_s(r) : bound.dt_s));
    }
    if (rigid)
        return ratio <= 1 ? Found()
                          : spot(fmt::format("run.step_s is {:.2g} times the step that changes collapse probabilities "
                                             "by up to {:g} (docs/rigid_limit.md); the error grows with the step.",
                                             ratio, usual_accuracy),
                                 "Leave out run.step_s, or give run.accuracy.");
    if (ratio <= most)
        return std::nullopt;
    return spot(fmt::format("The step is {:.2g} of the bound of stability, {:.2g} of the shortest period of the "
                            "contacts. At the bound itself the collapse probability of the softest bed measured "
                            "changed by -0.048 ± 0.012 (docs/work_precision.md).",
                            ratio, ratio / std::numbers::pi),
                "Leave out run.step_s and run.step_fraction (0.9), or give run.accuracy.");
}

/// Motions that may be vertical components, and a vertical motion that is made from the horizontal one.
Found unknown_direction(const Subject& s)
{
    std::vector<std::string> unknown;
    if (const MotionSet* set = s.recorded())
        for (std::size_t i = 0; i < set->size(); ++i)
            if (!set->motions[i]->is_vertical)
                unknown.push_back(set->names[i]);
    if (const auto& vertical = s.loaded.experiment().motions().vertical; vertical && !vertical->is_vertical)
        unknown.push_back(vertical->source);
    if (unknown.empty())
        return std::nullopt;
    constexpr std::size_t most = 6;
    std::string names;
    for (std::size_t i = 0; i < std::min(unknown.size(), most); ++i)
        names += (i == 0 ? "" : ", ") + unknown[i];
    if (unknown.size() > most)
        names += fmt::format(" and {} more", unknown.size() - most);
    return spot(
        fmt::format("The direction of {} motion{} is unknown, because {} file{} not state it: {}.", unknown.size(),
                    unknown.size() == 1 ? "" : "s", unknown.size() == 1 ? "its" : "their",
                    unknown.size() == 1 ? " does" : "s do", names),
        "Check that horizontal motions are horizontal components and that a vertical motion is a vertical one.");
}

Found no_vertical_record(const Subject& s)
{
    const Study& study = s.study();
    const bool recorded = study.excitation.kind == ExcitationKind::record;
    if (!recorded || !study.names(Mechanism::vertical_motion) || study.vertical)
        return std::nullopt;
    return spot("The vertical motion is the horizontal one times mechanisms.vertical_motion.ratio: no vertical "
                "component of a record is used. Real vertical components have higher frequencies and other phases.",
                s.design().motions
                    ? "Compare with a study without vertical motion: a fragility study takes no vertical "
                      "records."
                    : "Give mechanisms.vertical_motion.file.");
}

/// A structure that hardly loses energy while it rocks or sways.
Found hardly_damped(const Subject& s)
{
    constexpr double little = 0.5, calm = 0.005; // of the loss of rigid contacts; of critical
    if (s.free == nullptr || !s.free->mode)
        return std::nullopt;
    const FirstMode& mode = *s.free->mode;
    const std::optional<RockingDecay>& decay = s.free->decay;
    const double rigid = decay ? decay->rigid.value_or(decay->housner) : 0;
    const bool rocks_on = decay && decay->lost(decay->law) < little * decay->lost(rigid);
    const bool sways_on = mode.frequency_hz > 0 && mode.damping_ratio < calm;
    if (!rocks_on && !sways_on)
        return std::nullopt;
    std::string text;
    if (rocks_on)
        text = fmt::format("{} The first impact takes {:.0f} % of the energy, and {:.0f} % on rigid contacts.",
                           decay_text(*decay), 100 * decay->lost(decay->law), 100 * decay->lost(rigid));
    if (sways_on)
        text += fmt::format("{}The first mode ({:.3g} Hz) has a damping ratio of {:.2g} %, and the structure hardly "
                            "comes to rest.",
                            text.empty() ? "" : " ", mode.frequency_hz, 100 * mode.damping_ratio);
    if (s.study().structure.spatial()) // with one contact law
        return spot(text, "Give a contact.normal_damping_ratio of up to 0.5.");
    const bool centroid =
        s.study().contact.form == ContactForm::area && s.study().contact.damping == DampingAt::centroid;
    return spot(text, fmt::format("Give {}a normal_damping_ratio of up to 0.5, or contact.form = \"rigid\".",
                                  centroid ? "contact.damping = \"ends\" and " : ""));
}

Found still_moving(const Subject& s)
{
    constexpr double many = 0.01;
    if (!s.trial || !(s.design().traced || s.design().residuals))
        return std::nullopt;
    std::uint64_t standing = 0, moving = 0;
    for (const TrialPart& part : s.trial->parts)
        for (const TrialRealization& r : part.run) {
            const bool stands = r.state != State::collapsed && r.state != State::invalid;
            standing += stands;
            moving += stands && !r.at_rest;
        }
    if (static_cast<double>(moving) <= many * static_cast<double>(standing))
        return std::nullopt;
    const bool free = s.study().excitation.kind == ExcitationKind::none;
    return spot(
        fmt::format("{} of {} of the trial without collapse still moved at the end. Their residual "
                    "displacements are not known.",
                    moving, counted(standing, "realization")),
        fmt::format("Give {}, or more damping ({}).",
                    free                                           ? "a longer excitation.duration_s"
                    : s.study().excitation.tail == Tail::structure ? "excitation.tail_s = \"rest\""
                                                                   : "a longer excitation.tail_s",
                    s.study().structure.spatial() ? "contact.normal_damping_ratio" : "contact.damping = \"ends\""));
}

struct Look {
    const char* name;
    Found (*find)(const Subject&);
};
constexpr std::array looks = {Look{"below_limit", below_limit},
                              Look{"slides_first", slides_first},
                              Look{"one_outcome", one_outcome},
                              Look{"coarse_axis", coarse_axis},
                              Look{"wide_interval", wide_interval},
                              Look{"same_realizations", same_realizations},
                              Look{"soft_contacts", soft_contacts},
                              Look{"long_step", long_step},
                              Look{"record_step", record_step},
                              Look{"unknown_direction", unknown_direction},
                              Look{"no_vertical_record", no_vertical_record},
                              Look{"record_end", record_end},
                              Look{"cut_off", cut_off},
                              Look{"hardly_damped", hardly_damped},
                              Look{"still_moving", still_moving}};

/// Whether a trial says something of the study: those that have ended of an unfinished one are the short ones.
bool is_fair(const Trial* trial)
{
    return trial != nullptr && !trial->parts.empty() && !trial->unfinished;
}

} // namespace

std::vector<WeakSpot> weak_spots(const LoadedStudy& loaded, const std::vector<Implausibility>& implausibilities,
                                 const Trial* trial, const FreeMotion* free)
{
    const Subject subject{loaded, implausibilities, is_fair(trial) ? trial : nullptr, free,
                          loaded.study().structure.spatial() ? std::nullopt : static_limit(loaded.study())};
    std::vector<WeakSpot> all;
    for (const Look& look : looks)
        if (Found found = look.find(subject)) {
            found->name = look.name;
            all.push_back(std::move(*found));
        }
    return all;
}

std::vector<std::string> not_looked_for(const LoadedStudy& loaded, const Trial* trial, const FreeMotion& free)
{
    std::vector<std::string> all;
    const Study& study = loaded.study();
    if (!is_fair(trial))
        all.push_back(fmt::format("one_outcome, coarse_axis, cut_off, still_moving: {}.",
                                  trial ? "not all of the first realizations ended in the trial" : "no trial was run"));
    const std::vector<PlacedBlock> blocks = lay_out(study.structure).blocks;
    if (const std::ptrdiff_t free_blocks = std::ranges::count(blocks, false, &PlacedBlock::fixed);
        free_blocks > most_static_limit_blocks)
        all.push_back(
            fmt::format("weak_shaking, slides_first: the static limit is computed for at most {} free blocks, "
                        "and this structure has {}.",
                        most_static_limit_blocks, free_blocks));
    if (study.contact.form != ContactForm::rigid && !free.decay)
        all.push_back("hardly_damped: the free rocking of the first column was not computed (it falls, or it takes too "
                      "many steps); the damping of the first mode was.");
    return all;
}

std::string decay_text(const RockingDecay& decay)
{
    return fmt::format("Released from 0.5 of its slenderness angle ({:.3g} rad), the first column leans back to {:.3g} "
                       "of it after the first impact{}; Housner's rigid monolith to {:.4g}.",
                       decay.slenderness_rad, decay.law,
                       decay.rigid ? fmt::format("; on rigid contacts to {:.3g}", *decay.rigid) : "", decay.housner);
}

double capacity_lost(const Study& study)
{
    const Layout layout = lay_out(study.structure);
    std::vector<double> epistyle_n(study.structure.columns.size()); // that a column carries
    for (const EpistyleSpec& e : study.structure.epistyles)
        for (int c = e.first_column; c <= e.last_column; ++c)
            epistyle_n[static_cast<std::size_t>(c)] +=
                e.mass_kg * study.structure.gravity_m_s2 / (e.last_column - e.first_column + 1);
    double worst = 0;
    for (std::size_t c = 0; c < study.structure.columns.size(); ++c) {
        double weight = epistyle_n[c], bottom = 0, top = 0, width = 0, K_N = 0;
        for (std::size_t i = 0; i < layout.beds.size(); ++i) {
            const PlacedBlock& block = layout.blocks[static_cast<std::size_t>(layout.beds[i].upper)];
            if (block.role != BlockRole::drum || block.column != static_cast<int>(c))
                continue;
            if (width == 0) { // the lowest bed
                width = block.width_m;
                bottom = block.bottom();
                K_N = layout.beds[i].bed.normal_stiffness_n_m2.value_or(study.contact.normal_stiffness_n_m2);
            }
            weight += block.mass_kg * study.structure.gravity_m_s2;
            top = block.top();
        }
        const double h = (top - bottom) / 2, b = width / 2;
        worst = std::max(worst, 3 * std::pow(std::sqrt(2 * weight / K_N) / (6 * h), 2.0 / 3) * h / b);
    }
    return worst;
}

std::optional<std::uint64_t> counted_trials(const LoadedStudy& loaded)
{
    const Study& study = loaded.study();
    const StudyDesign design = study.design();
    if (design.motions)
        return motion_groups(study, motion_table(*loaded.experiment().motions().drawn)).groups;
    if (design.selected || design.factors || (!study.surface && study.realizations < 2))
        return std::nullopt;
    return study.realizations;
}

double worst_half_width(std::uint64_t realizations)
{
    const BinomialInterval interval = jeffreys(realizations, realizations / 2, 0.95);
    return (interval.upper - interval.lower) / 2;
}

std::string width_text(const Study& study, std::uint64_t trials)
{
    return fmt::format("{}{} {} a probability near 0.5 to ±{:.2g} (95 %)",
                       counted(trials, study.design().motions ? "ground motion" : "run"),
                       study.surface ? " of a cell" : "", trials == 1 ? "fixes" : "fix", worst_half_width(trials));
}

Jumps jumps_of(const std::vector<std::uint64_t>& valid, const std::vector<std::uint64_t>& collapsed,
               std::size_t columns)
{
    const auto nearly = [&](std::size_t cell, bool all) {
        if (valid[cell] == 0)
            return false;
        const double share = static_cast<double>(collapsed[cell]) / static_cast<double>(valid[cell]);
        const BinomialInterval interval = jeffreys(valid[cell], collapsed[cell], 0.95);
        return all ? share >= 0.9 && interval.lower > 0.7 : share <= 0.1 && interval.upper < 0.3;
    };
    Jumps jumps;
    for (std::size_t row = 0; row < valid.size(); row += columns) {
        bool none = false, all = false, jump = false;
        for (std::size_t k = 0; k < columns; ++k) {
            const bool few = nearly(row + k, false), many = nearly(row + k, true);
            jump = jump || (many && k > 0 && nearly(row + k - 1, false));
            none = none || few;
            all = all || many;
        }
        jumps.rows += none && all;
        jumps.jumping += jump;
    }
    return jumps;
}

} // namespace stylobate
