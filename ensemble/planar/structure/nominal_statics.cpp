#include "ensemble/planar/structure/nominal_statics.hpp"

#include "ensemble/planar/structure/builder.hpp"
#include "ensemble/planar/structure/limit_analysis.hpp"
#include "ensemble/planar/structure/step_bound.hpp"

#include <algorithm>
#include <stdexcept>

namespace stylobate {

Realization still_realization(const Study& study)
{
    Study still;
    still.structure = study.structure;
    still.contact = study.contact;
    still.excitation.kind = ExcitationKind::none;
    still.excitation.duration_s = 1;
    const PlanarBuilder builder(still);
    Realization realization = builder.build(builder.nominal(), {});
    realization.step_s = builder.step_s(realization);
    return realization;
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
