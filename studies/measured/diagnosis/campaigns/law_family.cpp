#include "studies/measured/diagnosis/campaigns/law_family.hpp"

#include "ensemble/numerics/random.hpp"
#include "ensemble/statics/step_bound.hpp"
#include "studies/measured/diagnosis/evidence/law_samples.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

/// Places in the stream of a specimen's draws: far behind those of its scatter. Numbers are permanent.
enum class LawDraw : std::uint64_t {
    stiffness = 1u << 16,
    shear,
    exponent,
    damping,
    tangential_damping,
    where,
    face_share,
    rate,
    inset,
    friction
};

constexpr double impact_part = 0.1; // of sqrt(g x height)
constexpr double least_tangential = 0.01, most_tangential = 0.2;

struct Range {
    double least, most;
};

/// Ratios of the dashpots.
Range damping_of(DampingKind kind)
{
    switch (kind) {
    case DampingKind::light:
    case DampingKind::rate:
        return {0.003, 0.03};
    case DampingKind::dashpot:
        return {0.03, 0.5};
    case DampingKind::plastic:
        return {0.5, 1};
    }
    return {};
}

double log_uniform(Range range, double u)
{
    return range.least * std::pow(range.most / range.least, u);
}

double rate_of(DampingKind kind, double u)
{
    switch (kind) {
    case DampingKind::light:
        return 0;
    case DampingKind::rate:
        return log_uniform({0.5, 5}, u);
    case DampingKind::dashpot:
    case DampingKind::plastic:
        return u;
    }
    return 0;
}

/// Of a softening bed (q < 1) `step_bound` looks at small loads alone; the form `points` is stiffest at large ones, and
/// so is damping by rate. These are the linear bed's, or less.
double safe_step(const Realization& realization)
{
    Realization linear = realization;
    bool softens = false;
    for (Joint& joint : linear.joints) {
        softens = softens || joint.mechanisms.force_exponent < 1;
        joint.mechanisms.force_exponent = 1;
    }
    const double step = step_bound(realization).dt_s;
    return softens ? std::min(step, step_bound(linear).dt_s) : step;
}

} // namespace

const char* to_string(DampingKind kind)
{
    constexpr const char* words[] = {"light", "dashpot", "rate", "plastic"};
    return words[static_cast<std::size_t>(kind)];
}

HealthyLaw draw_law(const LawFamily& family, std::uint64_t seed, std::uint64_t number)
{
    const auto draw = [&](LawDraw which) {
        return uniform01(seed, number, Stream::virtual_specimen, static_cast<std::uint64_t>(which));
    };
    HealthyLaw law;
    law.form = family.forms[number % family.forms.size()];
    law.kind = family.kinds[number / family.forms.size() % family.kinds.size()];
    law.stiffness = log_uniform({family.least_stiffness, family.most_stiffness}, draw(LawDraw::stiffness));
    law.shear = log_uniform({family.least_shear, family.most_shear}, draw(LawDraw::shear));
    law.exponent =
        law.form == ContactForm::points
            ? log_uniform({family.least_points_exponent, family.most_points_exponent}, draw(LawDraw::exponent))
            : log_uniform({family.least_exponent, family.most_exponent}, draw(LawDraw::exponent));
    law.damping = log_uniform(damping_of(law.kind), draw(LawDraw::damping));
    law.tangential_damping = log_uniform({least_tangential, most_tangential}, draw(LawDraw::tangential_damping));
    law.face_share = draw(LawDraw::where) < 0.5 ? draw(LawDraw::face_share) : 1;
    law.rate = rate_of(law.kind, draw(LawDraw::rate));
    law.inset = family.most_inset * std::pow(draw(LawDraw::inset), 2);
    law.friction = std::exp(family.common_friction * to_normal(draw(LawDraw::friction)));
    return law;
}

HealthyLaw draw_near(const LawFamily& family, const HealthyLaw& parent, double spread, std::uint64_t seed,
                     std::uint64_t number)
{
    const auto normal = [&](LawDraw which) {
        return to_normal(uniform01(seed, number, Stream::virtual_specimen, static_cast<std::uint64_t>(which)));
    };
    const auto moved = [&](double value, double part, LawDraw which, double least, double most) {
        return std::clamp(value * std::exp(part * spread * normal(which)), least, most);
    };
    HealthyLaw law = parent;
    law.stiffness = moved(law.stiffness, 1, LawDraw::stiffness, family.least_stiffness, family.most_stiffness);
    law.shear = moved(law.shear, 1, LawDraw::shear, family.least_shear, family.most_shear);
    const bool points = law.form == ContactForm::points;
    law.exponent =
        moved(law.exponent, 0.25, LawDraw::exponent, points ? family.least_points_exponent : family.least_exponent,
              points ? family.most_points_exponent : family.most_exponent);
    law.damping = moved(law.damping, 1, LawDraw::damping, 1e-3, 1);
    law.tangential_damping =
        moved(law.tangential_damping, 1, LawDraw::tangential_damping, least_tangential, most_tangential);
    law.face_share = std::clamp(law.face_share + 0.3 * spread * normal(LawDraw::face_share), 0.0, 1.0);
    law.rate *= std::exp(spread * normal(LawDraw::rate));
    law.inset =
        std::clamp(law.inset + 0.3 * spread * family.most_inset * normal(LawDraw::inset), 0.0, family.most_inset);
    law.friction *= std::exp(0.9 * spread * family.common_friction * normal(LawDraw::friction));
    return law;
}

void apply_law(const HealthyLaw& law, Study& study)
{
    study.contact.form = law.form;
    study.contact.normal_stiffness_n_m2 *= law.stiffness;
    study.contact.tangential_stiffness_n_m *= law.stiffness * law.shear;
    study.contact.normal_damping_ratio = law.damping;
    study.contact.tangential_damping_ratio = law.tangential_damping;
    study.contact.normal_damping_n_s_m.reset();
    study.contact.tangential_damping_n_s_m.reset();
    study.contact.friction *= law.friction;
}

void apply_law(const HealthyLaw& law, const Specimen& specimen, const SpecimenStructure& built, double step_fraction,
               Realization& r)
{
    double height = 0;
    for (const double y : specimen.rest_y_m)
        height = std::max(height, y);
    const double impact = impact_part * std::sqrt(specimen.gravity_m_s2 * height);
    r.with_mechanisms = true;
    for (Joint& joint : r.joints) {
        JointMechanisms& e = joint.mechanisms;
        e.face_damping += (1 - e.face_damping) * law.face_share;
        e.rate_s_m += law.rate / impact;
    }
    const std::vector<double> weights = rest_weights(specimen);
    for (std::size_t j = 0; j < built.bed.size(); ++j) {
        Joint& joint = r.joints[static_cast<std::size_t>(built.bed[j])];
        const Block& lower = r.blocks[static_cast<std::size_t>(joint.lower)];
        const Block& upper = r.blocks[static_cast<std::size_t>(joint.upper)];
        const double inset = law.inset * std::min(lower.half_width_m, upper.half_width_m);
        joint.mechanisms.chip_left_m += inset;
        joint.mechanisms.chip_right_m += inset;
        if (law.exponent != 1) {
            joint.mechanisms.force_exponent = law.exponent;
            // the beds rest alike, whatever the exponent
            joint.mechanisms.reference_overlap_m2 = weights[j] / joint.normal_stiffness_n_m2;
        }
    }
    r.step_s = step_fraction * safe_step(r);
}

} // namespace stylobate
