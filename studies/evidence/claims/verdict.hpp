#pragma once
/// From the cases of a test to its verdict.

#include "studies/evidence/claims/criterion.hpp"

namespace stylobate::claims {

enum class Judgement { confirmed, refuted, depends, untestable, not_run };
const char* to_string(Judgement judgement);

/// "a, b and c"
std::string series(const std::vector<std::string>& list);

struct Verdict {
    Judgement judgement = Judgement::not_run;
    std::size_t holds = 0, fails = 0, undecided = 0; ///< cases
    std::vector<std::string> by;                     ///< depends: labels of the axes that separate, fewest first
    std::string split;                               ///< depends: "holds for ...; fails for ..."
};

/// confirmed   the decided cases all hold, and they are at least as many as the undecided ones
/// refuted     the same, but all fail
/// depends     some hold and some fail: the smallest set of axes (the ranges of frequencies are one) whose levels tell
///             them apart is named
/// untestable  too little is decided; or the test says that it cannot be tested; or every case holds though the test
///             says why that is impossible (then criterion or model is at fault, and nothing is confirmed)
/// not run     there is no case
Verdict verdict_of(const ClaimFile& file, const Test& test, const std::vector<Case>& cases);

} // namespace stylobate::claims
