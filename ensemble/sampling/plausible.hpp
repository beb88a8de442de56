#pragma once
/// Whether a study can be meant as it stands: values that the ranges of its keys allow, and that no structure of stone
/// and no shaking has. One table of checks, each a pure function of the study; a check that is meant to fail is named
/// in `Study::allow`.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/study.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace stylobate {

/// What a study does not hold itself. Zero: not known, and not checked.
struct StudyFacts {
    double pga_m_s2 = 0;            ///< of the motions from files as they stand, the largest
    double motion_frequency_hz = 0; ///< predominant frequency of the motions from files, the highest
    double file_bytes = 0;          ///< that the rows of the results will take
};

/// What one check has found.
struct Doubt {
    std::string check;
    bool refused = false; ///< so far beyond that the study does not run, unless it is allowed; else a warning
    std::string text;     ///< value, limit, reason and what may be meant: sentences
};

/// The names of all checks, in the order of the table.
std::vector<std::string> check_names();

/// What the checks find, those that `study.allow` names left out. In the order of the table.
/// @throws InputError if the structure cannot stand (`lay_out`)
std::vector<Doubt> doubts(const Study& study, const StudyFacts& facts = {});

/// Of each bed between the layout's blocks: how deep the weight on it presses the blocks into each other, W / (K_N B),
/// W the weight above and B the length of the bed [m]. An epistyle leans on all of its seats alike.
std::vector<double> static_sinkage_m(const Study& study);

/// The first natural frequency of the structure as it is given, nothing drawn, without mechanisms, its beds full [Hz]:
/// 0 if it buckles under its own weight. NaN for more than 100 free blocks: its cost grows with their cube.
double first_frequency_hz(const Study& study);

} // namespace stylobate
