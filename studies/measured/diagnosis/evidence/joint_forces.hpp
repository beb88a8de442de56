#pragma once
/// The joints by Newton's law at intervals of 0.08 sqrt(height / g): the work of friction, and the
/// moment about the corner on which a joint rocks, with what drag and eccentricities would make of it.
///
/// A joint's force follows from the accelerations of the blocks that it carries, where each block stands on one other
/// (a column). In a colonnade it does not.

#include "studies/measured/diagnosis/evidence/joint_sums.hpp"

#include <vector>

namespace stylobate {

/// (n_joint) the blocks that each joint carries; empty where a block stands on several others.
std::vector<std::vector<int>> carried_blocks(const Specimen& specimen);

/// A joint that rocks, at one time.
struct RockingSample {
    double value = 0;                  ///< sign x moment about the corner over weight x half width: 0 under the law
    double normal = 0;                 ///< normal force over the weight: what a turning point inside its corner adds
    double drag = 0, eccentricity = 0; ///< what a unit of each adds, the same of all blocks that are carried
};

class JointForces {
public:
    /// @pre carried_blocks(specimen) is not empty
    explicit JointForces(const Specimen& specimen);

    /// Adds the work of friction of a joint in a run to its sums, and its rocking samples to those it has.
    /// @param open_rad beyond which the joint is open
    void add(std::size_t joint, const JointFaces& faces, const JointSeries& series, const CoarseRun& run,
             double open_rad, JointSums& sums);

    /// Scores of drag and of eccentricity at each joint, one at a time beside its turning point: with the column c of
    /// what all carried blocks would add and robust residuals r of scale s, sum c r / (s sqrt(sum c^2)). Without an
    /// effect the mean is 0. A cause in a block shows at the joint under it and at those below, and not at those
    /// above: that is its place. NaN: fewer than 10 samples.
    /// @return (2 n_joint) drag at all joints, then eccentricity
    std::vector<double> scores() const;

private:
    Specimen specimen_;
    std::vector<std::vector<int>> above_;
    std::vector<double> weight_n_;                    ///< (n_joint)
    std::vector<std::vector<RockingSample>> samples_; ///< (n_joint)
};

} // namespace stylobate
