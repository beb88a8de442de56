#pragma once
/// The mechanisms of a study, written into a realization.

#include "ensemble/model/nominal.hpp"
#include "ensemble/realization/realization.hpp"

#include <vector>

namespace stylobate {

class MechanismBuilder {
public:
    /// @param layout of the study's structure
    MechanismBuilder(const Study& study, const Layout& layout);

    const std::vector<ActingMechanism>& acting() const { return acting_; }

    /// Offset of a block from its place [m].
    double offset_m(const RealizationValues& values, std::size_t block) const;

    /// Writes everything else into a realization whose blocks and joints exist.
    /// @throws InputError if the drawn structure cannot be built: a face that is lost as a whole, a centre of mass
    ///                    outside its block, values that contradict each other
    void apply(const RealizationValues& values, Realization& realization) const;

private:
    std::vector<ActingMechanism> acting_;
    double friction_; ///< of [contact]
    double depth_m_;  ///< of all blocks
    ContactForm form_;
    bool damped_at_ends_; ///< by the study, where the contact form leaves the choice
    bool with_mechanisms_ = false;
    bool strengthened_ = false;
    std::vector<int> right_; ///< (blocks) the neighbour at the right; -1: none
};

} // namespace stylobate
