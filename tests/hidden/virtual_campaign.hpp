#pragma once
/// A virtual campaign from its seed: specimen, motions, runs, what the cameras saw, and what was hidden.

#include "ensemble/model/campaign.hpp"
#include "tests/hidden/hidden_effect.hpp"
#include "tests/hidden/shake.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stylobate::hidden {

/// What a campaign is drawn to be; what is not given, the seed decides.
struct Wish {
    std::optional<Law> law;
    std::optional<SpecimenKind> specimen;
    std::optional<std::vector<std::string>> effects; ///< names; empty: nothing hidden
    int most_motions = 6;                            ///< from 4; fewer make a short campaign, without repeats
    /// True friction over the nominal one that the file gives: from, to; uniform in the logarithm. Not given: 1.
    std::optional<std::pair<double, double>> friction;
};

/// One run as it truly was.
struct TrueRun {
    Shaking shaking;
    State start;
    History history;
};

struct VirtualCampaign {
    std::uint64_t seed = 0;
    Campaign campaign; ///< what the file gives
    Planned planned;
    Model model;                       ///< the specimen as it was made, with all that is hidden
    std::vector<HiddenEffect> effects; ///< none, one or two
    bool of_command = false;           ///< the file knows the command alone
    bool table_seen = false;           ///< the cameras see the table too
    std::vector<TrueRun> runs;
};

/// One seed, one campaign: two thirds or more of them hide nothing.
VirtualCampaign make_campaign(std::uint64_t seed, const Wish& wish = {});

/// The same laboratory on another day: motions, amplitudes, contact law and effects of a campaign; another specimen of
/// the same plan, put back otherwise, seen with other noise. The friction that a `Wish` has changed is not kept.
/// @param number any, a campaign each   @param with_effects false: nothing is hidden in it
VirtualCampaign another_like(const VirtualCampaign& made, std::uint64_t number, bool with_effects);

} // namespace stylobate::hidden
