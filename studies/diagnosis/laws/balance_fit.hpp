#pragma once
/// Mechanisms fitted to the samples of the laws: which one explains that the laws of the baseline do not hold?
///
/// Every mechanism changes the value of a sample by a known amount for each unit of its parameter: a joint's friction
/// by its normal force, a force on a block by that sample's coefficients. So each candidate is a linear regression,
/// with what varies from specimen to specimen anyway beside it: the common friction, each joint's own, how far inside
/// the corners the blocks turn (contacts are not rigid), each joint's own, the blocks' centres of mass.

#include "studies/diagnosis/laws/law_samples.hpp"

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
    int joint = -1;        ///< -1: all
    int block = -1;        ///< -1: all
    double fixed = 0;      ///< second parameter, from a list: velocity of Stribeck's law, gap of a dowel (of one
                           ///< that yields the slip at which it does),
                           ///< path after which friction wears no more (0: never)
    std::string side = {}; ///< of a corner: "left" or "right"
    std::string label() const { return mechanism + " at " + place + (side.empty() ? "" : " " + side); }
};

struct CauseFit {
    Cause cause;
    double size = 0; ///< in the parameter's unit
    double sd = 0;
    double gain = 0;                 ///< log posterior gained over the baseline [nats]
    std::vector<double> gain_by_run; ///< (runs)
    double gain_without_best() const;
};

/// What is taken to vary from specimen to specimen (1 sigma).
struct Scatter {
    double common_friction = 0.05; ///< relative: all joints together, against the nominal one
    double friction = 0.04;        ///< relative: each joint by itself
    double turning_point = 0.01;   ///< over the half width: how far inside its corner a joint turns, beside the common
    double common_turning = 0.05;  ///< the same, common to all
    double mass_centre = 0.004;    ///< over the half width: of each block, to one side
};

/// Everything that is fitted: the mechanisms that the balance of forces can see, at every place.
std::vector<Cause> balance_causes(const Specimen& specimen, const TrackScales& scales);

/// Forces and frictions of no mechanism in the list, for describing what stays unexplained.
struct Structure {
    int block = -1; ///< -1: friction of all joints
    std::string coordinate;
    std::string depends_on;
    std::string text;
};
struct StructureFit {
    Structure structure;
    double gain = 0;
    double size = 0, sd = 0;
    std::vector<double> gain_by_run;
};

class BalanceFit {
public:
    /// @param friction with which the samples were written
    /// @param runs number of runs in the campaign
    BalanceFit(const Specimen& specimen, std::vector<LawSample> samples, double friction, int runs,
               const Scatter& scatter = {});

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
    /// The structures of `describe`, fitted beside the causes given; most telling first.
    std::vector<StructureFit> describe(const std::vector<Cause>& given = {}) const;

private:
    struct Result {
        double size = 0, sd = 0, log_posterior = 0;
        double friction = 0, friction_sd = 0;
        std::vector<double> by_run;
        std::vector<double> residuals;
    };
    using Column = std::vector<double>;
    Column column(const Cause& cause) const;
    /// Whether a joint slides before its wear has ended, too.
    bool seen_wearing(const Cause& cause) const;
    Result regress(const std::vector<Column>& given, const Column* tried) const;

    const Specimen& specimen_;
    std::vector<LawSample> samples_;
    double friction_;
    int runs_;
    Scatter scatter_;
    Result baseline_;
};

} // namespace stylobate
