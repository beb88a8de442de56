#pragma once
/// Studies small enough for the tests of a device's slots.

#include "ensemble/experiment.hpp"
#include "ensemble/model/motion.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/sampling/drawn_motions.hpp"
#include "io/study/study_file.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

inline const std::string inputs = std::string(STYLOBATE_SOURCE_DIR) + "/studies/inputs/";

inline Study column(const std::vector<std::string>& more)
{
    std::vector<std::string> settings{"study.realizations=4",
                                      "surface.frequency_hz={ from = 1.0, to = 4.0, count = 2 }",
                                      "surface.pga_m_s2={ from = 1.0, to = 9.0, count = 3 }"};
    settings.insert(settings.end(), more.begin(), more.end());
    return read_study(inputs + "small_scale_column.toml", settings);
}

inline Study colonnade(const std::vector<std::string>& more)
{
    std::vector<std::string> settings{"study.realizations=3", "excitation.cycles=5",
                                      "surface.frequency_hz={ from = 1.5, to = 3.0, count = 2 }",
                                      "surface.pga_m_s2={ from = 6.0, to = 15.0, count = 2 }"};
    settings.insert(settings.end(), more.begin(), more.end());
    return read_study(inputs + "small_scale_colonnade_drums.toml", settings);
}

/// Two seconds of a chirp of 1 to 5 Hz and up to 1 m/s2, with a jump at its beginning, samples 0.01 s apart.
inline Motion chirp()
{
    std::vector<double> samples;
    for (int i = 0; i < 200; ++i) {
        const double t = 0.01 * i;
        samples.push_back(std::cos(2 * std::numbers::pi * (1 + t) * t) * std::exp(-t));
    }
    Motion motion = motion_of(samples, 0.01);
    motion.predominant_frequency_hz = 2;
    return motion;
}

inline Study along_chirp(const std::vector<std::string>& more)
{
    Study study = column(more);
    study.excitation.kind = ExcitationKind::record;
    return study;
}

/// Fourteen pulses, each of several strengths.
inline Study under_pulses()
{
    return read_study(inputs + "fragility_column.toml",
                      {"study.realizations=1", "fragility.contacts=1", "fragility.twins=1", "fragility.motions=14",
                       "fragility.intensity.count=3"});
}

/// These pulses, with a measure of their intensity.
inline Motions pulses_of(const Study& study)
{
    MotionSet pulses = drawn_motions(study);
    pulses.measures.push_back({"pgv_m_s", 1, {}});
    for (const auto& motion : pulses.motions)
        pulses.measures.back().value.push_back(peak(motion->velocity_m_s));
    return {.drawn = std::make_shared<const MotionSet>(std::move(pulses))};
}

} // namespace stylobate
