#pragma once
/// A realization of a study as a column of the reference: the same blocks, friction and motion of the base.

#include "bench/rigid_reference/column.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "ensemble/planar/limit_states.hpp"

namespace stylobate::reference {

/// One realization on its way.
class Draw {
public:
    /// @param study of the realization
    Draw(const Study& study, Realization realization, const Impacts& impacts, double step_s);

    void step();
    double time_s() const { return steps_ * step_s_; }
    bool over() const { return fallen() || time_s() >= end_s_; }
    bool fallen() const { return limits_.fallen(); }
    const Column& column() const { return column_; }
    const Realization& realization() const { return realization_; }
    /// Displacements from the places at rest.
    const std::vector<BlockMotion>& moved() const { return moved_; }
    /// At the end: what has turned too far has fallen.
    bool conclude();

private:
    double base_acceleration(int step) const;

    Realization realization_;
    double step_s_;
    BaseMotion base_;
    double end_s_;
    Column column_;
    Twists start_;
    LimitStates limits_;
    std::vector<BlockMotion> moved_;
    std::vector<int> inside_;
    int steps_ = 0;
};

} // namespace stylobate::reference
