#pragma once
/// Steps what sets of the rigid form hand over, with contacts that yield, to its end: a register at a time.

#include "ensemble/planar/planar_model.hpp"

#include <vector>

namespace stylobate {

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
