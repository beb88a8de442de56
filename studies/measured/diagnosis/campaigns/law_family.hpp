#pragma once
/// Healthy contact laws: what the contacts of an undamaged specimen may be like, drawn for campaigns with nothing
/// hidden. The law is common to all joints; it is not known, and no cause.
///
/// The kernel has springs at two, at five or at continuously many points of a face, with fixed weights; they are chosen
/// by the form. Beside the form an exponent of the force, stiffness, ratio of shear to normal stiffness, damping of
/// four kinds and where it acts, and how far inside the corners a face begins to carry. Creep of the joints is not
/// among them: the kernel has no force that relaxes.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/realization.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/tracking/specimen.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace stylobate {

/// What takes the energy of closing faces.
enum class DampingKind {
    light,   ///< next to nothing: dashpots of 0.3 to 3 % of critical damping
    dashpot, ///< of 3 to 50 %, with some rate of Hunt and Crossley's beside them
    rate,    ///< mainly in proportion to force and speed (Hunt and Crossley)
    plastic  ///< dashpots of 50 to 100 %: faces hardly part again
};
const char* to_string(DampingKind kind);

/// One law; some of its numbers are relative to the study's contacts.
struct HealthyLaw {
    ContactForm form = ContactForm::area;
    DampingKind kind = DampingKind::dashpot;
    double stiffness = 1; ///< K_N over the study's
    double shear = 1;     ///< K_T over K_N, over the same of the study
    double exponent = 1;  ///< q of the force, beside the form's own (points: pressure with depth^1.5)
    double damping = 0.1; ///< ratio of the normal dashpots
    double tangential_damping = 0.1;
    double face_share = 1; ///< of the dashpot at the ends of the face; the forms with points have all of it there
    double rate = 0;       ///< Hunt and Crossley's lambda times the impact velocity 0.1 sqrt(g x height)
    double inset = 0;      ///< of where all faces begin to carry, over the half width
    double friction = 1;   ///< of all joints, over the nominal one

    friend bool operator==(const HealthyLaw&, const HealthyLaw&) = default;
};

/// From which laws are drawn: uniform between the bounds, in the logarithm for what is a scale.
struct LawFamily {
    std::vector<ContactForm> forms = {ContactForm::area, ContactForm::two_corner, ContactForm::points};
    std::vector<DampingKind> kinds = {DampingKind::light, DampingKind::dashpot, DampingKind::rate,
                                      DampingKind::plastic};
    double least_stiffness = 0.1, most_stiffness = 3; ///< stiffer beds cost more steps, and changed no verdict
    double least_shear = 0.1, most_shear = 1;
    double least_exponent = 0.8, most_exponent = 1.6;
    double least_points_exponent = 0.7, most_points_exponent = 1.3; ///< of the form `points`
    double most_inset = 0.03;      ///< small ones are likelier: of the square of a uniform number
    double common_friction = 0.05; ///< 1 sigma, relative
};

/// The law of one campaign: a pure function of family, seed and number. Forms and kinds of damping take turns; every
/// other quantity has draws of its own, so that families with and without a part differ in nothing else.
HealthyLaw draw_law(const LawFamily& family, std::uint64_t seed, std::uint64_t number);

/// A law near another one: of the same form and kind of damping, its scales moved by `spread` (1 sigma of the
/// logarithm), all else by the same part of its range, within the family's bounds. A pure function of its arguments.
HealthyLaw draw_near(const LawFamily& family, const HealthyLaw& parent, double spread, std::uint64_t seed,
                     std::uint64_t number);

/// Puts a law into the contacts of a study, before a realization is made of it.
void apply_law(const HealthyLaw& law, Study& study);
/// The rest of it into the realization, with a step that is safe for it. Causes come before it: what the faces lose at
/// their ends adds to what a cause took there.
void apply_law(const HealthyLaw& law, const Specimen& specimen, const SpecimenStructure& built, double step_fraction,
               Realization& realization);

} // namespace stylobate
