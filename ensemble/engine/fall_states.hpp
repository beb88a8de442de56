#pragma once
/// Which bodies of a structure have fallen, in which order, and which epistyle has lost its seat: for every model.

#include "ensemble/model/outcome.hpp"
#include "ensemble/model/structure.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

/// Follows one realization from check to check.
///
/// A model sees at each check whether a body is too low, or has turned too far (`see`). What is too low has fallen;
/// what has turned too far has unless it comes back in time. Whether it has is decided check by check; its time is the
/// beginning of that, exact to a step: the first step after which the body was outside its limits and stayed so until
/// the check (the steps note when it was inside last, field `inside` of the bundle). Bodies that fell at the same step
/// fell together. An epistyle has lost a seat when the model says so, or when it has fallen; its time is that of the
/// check that found it. A column has fallen when one of its drums has; the collapse is total when every column that has
/// a free drum and every epistyle have fallen.
class FallStates {
public:
    /// What it knows of a body.
    struct Body {
        BlockRole role = BlockRole::drum;
        int column = 0;
        bool fixed = false;
    };

    FallStates() = default;
    /// @param fall_steps how many steps a body that has turned too far has to come back
    FallStates(std::vector<Body> bodies, std::uint64_t fall_steps);

    /// Whether a body can still fall.
    bool watches(std::size_t body) const { return !bodies_[body].fixed && fallen_since_[body] == never; }
    /// Begins a check, in which every body that it watches is seen.
    void begin_check() { undecided_ = false; }
    /// @param steps done so far
    /// @param low, turned whether the body is too low, and whether it has turned too far
    /// @param inside last of the steps 0 to `done` - 1 of the chunk after which it was inside its limits; -1: none
    /// @param done steps of the chunk
    void see(std::size_t body, std::uint64_t steps, bool low, bool turned, int inside, int done);
    /// An epistyle has lost a seat at this check.
    void unseat(std::size_t body, std::uint64_t check);
    /// Whether one that loses a seat at this check is the first, or one of the first.
    bool may_unseat(std::uint64_t check) const { return unseated_since_ >= check; }

    /// Continues the count in steps that are shorter by a factor.
    /// @param fall_steps as of the constructor
    void shorten_steps(std::uint64_t times, std::uint64_t fall_steps);

    std::uint64_t fall_steps() const { return fall_steps_; }
    bool fallen() const { return fallen_bodies_ > 0; }
    /// A body has turned too far, and may come back.
    bool undecided() const { return undecided_; }
    bool fallen(std::size_t body) const { return fallen_since_[body] != never; }
    /// Whether a body fell first, or as one of several at the same step.
    bool fell_first(std::size_t body) const;
    /// An epistyle has lost a seat.
    bool unseated() const { return unseated_since_ != never; }

    /// At the end of the realization: what has turned too far and not come back has fallen.
    void conclude();
    /// Times and counts into the outcome.
    /// @param listed the first bodies, without the ground, whose times the outcome has
    void write(double step_s, int listed, Outcome& outcome) const;

private:
    static constexpr std::uint64_t never = ~std::uint64_t{0};
    void fall(std::size_t body, std::uint64_t since);

    std::vector<Body> bodies_;
    std::uint64_t fall_steps_ = 0;
    std::vector<std::uint64_t> seen_since_;    ///< (bodies) outside since this check, or never: by it falls are decided
    std::vector<std::uint64_t> outside_since_; ///< (bodies) outside since this step, or never
    std::vector<std::uint64_t> fallen_since_;  ///< (bodies) this step
    int fallen_bodies_ = 0;
    bool undecided_ = false;
    int unseated_body_ = -1;
    std::uint64_t unseated_since_ = never;
    std::uint64_t total_since_ = never;
};

} // namespace stylobate
