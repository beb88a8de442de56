#pragma once
/// What a sequence of tests of single joints has shown: from a prior and all estimates so far to shares of belief, a
/// verdict and upper limits.
///
/// The first diagnosis gives the prior and no evidence. The evidence is
///
///   E = sum over causes, places, sizes, and what is not listed, of (prior given that something acts)
///       x density of all estimates so far / their density for a healthy specimen
///
/// and multiplies from test to test given the tests before. Under the healthy density E is a martingale of mean 1, so
/// it exceeds 40 with a probability of at most 1/40, however long the tests go on (Ville, "Étude critique de la notion
/// de collectif" (1939); Grünwald, de Heide and Koolen, "Safe testing", Journal of the Royal Statistical Society B 86
/// (2024)). A cause or the word *unexplained* needs E >= 40 and 0.9 of the belief.

#include "studies/measured/diagnosis/findings/test_story.hpp"
#include "studies/measured/loop/joint_density.hpp"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// Mechanisms that one test tells from others: "friction", "corners, centres and bonds", "damping", "drag"; the
/// mechanism itself where it is in no group.
std::string cause_group(const std::string& mechanism);

/// How much the first diagnosis believes in a group, a mechanism, or a mechanism at a place.
struct PriorShare {
    std::string of;                        ///< group or mechanism
    std::optional<std::string> place = {}; ///< nullopt: every place alike
    double weight = 0;                     ///< at least 0; together at most 1, else in proportion
};

struct SequencePrior {
    double nothing = 0.5;   ///< share of a healthy specimen
    double unlisted = 0.15; ///< of the rest: what is not listed
    double least = 0.02;    ///< no mechanism has less of what is listed, and no place less of its mechanism (or half of
                            ///< an equal share, if that is less)
    std::vector<PriorShare> shares; ///< of what is listed; what they leave goes to all mechanisms alike
};

/// (causes) shares that sum to 1. @throws InputError if a share names no cause of the list, or is negative
std::vector<double> prior_of(const std::vector<CausePlace>& causes, const SequencePrior& prior);

/// One value in a column of the signatures.
struct SeenEstimate {
    Eigen::Index column = 0;
    double value = 0; ///< finite
};

/// Signatures with the prior of one sequence.
struct SequenceModel {
    SequenceModel(Signatures its_signatures, SequencePrior its_prior);

    Signatures signatures;
    Hypotheses hypotheses;
    SequencePrior prior;
    std::vector<double> causes;     ///< prior of each cause, of all
    std::vector<double> hypothesis; ///< prior of each hypothesis, of all
};

/// Shares of belief, which sum to 1.
struct Belief {
    double nothing = 0, unlisted = 0;
    std::vector<double> causes;     ///< (`Hypotheses::causes`)
    std::vector<double> hypothesis; ///< (`Hypotheses::each`)
    double log_evidence = 0;        ///< ln E
    /// In the mechanism of a cause at its place, in whatever form.
    double at_place(const Hypotheses& hypotheses, std::size_t cause) const;
    double entropy() const; ///< of nothing, the causes and what is not listed [nats]
};

/// @param log_ratios of the hypotheses, as `JointDensity::log_ratios`; empty: before the first test
Belief belief_from(const SequenceModel& model, const Eigen::VectorXd& log_ratios);
/// @param seen in the order of the tests; what is in an unused column does not count
Belief belief_of(const SequenceModel& model, std::span<const SeenEstimate> seen);

struct SequenceJudgement {
    SequenceVerdict verdict = SequenceVerdict::open;
    double log_evidence = 0;
    std::optional<CausePlace> cause; ///< that is named, or suspected most
    double share = 0;                ///< its belief
    double size = 0;                 ///< posterior mean
    double deviations = 0;           ///< of the estimates from healthy ones along its shift, in standard deviations
    bool doubtful = false; ///< between 2.5 and 6 of them and not decided: a repeat, or another test of its group
    std::vector<Eigen::Index> off; ///< unexplained: the columns that are off
};

constexpr double evidence_to_name = 40; ///< Ville: false alarms at most 1 / 40
constexpr double belief_to_name = 0.9;
constexpr double least_doubtful = 2.5, most_doubtful = 6; ///< standard deviations

SequenceJudgement judgement_of(const SequenceModel& model, std::span<const SeenEstimate> seen);

/// Sizes of a cause, given that it acts: posterior mean and equal-tailed interval, all sizes of either sign up to 1.5
/// times the strongest simulated one alike beforehand.
struct SizeInterval {
    double mean = 0, low = 0, high = 0;
};
/// @return nothing where no estimate shows the cause
std::optional<SizeInterval> size_of(const SequenceModel& model, std::span<const SeenEstimate> seen,
                                    const CausePlace& cause, double level = 0.9);

/// What is expected where a cause acts: its shift at the mean of its sizes, with the scatter of these beside its own.
/// Left to judge are the causes at other places: what the cause leaves at its own may be its law's.
SequenceModel given(const SequenceModel& model, const CausePlace& cause, const SizeInterval& sizes);

/// The largest size of a cause that the tests leave possible, for one sign of the size.
struct SizeLimit {
    CausePlace cause;
    std::string unit;
    bool below_neutral = false; ///< of sizes below 0
    std::optional<double> size; ///< 95 %; nullopt: the strongest simulated size is not excluded
    double strongest = 0;       ///< that was simulated
};

/// The limits of all causes that the tests would show, by inverting a test along the shift of each size: a size is
/// excluded where the estimates lie farther on the healthy side of it than 95 % of its specimens, and where at least
/// half of the healthy specimens would exclude it. Causes whose strongest size shifts the estimates by less than 2
/// standard deviations were not tested, and have no limit.
std::vector<SizeLimit> limits_of(const SequenceModel& model, std::span<const SeenEstimate> seen);

/// An estimate, and what was expected.
struct SeenDeviation {
    Eigen::Index column = 0;
    double value = 0;
    double expected = 0;          ///< of healthy specimens, or by the same estimate at the other joints
    double deviations = 0;        ///< from there, in standard deviations
    bool from_the_others = false; ///< expected by the other joints
};

/// How far each estimate is from healthy specimens, or from what the other measured joints let expect, whichever is
/// farther. Of three and more joints the one that is farthest off expects nothing of the others.
std::vector<SeenDeviation> deviations_of(const Signatures& signatures, std::span<const SeenEstimate> seen);

} // namespace stylobate
