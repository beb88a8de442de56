#pragma once
/// Mechanisms fitted to the samples of the laws: which one explains that the laws of the baseline do not hold?
///
/// Every mechanism changes the value of a sample by a known amount for each unit of its parameter: a joint's friction
/// by its normal force, a force on a block by that sample's coefficients. So each candidate is a linear regression,
/// with what varies from specimen to specimen anyway beside it: the common friction, each joint's own, how far inside
/// the corners the blocks turn (contacts are not rigid), each joint's own, the blocks' centres of mass.

#include "studies/measured/diagnosis/evidence/law_samples.hpp"
#include "studies/measured/diagnosis/evidence/robust_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// A cause, where it acts, and its one unknown. Names are those of study files.
struct Cause {
    std::string mechanism;
    std::string place; ///< "joint 0", "block 2", "base", "all" (joints or blocks)
    std::string parameter;
    std::string unit;
    double neutral = 0;
    int joint = -1;   ///< -1: all
    int block = -1;   ///< -1: all
    double fixed = 0; ///< second parameter, from a list: velocity of Stribeck's law, gap of a dowel (of one
                      ///< that yields the slip at which it does),
                      ///< path after which friction wears no more (0: never), of adhesion its tension over its
                      ///< force against sliding (0: it holds against sliding alone)
    std::optional<std::string> side = {}; ///< of a corner: "left" or "right"; nullopt: both, or no corner
    bool persists = false;                ///< of wear: it goes on from run to run
    friend bool operator==(const Cause&, const Cause&) = default;
    std::string label() const
    {
        return mechanism + " at " + place + (side ? " " + *side : "") + (persists ? " from run to run" : "");
    }
};

/// Whether a cause is no mechanism of the list but stands for forces of no known kind on a block (a tie to the base).
bool stands_for_unknown(const Cause& cause);

struct CauseFit {
    Cause cause;
    double size = 0; ///< in the parameter's unit
    double sd = 0;
    double gain = 0;                 ///< log posterior gained over the baseline [nats]
    std::vector<double> gain_by_run; ///< (runs)
};

/// Of a centre of mass, over the block's width: the strongest that is simulated.
inline constexpr double largest_eccentricity = 0.08;

/// Whether a fitted size is one that the mechanism can have.
bool possible(const CauseFit& fit);
/// Whether it is beyond what specimens differ by anyway.
bool matters(const CauseFit& fit);

/// What is taken to vary from specimen to specimen (1 sigma).
struct Scatter {
    double common_friction = 0.05; ///< relative: all joints together, against the nominal one
    double friction = 0.04;        ///< relative: each joint by itself
    double turning_point = 0.01;   ///< over the half width: how far inside its corner a joint turns, beside the common
    double common_turning = 0.05;  ///< turning point common to all joints: inside the corners, never outside
    double mass_centre = 0.004;    ///< over the half width: of each block, to one side
};

/// Everything that is fitted: the mechanisms that the balance of forces can see, at every place.
std::vector<Cause> balance_causes(const Specimen& specimen, const CampaignScales& scales);

/// Forces and frictions of no mechanism in the list, for describing what stays unexplained.
struct Structure {
    int block = -1; ///< -1: each block, or all joints
    std::string coordinate;
    std::string depends_on;
    std::string text;
    bool friction = false; ///< of all joints; else a force on a block, -1: on each
};
struct StructureFit {
    Structure structure;
    double gain = 0;
    double size = 0, sd = 0;
    std::vector<double> gain_by_run;
};

/// Forces and frictions that are described where no mechanism is, at every place.
std::vector<Structure> balance_structures(const Specimen& specimen);

class BalanceFit {
public:
    /// @param specimen is referred to, and must outlive this
    /// @param friction with which the samples were written
    /// @param runs number of runs in the campaign
    BalanceFit(const Specimen& specimen, std::vector<LawSample> samples, double friction, int runs,
               const Scatter& scatter = {});

    const Specimen& specimen() const { return *specimen_; }
    bool empty() const { return samples_.empty(); }
    const std::vector<LawSample>& samples() const { return samples_; }
    /// Of the baseline: mean friction over the nominal one.
    double friction_ratio() const { return 1 + baseline_.friction; }
    double friction_ratio_sd() const { return baseline_.friction_sd; }
    /// Residuals of the baseline over their scale, sample by sample.
    const std::vector<double>& residuals() const { return baseline_.residuals; }
    int samples_of(Law law, int joint) const;

    /// Fits one cause beside the baseline and the causes that are already taken as given.
    CauseFit fit(const Cause& cause, const std::vector<Cause>& given = {}) const;
    /// The structures of `balance_structures`, fitted beside the causes given; most telling first.
    std::vector<StructureFit> describe(const std::vector<Cause>& given = {}) const;

    /// Score of a cause, without fitting it: the derivative of the log posterior of the
    /// baseline for its size at the neutral one, over the root of its information (Rao's score test, Proceedings of
    /// the Cambridge Philosophical Society 44 (1948)). Of scatter about 1 where nothing acts, positive where the fitted
    /// coefficient would be. NaN: the samples do not show the cause.
    double score(const Cause& cause) const { return score_of(column(cause)); }
    double score(const Structure& structure) const { return score_of(column(structure)); }

private:
    struct Result {
        double size = 0, sd = 0, log_posterior = 0;
        double friction = 0, friction_sd = 0;
        std::vector<double> by_run;
        std::vector<double> residuals;
    };
    using Column = Eigen::VectorXd;
    Column column(const Cause& cause) const;
    Column column(const Structure& structure) const;
    /// Columns of the baseline, each of the size 1 at the most; they fill `size_` and `prior_`.
    void add_baseline_columns();
    /// Whether a joint slides before its wear has ended, too.
    bool seen_wearing(const Cause& cause) const;
    RobustFit solve(const std::vector<Column>& given, const Column* tried) const;
    Result regress(const std::vector<Column>& given, const Column* tried) const;
    Result result_of(const RobustFit& fit, const std::vector<Column>& given, const Column* tried) const;
    void prepare_scores(const RobustFit& baseline);
    double score_of(const Column& tried) const;

    const Specimen* specimen_;
    std::vector<LawSample> samples_;
    double friction_;
    int runs_;
    Scatter scatter_;
    Eigen::MatrixXd design_;           ///< (n x p) of the baseline
    std::vector<double> size_, prior_; ///< (p) of its columns; prior sd in the units before
    Result baseline_;
    // of the scores: the baseline's design without what is held at a bound, with the samples' weights
    Eigen::VectorXd weights_, weighted_residuals_; ///< (n)
    Eigen::MatrixXd weighted_design_;              ///< (n x p)
    Eigen::LDLT<Eigen::MatrixXd> normal_;          ///< (p x p)
};

} // namespace stylobate
