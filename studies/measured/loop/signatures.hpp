#pragma once
/// What each test of a single joint gives: of healthy specimens the mean and the joint scatter of all estimates, of
/// each cause the shift of the mean and the additional scatter. Both are computed from tables of simulated specimens
/// that have gone through all tests; how they were simulated does not matter here.
///
/// The same body stands on every joint, so joints are compared with each other and the healthy contact law cancels.
/// Therefore the correlation of the estimates is not taken between joints but between their means over the joints, and
/// between the contrasts of the joints (`healthy_scatter`). Estimators of
/// one joint must be declared as contrasts for the same reason: the slope of friction against speed, and not the
/// friction at two speeds.

#include "ensemble/model/campaign.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// An estimator of one test at one joint: a column of the tables.
struct TestColumn {
    RunKind test = RunKind::pull;
    int joint = 0;
    std::string name; ///< of the estimator, the same at every joint
    std::string unit = {};
    std::string depends_on = {}; ///< what it varies with: "speed", "path", "place", "time", "direction"; empty: nothing
    double floor_sd = 0;         ///< reproducibility of the laboratory, anew in every repeat (1 sigma)
    bool of_the_law = false;     ///< as of `EstimatorName`
    double own_sd = 0;           ///< what one test says of its own error: the median of simulated healthy specimens
    friend bool operator==(const TestColumn&, const TestColumn&) = default;
};

/// A mechanism at a place, whatever its size.
struct CausePlace {
    std::string mechanism, place;
    std::string form = {}; ///< of several that one mechanism has at a place: a side, a law; empty: it has one
    friend bool operator==(const CausePlace&, const CausePlace&) = default;
    /// Whether it is the same mechanism at the same place, in whatever form.
    bool same_place(const CausePlace& other) const { return mechanism == other.mechanism && place == other.place; }
    std::string place_words() const { return form.empty() ? place : place + " " + form; }
    std::string label() const { return mechanism + " at " + place_words(); }
};

/// A mechanism at a place with a size, that acts in simulated specimens.
struct TestedCause {
    std::string mechanism;
    std::string place; ///< "joint 0", "block 2", "all"
    double size = 0;   ///< 0 is neutral; below 0 only where it has two signs
    std::string unit = {};
    std::string form = {}; ///< (`CausePlace`)
    CausePlace at() const { return {mechanism, place, form}; }
    friend bool operator==(const TestedCause&, const TestedCause&) = default;
};

/// Specimens in which one cause acts.
struct CauseSamples {
    TestedCause cause;
    Eigen::MatrixXd rows;        ///< (m x p) NaN: the test gave no estimate
    bool differences = false;    ///< the rows are differences from the healthy specimen of the same law
    std::vector<int> pairs = {}; ///< (m) row of `TestSamples::healthy` with the same law and specimen, without the
                                 ///< cause; empty: there are none
};

/// Simulated specimens, a row each, that have gone through all tests.
struct TestSamples {
    std::vector<TestColumn> columns; ///< (p)
    Eigen::MatrixXd healthy;         ///< (n x p) over widely varied healthy laws; NaN: the test gave no estimate
    std::vector<CauseSamples> causes;
};

/// What a cause of one size does to the estimates.
struct CauseSignature {
    TestedCause cause;
    Eigen::VectorXd shift;    ///< (p) of the mean; 0 where it is below 2 standard deviations
    Eigen::VectorXd variance; ///< (p) beside that of healthy specimens, with that of the shift itself
    /// (p x k) What of the scatter the estimates have together, in addition: its covariance is C C'. No column: not
    /// known.
    Eigen::MatrixXd common = {};
};

struct Signatures {
    std::vector<TestColumn> columns;              ///< (p)
    std::vector<bool> used;                       ///< (p) finite in at least three of four healthy specimens
    std::vector<std::vector<Eigen::Index>> alike; ///< used columns of the same estimator at all joints
    Eigen::VectorXd mean;                         ///< (p) of healthy specimens
    Eigen::MatrixXd covariance;                   ///< (p x p) of them; a repeat on the same specimen shares it
    Eigen::VectorXd floor_variance;               ///< (p) anew in every repeat; at least (5 % of the scatter)^2
    std::vector<CauseSignature> causes;
    double scale = 1; ///< factor that parts left out asked for; it is in `covariance`

    /// Standard deviation of each of these columns given the others, among healthy specimens.
    Eigen::VectorXd sd_given_others(const std::vector<Eigen::Index>& of) const;
    /// Covariance of the estimates in these columns, in this order. A column that is there twice is a repeat.
    Eigen::MatrixXd covariance_of(const std::vector<Eigen::Index>& of) const;
};

/// Mean and covariance of healthy specimens. The correlation of the means over the joints, and the one that all
/// contrasts of the joints (Helmert's) have, are 0 where they are within their noise.
/// @param rows  (n x p) NaN: missing   @param alike columns of the same estimator at all joints
std::pair<Eigen::VectorXd, Eigen::MatrixXd> healthy_scatter(const Eigen::MatrixXd& rows,
                                                            const std::vector<std::vector<Eigen::Index>>& alike);

/// The healthy specimens whose contact law is most like the measured one, by what the law gives all joints alike
/// (`TestColumn::of_the_law`): a soft or lightly damped bed scatters more than a stiff one, and would hide what acts in
/// it. Specimens with a cause keep what the cause shifts, from their healthy twin. All specimens, where no such
/// estimate was seen.
/// @param seen values in columns of `tests`
TestSamples like_measured(const TestSamples& tests, std::span<const std::pair<Eigen::Index, double>> seen,
                          std::size_t count);

/// The signatures of simulated specimens. An entry of a shift counts where it is at least 2 standard deviations of the
/// estimate given the same estimate at the other joints, and 3 standard errors of the shift. The covariance is
/// multiplied by the mean squared distance of specimens that were left out, over their number of estimates, if that is
/// above 1.
/// @pre at least 20 healthy specimens; as many columns in every table as in `columns`
/// @throws InputError if no column can be used
Signatures signatures_of(const TestSamples& tests);

} // namespace stylobate
