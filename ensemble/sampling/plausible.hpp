#pragma once
/// Plausibility of a study: values that the ranges of its keys allow, but that no structure of stone and no shaking
/// has. One table of checks, each a pure function of the study; a check that a study fails intentionally is named in
/// `Study::allow`.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/study.hpp"

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
    std::optional<std::string> vertical_motion = {}; ///< the vertical motion, where it is a horizontal component
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

} // namespace stylobate
