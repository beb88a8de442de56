#pragma once
/// What of a planar structure has fallen, in which order, and which epistyle has lost its seat.

#include "ensemble/engine/fall_states.hpp"
#include "ensemble/model/outcome.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/realization/realization.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

/// Displacement of a block from its place in the reference stack, in the frame of the base.
struct BlockMotion {
    double x_m = 0;
    double y_m = 0;
    double theta_rad = 0;
};

/// Where the middle of the upper block's bottom face lies along the lower block's top face, from its middle [m].
double face_offset(const Block& lower, const BlockMotion& lower_moved, const Block& upper,
                   const BlockMotion& upper_moved);

/// A block is too low when its centre is below `OutcomeSpec::collapse_height_fraction` of its rest height above the
/// base; it has turned too far beyond its own slenderness angle atan(b / h). An epistyle has lost a seat when its
/// bottom face no longer reaches over the top face of a block on which it lay.
class LimitStates : public FallStates {
public:
    LimitStates() = default;
    /// @param base_top_m what rest heights are counted from
    /// @param fall_steps as of `FallStates`
    LimitStates(const Realization& realization, const OutcomeSpec& outcome, double base_top_m,
                std::uint64_t fall_steps);

    /// @param steps done so far
    /// @param moved (blocks) in the order of `Realization::blocks`
    /// @param inside (blocks) and `done` as of `FallStates::see`
    void check(const Realization& realization, std::uint64_t steps, const std::vector<BlockMotion>& moved,
               const std::vector<int>& inside, int done);

    double turn_limit_rad(std::size_t block) const { return turn_limit_rad_[block]; }
    /// How far down a block's centre may be, from its place in the reference stack [m].
    double lowest_m(const Block& block) const { return (height_fraction_ - 1) * (block.y_m - base_top_m_); }

private:
    double height_fraction_ = 0;
    double base_top_m_ = 0;
    std::vector<double> turn_limit_rad_; ///< (blocks)
};

} // namespace stylobate
