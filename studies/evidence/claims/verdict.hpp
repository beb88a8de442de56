#pragma once
/// A criterion in each case of a test, and from the cases to the verdict.

#include "studies/evidence/claims/sample.hpp"

#include <array>

namespace stylobate::claims {

enum class Finding { holds, fails, undecided };
const char* to_string(Finding finding);

/// What the criterion came to in one variant (or one group of variants that it compares) and one range of frequencies.
struct Case {
    Levels levels; ///< of the variant; of an axis that the criterion compares along, its first level
    std::size_t range = 0;
    Finding finding = Finding::undecided;
    Estimate number;         ///< that decided; paired: the difference of the probabilities
    std::string number_text; ///< "1.82 [1.71, 2.03] m/s2 at 8 Hz"
};

/// Confidence that a case as a whole is decided rightly. Each of its m numbers gets 1 - (1 - this) / m (Bonferroni).
inline constexpr double case_level = 0.95;

/// All cases of a test: its ranges times its variants, or groups of them. Variants without a sample, or with one that
/// was not run, and ranges that no frequency of the axis lies in, are left out; so are cases of a trend or an order in
/// which nothing can be compared: one frequency alone, or every number beyond the same end of the axis.
/// Cells with too few realizations (after `given`) are skipped.
///
/// bound   holds if the interval of every number lies on the right side (`any`: of one), fails if that of one lies on
///         the wrong side (`any`: of every one); the number that decided is the worst one (`any`: the best).
/// trend   at the PGA of the axis that the window holds (an onset needs none): holds if the last frequency's number
///         differs from the first's in the right sense and no pair differs in the wrong one; fails if a pair does.
/// order   as a trend, but from the first level of the axis to the last, in every cell of the window: holds if the ends
///         differ rightly in all the cells where there is something to compare (`any`: in one, and no pair differs
///         wrongly in another), fails if a pair differs wrongly. In
///         either direction: holds if some pair differs in some cell; that nothing differs cannot be shown.
/// paired  holds if the mean difference of the probability, last level less first, lies in the right sense, fails if in
///         the wrong one; Tango's interval with equal weights of the cells (paired_difference.hpp). Of the window's
///         cells those count in which 5 to 95 % of both levels together show the event: elsewhere it is decided.
/// same    decided where at every level one way of moving is certainly the most frequent, over the cells in which
///         something moves at every level; with `given`, of the realizations to which that happened, in cells with 20
///         of them at every level.
///
/// "Differs" means that the intervals do not overlap, and lie apart by more than the margin.
///
/// @param samples one for each variant, in the order of `variants(file.axes)`
/// @throws InputError if a window holds no PGA of the axis, or a trend's window more than one
std::vector<Case> judge(const ClaimFile& file, const Test& test, const std::vector<Sample>& samples, double margin);

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
