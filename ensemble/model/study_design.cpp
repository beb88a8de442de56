#include "ensemble/model/study_design.hpp"

#include "ensemble/model/study.hpp"

#include <algorithm>

namespace stylobate {

StudyDesign Study::design() const
{
    StudyDesign design;
    design.per_cell = realizations;
    design.traced = kind == StudyKind::single;
    if (surface) {
        design.cells = static_cast<std::uint64_t>(surface->cells());
        design.columns = static_cast<std::uint64_t>(surface->pga_m_s2.count);
        (surface->direction_deg ? design.direction_deg : design.frequency_hz) = &surface->rows();
        design.pga_m_s2 = &surface->pga_m_s2;
        design.selected = surface->adaptive.has_value();
    }
    if (fragility) {
        design.motions = &*fragility;
        design.columns = design.recurring = static_cast<std::uint64_t>(fragility->stripes());
        design.cells = static_cast<std::uint64_t>(fragility->motions) * design.columns;
        design.same_contacts = static_cast<std::uint64_t>(fragility->twins);
        design.same_imperfections = static_cast<std::uint64_t>(fragility->contacts) * design.same_contacts;
        design.twin_m = fragility->twins > 1 ? fragility->twin_m : 0;
    }
    if (sensitivity) {
        design.factors = &*sensitivity;
        design.per_cell = sensitivity->total();
    }
    if (rare) {
        design.per_cell = rare->simulations() * RareSpec::indices_of_simulation;
        design.chained_from = rare->samples;
        design.selected = true;
    }
    if (survival) {
        design.events = survival->events;
        design.layers = static_cast<std::uint64_t>(survival->events);
        design.event_pause_s = survival->pause_s;
        design.per_motion = survival->per_motion;
        design.structure = survival->structure;
        design.end_state = true;
    }
    if (replicas) {
        design.replica_set = &*replicas;
        design.layers += replicas->kinds.size();
    }
    design.residuals = fragility || sensitivity || (survival && survival->observed);
    design.most = rare                           ? rare->most()
                  : surface && surface->adaptive ? std::min(design.total(), surface->adaptive->budget)
                                                 : design.total();
    return design;
}

Study Study::as_single(std::uint64_t count) const
{
    Study single = without_replicas();
    single.kind = StudyKind::single;
    single.realizations = count;
    single.surface.reset();
    single.fragility.reset();
    single.sensitivity.reset();
    single.rare.reset();
    single.survival.reset();
    return single;
}

Study Study::without_replicas() const
{
    Study originals = *this;
    originals.replicas.reset();
    return originals;
}

} // namespace stylobate
