#pragma once
/// Evaluates a criterion on samples, case by case.

#include "studies/evidence/claims/sample.hpp"

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

} // namespace stylobate::claims
