#pragma once
/// What of a structure has fallen, in which order, and which epistyle has lost its seat.

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

/// Follows one realization from check to check.
///
/// A block has fallen when its centre is below `OutcomeSpec::collapse_height_fraction` of its rest height above the
/// base; or when it has turned beyond its own slenderness angle atan(b / h) and does not come back in time. Whether it
/// has is decided check by check; its time is the beginning of that, exact to a step: the first step after which the
/// block was outside and stayed so until the check (the steps note when it was inside last, `OfBlock::inside`). Blocks
/// that fell at the same step fell together. An epistyle has lost a seat when its bottom face no longer reaches over
/// the top face of a block on which it lay (or when it has fallen); its time is that of the check that found it. A
/// column has fallen when one of its drums has; the collapse is total when every column that has a free drum and every
/// epistyle have fallen.
class LimitStates {
public:
    LimitStates() = default;
    /// @param base_top_m what rest heights are counted from
    /// @param fall_steps how many steps a block that has turned too far has to come back
    LimitStates(const Realization& realization, const OutcomeSpec& outcome, double base_top_m,
                std::uint64_t fall_steps);

    /// @param steps done so far
    /// @param moved (blocks) in the order of `Realization::blocks`
    /// @param inside (blocks) last of the steps 0 to `done` - 1 of the chunk after which it was inside; -1: none
    /// @param done steps of the chunk
    void check(const Realization& realization, std::uint64_t steps, const std::vector<BlockMotion>& moved,
               const std::vector<int>& inside, int done);

    /// Continues the count in steps that are shorter by a factor.
    /// @param fall_steps as of the constructor
    void shorten_steps(std::uint64_t times, std::uint64_t fall_steps);

    std::uint64_t fall_steps() const { return fall_steps_; }
    bool fallen() const { return fallen_blocks_ > 0; }
    /// A block has turned too far, and may come back.
    bool undecided() const { return undecided_; }
    bool fallen(std::size_t block) const { return fallen_since_[block] != never; }
    /// An epistyle has lost a seat.
    bool unseated() const { return unseated_since_ != never; }
    double turn_limit_rad(std::size_t block) const { return turn_limit_rad_[block]; }
    /// How far down a block's centre may be, from its place in the reference stack [m].
    double lowest_m(const Block& block) const { return (height_fraction_ - 1) * (block.y_m - base_top_m_); }

    /// At the end of the realization: what has turned too far and not come back has fallen.
    void conclude(const Realization& realization);
    /// Times and counts into the outcome.
    void write(const Realization& realization, Outcome& outcome) const;

private:
    static constexpr std::uint64_t never = ~std::uint64_t{0};
    void fall(const Realization& realization, std::size_t block, std::uint64_t since);
    void unseat(std::size_t block, std::uint64_t check);

    double height_fraction_ = 0;
    double base_top_m_ = 0;
    std::uint64_t fall_steps_ = 0;
    std::vector<double> turn_limit_rad_;      ///< (blocks)
    std::vector<std::uint64_t> seen_since_;   ///< (blocks) outside since this check, or never: by it falls are decided
    std::vector<std::uint64_t> turned_since_; ///< (blocks) outside since this step, or never
    std::vector<std::uint64_t> fallen_since_; ///< (blocks) this step
    int fallen_blocks_ = 0;
    bool undecided_ = false;
    int unseated_block_ = -1;
    std::uint64_t unseated_since_ = never;
    std::uint64_t total_since_ = never;
};

} // namespace stylobate
