#include "ensemble/experiment.hpp"

#include "ensemble/motion/base_motion.hpp"
#include "ensemble/motion/motions_in_space.hpp"

#include <algorithm>
#include <utility>

namespace stylobate {

namespace {

const Motion* address(const std::optional<Motion>& motion)
{
    return motion ? &*motion : nullptr;
}

} // namespace

struct Experiment::Parts {
    Study study; // stays where it is: the sampler refers to it
    Motions motions;
    Sampler sampler;

    Parts(Study s, Motions m)
        : study(std::move(s)), motions(std::move(m)),
          sampler(study, address(motions.record), address(motions.vertical), motions.drawn, address(motions.second))
    {
    }
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
};

Experiment::Experiment(Study study, Motions motions)
    : parts_(std::make_shared<const Parts>(std::move(study), std::move(motions)))
{
}

const Study& Experiment::study() const
{
    return parts_->study;
}

const Motion* Experiment::record() const
{
    return address(parts_->motions.record);
}

const Motions& Experiment::motions() const
{
    return parts_->motions;
}

const Sampler& Experiment::sampler() const
{
    return parts_->sampler;
}

double shaking_s(const Experiment& experiment, const Realization& r)
{
    if (r.spatial()) {
        double end_s = 0;
        for (const BaseMotion& motion : motions_in_space(experiment.study().excitation, r, experiment.record()))
            end_s = std::max(end_s, motion.duration_s());
        return end_s;
    }
    const double end = BaseMotion(experiment.study().excitation, r, experiment.record()).duration_s();
    if (r.vertical == nullptr)
        return end;
    return std::max(end, BaseMotion::along(r.vertical, r.step_s, r.change.offset_s).duration_s());
}

double longest_s(const Experiment& experiment, const Realization& r)
{
    return shaking_s(experiment, r) + tail_s(experiment.study().excitation, StructureBuilder::scales(r));
}

} // namespace stylobate
