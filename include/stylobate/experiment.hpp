#pragma once
/// A study with the motions that shake it.

#include "stylobate/record.hpp"
#include "stylobate/study.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace stylobate::api {

/// Everything that its realizations depend on; each is a pure function of (experiment, index), with the same bits for
/// every instruction set and number of threads. Nothing of it changes; a copy is cheap.
class Experiment {
public:
    /// With the excitation that the study names: its records are read, or its motions drawn.
    /// @throws InputError if a record cannot be read, if the structure cannot stand, and if the study is so far from
    ///         anything plausible that the command line would refuse it
    explicit Experiment(const Study& study);

    /// With a base acceleration of one's own, instead of the study's [excitation].
    ///
    /// The acceleration is sampled and taken as linear between the samples; the base is at rest before time 0, and its
    /// acceleration is zero after the last sample. Nothing is corrected: a function whose integral is not zero leaves
    /// the base with a velocity.
    ///
    /// In a study of kind "surface" the motion is scaled to the PGA of each cell, and its time to the frequency of each
    /// cell, as a record is. In any other study it stands as it is given, unless the study has an excitation of kind
    /// "record" whose `scale_to_pga_m_s2` or `time_scale` sets another one.
    ///
    /// @param acceleration_m_s2 of the base at a time in seconds, from 0 on
    /// @param dt_s       distance of the samples: 0.01 s or less, and a fraction of the shortest period in the function
    /// @param duration_s of the shaking; the study's `excitation.tail_s` is the time simulated after it
    /// @throws InputError as above, if the samples are fewer than 10 or one of them is not finite, and for a study of
    ///         kind "fragility", whose motions come from its [fragility]
    Experiment(const Study& study, const std::function<double(double time_s)>& acceleration_m_s2, double dt_s,
               double duration_s);

    /// With a record, instead of the study's [excitation]. Its baseline is corrected unless the study has an excitation
    /// of kind "record" whose `baseline` is false; scaled as above.
    /// @throws InputError as above, and for a study that draws what a record does not have, such as a phase
    Experiment(const Study& study, const Record& record);

    /// The study, with the excitation that it is run with.
    Study study() const;
    std::uint64_t realizations() const { return study().realizations(); }
    /// What of the study can hardly be meant, a sentence or several each.
    std::vector<std::string> warnings() const;

    Experiment(const Experiment&) = default;
    Experiment& operator=(const Experiment&) = default;

private:
    struct Data;
    friend struct Inside;
    std::shared_ptr<const Data> data_;
};

} // namespace stylobate::api
