#include "studies/experiment/duration.hpp"

#include "ensemble/motion/base_motion.hpp"

#include <algorithm>

namespace stylobate {

double shaking_s(const Experiment& experiment, const Realization& r)
{
    const double end = BaseMotion(experiment.study().excitation, r, experiment.record()).duration_s();
    if (r.vertical == nullptr)
        return end;
    return std::max(end, BaseMotion::along(r.vertical, r.step_s, r.change.offset_s).duration_s());
}

double longest_s(const Experiment& experiment, const Realization& r)
{
    return shaking_s(experiment, r) + tail_s(experiment.study().excitation, r);
}

} // namespace stylobate
