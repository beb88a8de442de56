#pragma once
/// A column of rigid blocks in motion. Between impacts the velocities are stepped with the points that touch (RATTLE:
/// Andersen 1983; gaps and sliding by their own differences over the step, so that nothing drifts); the time at which
/// another point meets its face is found within the step, and there the law of impact alone changes the velocities.

#include "bench/rigid_reference/contact_problem.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "ensemble/planar/limit_states.hpp"

#include <cstdint>

namespace stylobate::reference {

struct Counts {
    std::uint64_t impacts = 0, swept = 0; ///< swept: solutions for which the guess was wrong
    std::uint64_t inexact = 0;            ///< solutions whose conditions could not all be verified
    std::uint64_t crowded = 0;            ///< steps with so many impacts that the rest were taken as touching
};

class Column {
public:
    Column(Bodies bodies, Twists places, Impacts impacts);

    /// One step, in which free bodies are accelerated from outside by this much [m/s2].
    void step(double step_s, double x_m_s2, double y_m_s2);

    const Bodies& bodies() const { return bodies_; }
    const Twists& places() const { return place_; }
    const Twists& velocities() const { return velocity_; }
    void set_velocities(const Twists& velocities) { velocity_ = velocities; }
    const Counts& counts() const { return counts_; }
    /// All points that touch.
    Contacts touching() const { return points_within(place_, touching_m_); }

private:
    struct Trial {
        Twists place, velocity;
        Contacts contacts;
        double least_gap = 0; ///< of the points that did not touch
    };
    Contacts points_within(const Twists& place, double reach_m) const;
    void remember(const Contacts& contacts, double per_step);
    void guess(Contacts& contacts, double per_step) const;
    Trial attempt(const Contacts& touching, double step_s, double x_m_s2, double y_m_s2);
    void solve(Contacts& contacts, Twists& velocity, double per_step);
    void bend(const Trial& trial, double step_s, double& most_change, Contacts& contacts) const;
    double least_other_gap(const Contacts& touching, const Twists& place) const;
    double advance(double step_s, double x_m_s2, double y_m_s2, bool crowded);
    void strike_what_closes();

    Bodies bodies_;
    Twists place_, velocity_;
    Impacts impacts_;
    double touching_m_ = 1e-8;
    struct Memory {
        Grip grip = Grip::open;
        double normal = 0, along = 0; ///< impulse per time
        double bend_normal = 0, bend_along = 0;
    };
    std::vector<Memory> memory_; ///< (keys of contacts)
    Counts counts_;
};

// A realization of a study as a column of the reference: the same blocks, friction and motion of the base.

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
