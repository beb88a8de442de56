#include "ensemble/experiment.hpp"

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
          sampler(study, address(motions.record), address(motions.vertical), motions.drawn)
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

} // namespace stylobate
