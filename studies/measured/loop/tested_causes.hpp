#pragma once
/// Causes that tests of single joints shall tell apart, each at each place, weak and strong: with them specimens are
/// simulated. Sizes are in proportion to the specimen, as those of `candidate_causes.hpp`.

#include "ensemble/model/campaign.hpp"
#include "studies/measured/diagnosis/campaigns/cause_model.hpp"
#include "studies/measured/loop/signatures.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace stylobate {

struct LoopCause {
    SizedCause cause;  ///< that acts
    Cause told;        ///< the one that is told of: another where it acts in the tests as this one does
    TestedCause named; ///< as the tables have it: its size is 0 where it is neutral
    int joint = -1;    ///< in whose tests it acts, of a block that on which it stands; -1: all
    /// Second parameter, drawn anew for each specimen, uniform in its logarithm: velocity of Stribeck's law, slip at
    /// which a dowel yields. Both 0: it has none.
    double least_fixed = 0, most_fixed = 0;

    bool acts_at(int tested) const { return joint < 0 || joint == tested; }
    /// For one specimen. @param uniform in (0, 1)
    SizedCause drawn(double uniform) const;
};

/// @param joints that can be tested   @param friction of the joints
/// @param stiffness_n_m2 K_N of the joints: dashpots are in proportion to critical ones
std::vector<LoopCause> loop_causes(const Specimen& specimen, const std::vector<int>& joints, double friction,
                                   double stiffness_n_m2);

/// Under which name the loop knows a mechanism of the first diagnosis: damping in proportion to force and speed and a
/// dashpot are both "damping", for a fall from one height does not tell the two apart.
std::string loop_mechanism(const std::string& mechanism);

/// A size of the tables as the value of the cause's parameter, and in words: "dynamic_ratio = 0.72".
double parameter_of(const Cause& cause, double size);
std::string size_words(const Cause& cause, double size);

} // namespace stylobate
