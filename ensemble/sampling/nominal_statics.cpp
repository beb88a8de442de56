/// What statics gives of the nominal structure of a study: sinkage, first frequency, limit of rest.

#include "ensemble/model/structure.hpp"
#include "ensemble/sampling/plausible.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "ensemble/planar/structure/limit_analysis.hpp"
#include "ensemble/planar/structure/step_bound.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace stylobate {

Realization still_realization(const Study& study)
{
    Study still;
    still.structure = study.structure;
    still.contact = study.contact;
    still.excitation.kind = ExcitationKind::none;
    still.excitation.duration_s = 1;
    return Sampler(still, nullptr).realization(0);
}

std::vector<double> static_sinkage_m(const Study& study)
{
    const Layout layout = lay_out(study.structure);
    const double ground = std::numeric_limits<double>::infinity();
    std::vector<double> carried(layout.blocks.size(), 0.0); // weight on top of each block
    std::vector<int> seats(layout.blocks.size(), 0);
    for (const PlacedBed& bed : layout.beds)
        ++seats[static_cast<std::size_t>(bed.upper)];
    std::vector<double> sinkage(layout.beds.size());
    for (std::size_t i = layout.beds.size(); i-- > 0;) { // from the epistyles down
        const PlacedBed& bed = layout.beds[i];
        const PlacedBlock& upper = layout.blocks[static_cast<std::size_t>(bed.upper)];
        const auto at = static_cast<std::size_t>(bed.upper);
        const double weight = (upper.mass_kg * study.structure.gravity_m_s2 + carried[at]) / seats[at];
        double left = -ground, right = ground;
        if (bed.lower >= 0) {
            const PlacedBlock& lower = layout.blocks[static_cast<std::size_t>(bed.lower)];
            carried[static_cast<std::size_t>(bed.lower)] += weight;
            left = lower.left();
            right = lower.right();
        }
        const double length = std::min(right, upper.right()) - std::max(left, upper.left());
        sinkage[i] = weight / (bed.bed.normal_stiffness_n_m2.value_or(study.contact.normal_stiffness_n_m2) * length);
    }
    return sinkage;
}

double first_frequency_hz(const Study& study)
{
    return first_mode_of_paper(still_realization(study)).frequency_hz;
}

std::optional<StaticLimit> static_limit(const Study& study)
{
    Realization r = still_realization(study);
    if (std::count_if(r.blocks.begin(), r.blocks.end(), [](const Block& b) { return !b.fixed; }) >
        most_static_limit_blocks)
        return std::nullopt;
    StaticLimit limit;
    try {
        limit.limit_m_s2 = limit_acceleration(r).acceleration_m_s2;
        for (Joint& joint : r.joints)
            joint.friction *= 1.1;
        limit.rough_m_s2 = limit_acceleration(r).acceleration_m_s2;
        constexpr double no_sliding = 1e3;
        for (Joint& joint : r.joints)
            joint.friction = no_sliding;
        limit.rocking_m_s2 = limit_acceleration(r).acceleration_m_s2;
    } catch (const std::runtime_error&) { // rigid blocks do not rest so: nothing is known
        return std::nullopt;
    }
    return limit;
}

} // namespace stylobate
