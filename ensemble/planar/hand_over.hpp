#pragma once
/// How a realization goes from rigid contacts to contacts that yield, once its blocks meet otherwise than at beds.

#include "ensemble/planar/planar_model.hpp"

#include <vector>

namespace stylobate {

/// A rigid realization with its structure and motion, but with contacts by area, as stiff as rigid blocks ask for and
/// nearly plastic: the load of the bed that carries most sinks in by 1e-4 of the smallest half size of a free block,
/// the tangential stiffness is half the normal one of the face, both damping ratios are 0.5 (a flat impact keeps 0.16
/// of its velocity), and dashpots are in proportion to the length of the contact. The step is a part of the rigid one,
/// 1 / n with n even, and at most the usual part of the safe bound.
///
/// @pre contacts are rigid, and there is a step
Realization compliant_form(const Realization& rigid);

/// Puts a realization into a free lane that a set of the rigid form has handed over.
/// @param set made from the `compliant_form` of that set's pattern
void take_over(LaneSet& set, int lane, const HandOver& handed);

/// Steps what sets of the rigid form hand over, with contacts that yield, to its end: a register at a time.
class CompliantSet {
public:
    /// @param pattern of the set that hands over; other arguments as those of `LaneSet`
    CompliantSet(const Study& study, const Motion* record, const KernelTable& kernels, const Realization& pattern);

    void take(const HandOver& handed) { waiting_.push_back(handed); }
    /// Whether a register can be filled.
    bool full() const { return set_.active() + waiting() >= set_.lanes(); }
    bool empty() const { return set_.active() + waiting() == 0; }

    /// Fills free lanes, and steps all by one chunk.
    /// @param ended called with the realization and the outcome of each that has ended
    template <class Ended>
    void advance(const Ended& ended)
    {
        fill();
        set_.advance();
        for (int lane = 0; lane < set_.lanes(); ++lane)
            if (!set_.free(lane) && set_.outcome(lane)) {
                ended(set_.realization(lane), *set_.outcome(lane));
                set_.clear(lane);
            }
    }
    int lanes() const { return set_.lanes(); }
    int active() const { return set_.active(); }

private:
    int waiting() const { return static_cast<int>(waiting_.size()); }
    void fill();

    const Realization pattern_;
    LaneSet set_;
    std::vector<HandOver> waiting_;
};

} // namespace stylobate
