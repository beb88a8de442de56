#pragma once
/// Campaigns with nothing hidden: the same specimen, motions and cameras, simulated with healthy contacts of many
/// kinds.
///
/// What a diagnosis would find in them is what it may find by chance. Each campaign has a contact law of its own, as
/// that of a real specimen is unknown. What varies from specimen to specimen is drawn: friction (all joints and each),
/// widths, masses; and from run to run where the blocks were put, unless the cameras saw that.
///
/// Healthy contact laws: what the contacts of an undamaged specimen may be like, drawn for campaigns with nothing
/// hidden. The law is common to all joints; it is not known, and no cause.
///
/// The kernel has springs at two, at five or at continuously many points of a face, with fixed weights; they are chosen
/// by the form. Beside the form an exponent of the force, stiffness, ratio of shear to normal stiffness, damping of
/// four kinds and where it acts, and how far inside the corners a face begins to carry. Creep of the joints is not
/// among them: the kernel has no force that relaxes.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/motion.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/realization/realization.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/tracking/specimen.hpp"
#include "ensemble/tracking/tracking.hpp"
#include "studies/measured/diagnosis/campaigns/cause_model.hpp"

#include <cstdint>
#include <memory>
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

/// The longest step that is safe for a drawn law. Of a softening bed (q < 1) `step_bound` looks at small loads alone;
/// the form `points` is stiffest at large ones, and so is damping by rate. These are the linear bed's, or less.
double safe_step_s(const Realization& realization);

/// One specimen, as specimens vary: friction of all joints and of each, widths and masses; all but where its blocks
/// are put. A pure function of (seed, number).
/// @param about contacts; its structure is the specimen's   @param law null: the contacts of the study
Realization draw_specimen(const Specimen& specimen, const Study& about, const SpecimenStructure& built,
                          std::uint64_t seed, std::uint64_t number, const HealthyLaw* law,
                          const std::vector<SizedCause>& causes);

/// What of a virtual campaign is drawn beside friction, widths and masses.
struct HealthyScatter {
    /// Put the blocks where the measured ones were seen before the base moved, as well as that is known. False, and
    /// where they were not seen: anew in each run, with the specimen's tolerance.
    bool placed_as_seen = false;
    /// The contact law of each campaign, from a wide family (`HealthyLaw`). Empty: the contacts of the study.
    std::vector<HealthyLaw> laws = {};
};

struct VirtualCampaigns {
    std::vector<Campaign> campaigns;         ///< run by run as the measured one, without what a collapse ends
    std::vector<std::vector<double>> base_m; ///< (runs)(nt) displacement of the base, at the cameras' samples
    SimulationCount cost;
    bool complete = false; ///< false: the observer stopped it
};

/// What simulated campaigns depend on, as text: the program's version, and a checksum of specimen, motions, cameras,
/// contacts and seed.
std::string campaign_key(const Campaign& measured, const Study& study, std::uint64_t seed);

/// Where the blocks of a run were put.
struct SeenPlaces {
    std::vector<double> offset_m; ///< (blocks) beside their nominal places; empty: not seen
    double sd_m = 0;              ///< of each, by the cameras' noise
};

/// By the samples before the base moves, at least 20. Where the cameras do not see the table, their zero is not known,
/// and offsets count from what stands on the base.
SeenPlaces seen_places(const Specimen& specimen, const MeasuredRun& run);

/// A measured campaign, ready to be simulated many times: its specimen, and the base motion of each run from all
/// sensors that saw it.
struct VirtualLaboratory {
    explicit VirtualLaboratory(const Campaign& campaign);

    const Campaign& measured;
    SpecimenStructure built;
    // (runs) empty: not shaken, or not seen
    std::vector<std::shared_ptr<const Motion>> base;
    std::vector<std::shared_ptr<const std::vector<double>>> times_s; ///< the cameras', from the first one
    std::vector<std::vector<double>> base_m;                         ///< as `VirtualCampaigns::base_m`
    std::vector<SeenPlaces> placed;                                  ///< (runs)
    std::vector<JointPath> before; ///< paths of the joints in the runs before each, as measured: wear that goes on
                                   ///< from run to run is taken to have gone so far in a simulated one, too
};

/// @param study contacts; its structure is the specimen's
/// @param scatter with no laws, or one for each campaign
/// @param causes that act, for campaigns that are to show something; of the base: none. One list for each campaign, or
///        one for all of them, or none
/// @param first number of the first campaign: each is a pure function of (seed, number)
VirtualCampaigns virtual_campaigns(const VirtualLaboratory& laboratory, const Study& study, std::uint64_t seed,
                                   std::uint64_t first, std::uint64_t count, const HealthyScatter& scatter,
                                   const std::vector<std::vector<SizedCause>>& causes, const RunOptions& options,
                                   Observer& observer);

} // namespace stylobate
