#pragma once
/// From the cases of a test to its verdict.

#include "studies/evidence/claims/criterion.hpp"

#include <array>

namespace stylobate::claims {

enum class Judgement {
    confirmed,
    refuted,
    depends,    ///< cases differ, or the margin decides, or more cases are undecided than decided
    untestable, ///< the paper leaves out what it takes, or nothing can be so
    not_run
};
const char* to_string(Judgement judgement);

/// How much an axis moves the answer: of the pairs of decided cases that differ in it alone, those with other findings.
struct Influence {
    std::string label;
    std::size_t flips = 0, pairs = 0;
};

/// At one margin.
struct MarginVerdict {
    enum class Outcome { none, holds, fails, mixed, undecided };
    Outcome outcome = Outcome::none;
    std::size_t holds = 0, fails = 0, undecided = 0; ///< cases
};
/// "holds 9, fails 3, undecided 1": without what there is none of; "no case".
std::string counts_text(const MarginVerdict& verdict);

struct Verdict {
    Judgement judgement = Judgement::not_run;
    std::array<MarginVerdict, margins.size()> at; ///< by margin
    bool by_margin = false;                       ///< depends: the outcome is another one at another margin
    bool tie = false;                             ///< depends: undecided at every margin
    std::vector<Influence> by;                    ///< depends: axes that move the answer, the strongest first
    std::string split;                            ///< depends: "holds for ...; it fails for ...", or how many do
};

/// holds, fails  at one margin: the decided cases all do, and they are at least as many as the undecided ones
/// mixed         some hold and some fail
/// undecided     more cases are undecided than decided
///
/// confirmed, refuted  holds or fails at all margins
/// untestable          the test says that it cannot be tested; or it holds though the test says why that is impossible
///                     (then criterion or model is at fault, and nothing is confirmed)
/// not run             there is no case
/// depends             all else. Axes (the ranges of frequencies are one) are ranked at the margin of 5 %. `split`
/// names
///                     the levels that tell holding from failing cases where one axis or two do.
/// @param cases (margins) of `judge`
Verdict verdict_of(const ClaimFile& file, const Test& test, const std::array<std::vector<Case>, margins.size()>& cases);

} // namespace stylobate::claims
