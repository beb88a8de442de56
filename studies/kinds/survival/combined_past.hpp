#pragma once
/// Several structures of one site that have been through the same shaking.
///
/// Given the motion each responds by itself; the likelihood of a past is the mean over the motions of the product of
/// theirs (`past_likelihood.hpp`). Their studies therefore have the same motions: the same excitation, axes, seed and
/// `structures_per_motion`, and each its own `survival.structure`, by which it draws its own properties. That the
/// ground moved in the same way under all of them is an assumption: soil, topography and the direction of the shaking
/// may differ.

#include "io/plots/figure.hpp"
#include "studies/kinds/survival/survival.hpp"
#include "studies/report/json.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// A results file of a survival study.
struct StructurePast {
    std::string file; ///< for messages
    const Study& study;
    const SurvivalCounts& counts;
};

struct CombinedPast {
    std::vector<std::string> files;
    int dimensions = 2; ///< of the structures
    PastAxes axes;
    std::string prior;
    double level = 0.95;
    std::uint64_t agree = 0, motions = 0; ///< motions under which a structure of each agrees, of those of all cells
    std::vector<Exclusion> alone;         ///< of each structure, by one event
    PastAnswer together;
    std::vector<ExclusionCoverage> coverage; ///< (ni) as of one structure
    std::optional<MonumentTest> sites;       ///< simulated sites
};

/// @throws InputError if there are fewer than two, if they have other motions, axes, priors or levels or the same
///         number of their structure, if one of them cannot be judged, or if no past explains all of them
CombinedPast combined_past(const std::vector<StructurePast>& structures);

std::string combined_text(const CombinedPast& combined);
Json combined_json(const CombinedPast& combined);
/// The likelihood over the intensity of each and of all, of one event.
Figure combined_figure(const CombinedPast& combined);

} // namespace stylobate
