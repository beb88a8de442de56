#include "studies/check/rocking_decay.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/planar/structure/nominal_statics.hpp"
#include "ensemble/planar/structure/step_bound.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "kernels/isa.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr double released_at = 0.5; // of the slenderness

struct Outline {
    double width_m = 0, height_m = 0; ///< of the free part
    double slenderness_rad() const { return std::atan2(width_m, height_m); }
    double p_rad_s(double gravity_m_s2) const
    {
        return std::sqrt(0.75 * gravity_m_s2 / (std::hypot(width_m, height_m) / 2));
    }
};

/// @pre the structure is one column
Outline outline_of(const StructureSpec& structure)
{
    double top = 0, bottom = -1, width = 0;
    for (const PlacedBlock& block : lay_out(structure).blocks) {
        if (block.fixed)
            continue;
        if (bottom < 0) {
            bottom = block.bottom();
            width = block.width_m;
        }
        top = std::max(top, block.top());
    }
    return {width, top - bottom};
}

/// The first column alone, released.
Study release_of(const Study& study)
{
    Study s;
    s.structure = study.structure;
    s.structure.kind = StructureKind::column;
    s.structure.columns.resize(1);
    s.structure.columns.front().x_m = 0; // as a column that stands alone
    s.structure.epistyles.clear();
    s.contact = study.contact;
    s.excitation.kind = ExcitationKind::none;
    const Outline outline = outline_of(s.structure);
    s.excitation.duration_s = 6 / outline.p_rad_s(s.structure.gravity_m_s2); // the first return comes after 5.3 / p
    int fixed = 0;
    for (const PlacedBlock& block : lay_out(s.structure).blocks)
        fixed += block.fixed;
    s.initial.tilt_rad = released_at * outline.slenderness_rad();
    s.initial.tilt_from_block = fixed;
    return s;
}

/// The largest lean to the other side of the line from the foot to the top, over the slenderness; nothing if it fell.
std::optional<double> first_return(const Study& study)
{
    const Realization r = Sampler(study, nullptr).realization(0);
    constexpr double most_block_steps = 2e7;
    if (study.excitation.duration_s / r.step_s * static_cast<double>(r.blocks.size()) > most_block_steps)
        return std::nullopt;
    LaneSet set(study, nullptr, kernels(Isa::scalar), r);
    set.load(0, r);
    const auto is_free = [](const Block& block) { return !block.fixed; };
    const auto foot = static_cast<std::size_t>(std::ranges::find_if(r.blocks, is_free) - r.blocks.begin());
    std::size_t top = foot;
    for (std::size_t i = foot; i < r.blocks.size(); ++i)
        top = is_free(r.blocks[i]) ? i : top;
    const auto lean = [&](const Snapshot& at) { // counter-clockwise, of the line from the foot to the top
        const double down = r.blocks[foot].half_height_m, up = r.blocks[top].half_height_m;
        const double x =
            at.x_m[top] - up * std::sin(at.theta_rad[top]) - at.x_m[foot] - down * std::sin(at.theta_rad[foot]);
        const double y =
            at.y_m[top] + up * std::cos(at.theta_rad[top]) - at.y_m[foot] + down * std::cos(at.theta_rad[foot]);
        return std::atan2(-x, y);
    };
    double least = 0;
    constexpr int between = 4; // steps between two looks: those of rigid contacts are long
    for (int k = 0; !set.done(0); k = (k + between) % chunk_steps) {
        set.advance(k, k + between);
        least = std::min(least, lean(set.snapshot(0)));
    }
    if (!set.outcome(0) || set.outcome(0)->state == State::collapsed || set.outcome(0)->state == State::invalid)
        return std::nullopt;
    return -least / outline_of(study.structure).slenderness_rad();
}

} // namespace

double RockingDecay::lost(double lean) const
{
    const double a = slenderness_rad;
    const auto energy = [&](double part) { return std::cos(a * (1 - part)) - std::cos(a); };
    return 1 - energy(lean) / energy(released_at);
}

std::optional<RockingDecay> rocking_decay(const Study& study)
{
    if (study.contact.form == ContactForm::rigid)
        return std::nullopt;
    const Study compliant = release_of(study);
    RockingDecay decay;
    const double a = decay.slenderness_rad = outline_of(compliant.structure).slenderness_rad();
    const double e = 1 - 1.5 * std::sin(a) * std::sin(a);
    if (e <= 0)
        return std::nullopt;
    decay.housner = 1 - std::acos(std::cos(a) + e * e * (std::cos(a * (1 - released_at)) - std::cos(a))) / a;
    const std::optional<double> law = first_return(compliant);
    if (!law)
        return std::nullopt;
    decay.law = *law;
    Study rigid = compliant;
    rigid.contact = ContactSpec(); // as a study file gives it
    rigid.contact.form = ContactForm::rigid;
    rigid.contact.normal_damping_ratio = rigid.contact.tangential_damping_ratio = 0;
    rigid.contact.friction = study.contact.friction;
    decay.rigid = first_return(rigid);
    return decay;
}

FreeMotion free_motion(const Study& study)
{
    FreeMotion free;
    if (study.contact.form == ContactForm::rigid || study.structure.spatial())
        return free;
    free.mode = first_mode(still_realization(study));
    free.decay = rocking_decay(study);
    return free;
}

} // namespace stylobate
