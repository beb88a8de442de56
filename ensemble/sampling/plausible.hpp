#pragma once
/// Plausibility of a study: values that the ranges of its keys allow, but that no structure of stone and no shaking
/// has. One table of checks, each a pure function of the study; a check that a study fails intentionally is named in
/// `Study::allow`.

#include "ensemble/model/motion.hpp"
#include "ensemble/planar/structure/realization.hpp"
#include "ensemble/model/study.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// Facts that are not in the study itself. Zero: not known, and not checked.
struct StudyFacts {
    double pga_m_s2 = 0;            ///< of the motions from files as they stand, the largest
    double scaled_pga_m_s2 = 0;     ///< of the motions of a fragility study in its strongest stripe, the largest
    double motion_frequency_hz = 0; ///< predominant frequency of the motions from files, the highest
    double file_bytes = 0;          ///< that the rows of the results will take

    struct Scaled {
        std::string name;
        double factor = 1; ///< the largest that the study applies to the acceleration of this motion
    };
    std::vector<Scaled> scaled = {};                          ///< motions from files
    std::vector<std::vector<std::string>> equal_motions = {}; ///< names of motions from files with the same samples
    std::vector<std::string> vertical_motions = {};           ///< vertical components that shake the base horizontally
    std::string vertical_motion = {}; ///< the vertical motion, where it is a horizontal component
};

/// What one check has found.
struct Implausibility {
    std::string check;
    bool refused = false; ///< beyond the limit of refusal: the study does not run, unless allowed; else a warning
    std::string text;     ///< value, limit, reason and likely intention: sentences
};

/// The names of all checks, in the order of the table.
std::vector<std::string> check_names();

/// What the checks find, those that `study.allow` names left out. In the order of the table.
/// @throws InputError if the structure cannot stand (`lay_out`)
std::vector<Implausibility> implausibilities(const Study& study, const StudyFacts& facts = {});

/// The structure of a study on its beds, without shaking, without mechanisms and without anything drawn.
Realization still_realization(const Study& study);

/// For each bed between the layout's blocks: how deep the weight on it presses the blocks into each other, W / (K_N B),
/// W the weight above and B the length of the bed [m] (Winkler bed, `kernels/THEORY.md` section 1). The weight of an
/// epistyle is shared equally by all of its seats.
std::vector<double> static_sinkage_m(const Study& study);

/// The first natural frequency of the nominal structure, without mechanisms, its beds in full contact [Hz] (generalized
/// eigenvalue problem K v = w2 M v): 0 if it buckles under its own weight.
double first_frequency_hz(const Study& study);

/// The structure of a study as it stands on rigid beds, nothing drawn: the largest base acceleration, held for ever,
/// at which it can rest [m/s2] (limit analysis, `ensemble/planar/structure/limit_analysis.hpp`).
struct StaticLimit {
    double rocking_m_s2 = 0; ///< if no bed could slide
    double limit_m_s2 = 0;   ///< with the friction of the study
    double rough_m_s2 = 0;   ///< with a tenth more of it
};
inline constexpr std::ptrdiff_t most_static_limit_blocks = 60;
/// Nothing for more free blocks than `most_static_limit_blocks`, for which the dense linear programme is slow, and
/// where rigid blocks cannot rest. @throws InputError as `lay_out`
std::optional<StaticLimit> static_limit(const Study& study);

} // namespace stylobate
