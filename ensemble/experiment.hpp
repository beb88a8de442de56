#pragma once
/// A study, the motions that shake it, and its sampler in one object, made once: all that a run, a replay, a report or
/// an export needs of what is simulated.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/motion_set.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/sampling/sampler.hpp"

#include <memory>
#include <optional>

namespace stylobate {

/// The sampled motions of a study; what it does not need stays empty.
struct Motions {
    std::optional<Motion> record{};           ///< of a study with `excitation.kind` "record" or "table"
    std::optional<Motion> vertical{};         ///< of one with a vertical record
    std::optional<Motion> second{};           ///< second horizontal component of a record or table in space
    std::shared_ptr<const MotionSet> drawn{}; ///< of a fragility study
};

/// Nothing of it ever changes: a copy shares its parts with the original, and references to them stay valid as long as
/// one of the copies lives, wherever it is moved.
class Experiment {
public:
    /// @throws what the constructor of `Sampler` throws
    explicit Experiment(Study study, Motions motions = {});

    const Study& study() const;
    /// The base motion of a study of kind "record" or "table", else null.
    const Motion* record() const;
    const Motions& motions() const;
    const Sampler& sampler() const;

private:
    struct Parts;
    std::shared_ptr<const Parts> parts_;
};

/// The end of a realization's shaking [s].
double shaking_s(const Experiment& experiment, const Realization& realization);

/// How long it lasts at most: its shaking and what is watched after it. One that falls or comes to rest ends earlier
/// [s].
double longest_s(const Experiment& experiment, const Realization& realization);

} // namespace stylobate
