#pragma once
/// Campaigns with nothing hidden: the same specimen, motions and cameras, simulated with healthy contacts of many
/// kinds.
///
/// What a diagnosis would find in them is what it may find by chance. Each campaign has a contact law of its own, as
/// that of a real specimen is unknown. What varies from specimen to specimen is drawn: friction (all joints and each),
/// widths, masses; and from run to run where the blocks were put, unless the cameras saw that.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/motion.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/run/executor.hpp"
#include "ensemble/tracking/specimen.hpp"
#include "ensemble/tracking/tracking.hpp"
#include "studies/measured/diagnosis/campaigns/cause_model.hpp"
#include "studies/measured/diagnosis/campaigns/law_family.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace stylobate {

/// What of a virtual campaign is drawn beside friction, widths and masses.
struct HealthyScatter {
    /// Put the blocks where the measured ones were seen before the base moved, as well as that is known. False, and
    /// where they were not seen: anew in each run, with the specimen's tolerance.
    bool placed_as_seen = false;
    /// The contact law of each campaign, from a wide family (`law_family.hpp`). Empty: the contacts of the study.
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
