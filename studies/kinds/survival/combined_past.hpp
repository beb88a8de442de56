#pragma once
/// Several structures of one site that have been through the same shaking.
///
/// Each responds by itself: the likelihood of a past is the product of theirs, cell by cell. Their studies have the
/// same axes, number of events, prior and level. That the ground moved in the same way under all of them is an
/// assumption: soil, topography and the direction of the shaking may differ.

#include "studies/kinds/survival/survival.hpp"
#include "studies/report/figure.hpp"
#include "studies/report/json.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// A results file of a survival study, as far as it is needed here.
struct StructurePast {
    std::string file; ///< for messages
    Study study;
    PastAxes axes;
    std::vector<CellCount> agreeing; ///< (cells)
};

struct CombinedPast {
    std::vector<std::string> files;
    PastAxes axes;
    std::string prior;
    double level = 0.95;
    std::vector<Exclusion> alone;    ///< of each structure, by one event, mean over the frequencies
    std::vector<Exclusion> together; ///< by 1, 2, ... events
    PastPosterior posterior;
};

/// @throws InputError if there are fewer than two, if they have other axes, priors or levels, if one of them cannot be
///         judged, or if no past explains all of them
CombinedPast combined_past(const std::vector<StructurePast>& structures);

std::string combined_text(const CombinedPast& combined);
Json combined_json(const CombinedPast& combined);
/// The likelihood over the intensity of each and of all, of one event.
Figure combined_figure(const CombinedPast& combined);

} // namespace stylobate
