#pragma once
/// One bundle at work: realizations are put into its lanes, stepped together, watched, and taken out one by one.
///
/// This is the loop, for every model. What a lane's numbers mean is the model's, a class of which each set has one:
///   Realization, HandOver              what is put in, and what goes on in another set (`Model::leaves`)
///   Measured                           what it keeps of a lane from check to check
///   Model(study, kernels, pattern, waiting)
///   scales(realization)
///   channels, motions(excitation, realization, record)   how many motions its base has, and which
///   lanes(), twice(), check_steps()    of its bundle; steps between two checks
///   clear(lane)                        an empty lane, which is at rest and does nothing
///   begin(lane, place)                 parameters and static rest of `place.realization`, scales, start of the watch
///   run(bases, places, first, last)    steps of a chunk, with the tables of the base's motion at its begin
///   read(lane, place)                  where the blocks are
///   finite, unbalanced, rests (lane, place)   parts of a check, by the templates of `watch.hpp`
///   check_limits(lane, place, done), fallen(place), conclude(place)    limit states
///   leaves(lane, place), hand_over(lane, place)
///   measure(lane, place, state, outcome)      what it measures of a realization that has ended

#include "ensemble/engine/lane_bases.hpp"
#include "ensemble/engine/watch.hpp"
#include "ensemble/model/observer.hpp"
#include "ensemble/model/outcome.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/motion/base_motion.hpp"
#include "kernels/isa.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace stylobate {

/// A lane of a set: its realization, and what is kept of it from check to check.
template <class Model>
struct LanePlace {
    bool busy = false;
    typename Model::Realization realization;
    Scales scales;
    std::array<BaseMotion, Model::channels> motions; ///< of its base; the first one is that along x
    std::optional<Outcome> outcome;
    std::optional<typename Model::HandOver> handed;
    std::uint64_t steps_before = 0, first_step = 0; ///< steps of the set that handed it over; the first one of its own
    Watch watch;
    typename Model::Measured measured;
};

/// Whole checks that a time takes, in steps; at least one.
/// @param interval steps between two checks
inline std::uint64_t whole_checks(double time_s, double step_s, int interval)
{
    const double checks = std::ceil(time_s / step_s / interval);
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(checks)) * static_cast<std::uint64_t>(interval);
}

/// A snapshot of what still moves is no residual.
inline void forget_residuals(Outcome& o)
{
    visit_fields(std::type_identity<Outcome>(), [&](const char*, auto field, const FieldFacts& facts) {
        if constexpr (std::is_same_v<decltype(field), double Outcome::*>)
            if (facts.none == std::string_view(it_still_moved))
                o.*field = std::numeric_limits<double>::quiet_NaN();
    });
}

/// Of what stood: the dominant of the two ways of moving, by the displacement that each stands for at the edge of a
/// drum.
inline State dominant_motion(const OutcomeSpec& spec, double width_m, const Outcome& o)
{
    const bool rocks = o.max_relative_rotation_rad > spec.rocking_threshold_rad;
    const bool slides = o.total_sliding_m > spec.sliding_threshold * width_m;
    if (rocks && (!slides || o.total_rocking_rad * width_m >= o.total_sliding_m))
        return State::rocked;
    return slides ? State::slid : State::stood;
}

/// What is done to a realization is a function of it alone: whether it is looked at, ended or set aside depends on the
/// number of its own steps, never on its lane or on its neighbours.
template <class Model>
class LaneSetOf {
public:
    using Realization = typename Model::Realization;
    using Place = LanePlace<Model>;

    /// @param record may be null unless the excitation is one
    /// @param waiting realizations that are to be put in: where they do not fit into one register, and the structure is
    ///        so small that two registers at a time are faster, there are twice as many lanes
    /// @throws std::invalid_argument if the study asks for single precision and the pattern for more than the paper's
    ///         model
    LaneSetOf(const Study& study, const Motion* record, const KernelTable& kernels, const Realization& pattern,
              std::uint64_t waiting = 1)
        : study_(study), record_(record), model_(study, kernels, pattern, waiting),
          bases_(study, kernels, Model::channels, model_.lanes(), model_.twice()),
          places_(static_cast<std::size_t>(model_.lanes()))
    {
        for (int lane = 0; lane < lanes(); ++lane)
            clear(lane);
    }

    int lanes() const { return static_cast<int>(places_.size()); }
    int active() const { return active_; }
    bool free(int lane) const { return !place(lane).busy; }
    const Realization& realization(int lane) const { return place(lane).realization; }
    /// Of its base, along x.
    const BaseMotion& motion(int lane) const { return place(lane).motions.front(); }
    std::uint64_t steps(int lane) const { return place(lane).watch.steps; }

    /// Puts a realization into a free lane, at its static rest.
    void load(int lane, Realization realization)
    {
        Place& of = occupy(lane, std::move(realization));
        start_watch(of);
        model_.begin(lane, of);
    }

    /// Steps all lanes by one chunk and checks each; `outcome(lane)` then shows which have ended.
    void advance() { advance(0, chunk_steps); }
    /// Part of a chunk, for trajectories: steps `first` to `last - 1`; the check comes with the chunk's last step.
    void advance(int first, int last)
    {
        const int interval = model_.check_steps();
        for (int done = first; done < last;) {
            const int from = done;
            done = std::min(last, (from / interval + 1) * interval);
            model_.run(bases_, places_, from, done);
            if (done % interval == 0)
                for (int lane = 0; lane < lanes(); ++lane)
                    if (!free(lane) && !this->done(lane))
                        check(lane, done);
        }
    }

    /// The outcome of a realization that has ended.
    const std::optional<Outcome>& outcome(int lane) const { return place(lane).outcome; }
    /// What goes on in another set: of a realization that this one cannot step to its end.
    const std::optional<typename Model::HandOver>& handed(int lane) const { return place(lane).handed; }
    /// Whether this set has done with a realization: it has ended, or is handed over.
    bool done(int lane) const { return outcome(lane) || handed(lane); }
    /// Frees a lane; its place is at rest and does nothing until the next `load`.
    void clear(int lane)
    {
        Place& of = place(lane);
        if (of.busy)
            --active_;
        of = Place{};
        bases_.clear(lane);
        model_.clear(lane);
    }

    /// Of the realizations at work, the one that is furthest in simulated time.
    SimulatedTime furthest() const
    {
        SimulatedTime furthest;
        for (const Place& of : places_) {
            const double reached = static_cast<double>(of.watch.steps) * of.watch.step_s;
            if (of.busy && reached > furthest.reached_s)
                furthest = {reached, static_cast<double>(of.watch.last_step) * of.watch.step_s};
        }
        return furthest;
    }
    /// Where the blocks are now, in the frame of the base.
    auto snapshot(int lane) const { return model_.snapshot(lane, place(lane)); }

    // ---- the state, for what steps or moves lanes in other ways: tracking, devices, a hand-over ----

    Model& model() { return model_; }
    const Model& model() const { return model_; }
    LaneBases& bases() { return bases_; }
    const LaneBases& bases() const { return bases_; }
    Place& place(int lane) { return places_[static_cast<std::size_t>(lane)]; }
    const Place& place(int lane) const { return places_[static_cast<std::size_t>(lane)]; }
    std::vector<Place>& places() { return places_; }

    /// A free lane becomes that of a realization, with its base motion; its state is still to be written.
    Place& occupy(int lane, Realization realization)
    {
        clear(lane);
        Place& of = place(lane);
        of.busy = true;
        ++active_;
        of.realization = std::move(realization);
        of.motions = Model::motions(study_.excitation, of.realization, record_);
        bases_.store(lane, of.motions);
        return of;
    }

    /// Takes what is kept of a lane out of it, which is then free.
    Place take(int lane)
    {
        Place taken = std::move(place(lane));
        place(lane).busy = taken.busy;
        clear(lane);
        return taken;
    }
    /// Puts it into a free lane, of this set or of another one; the state of the blocks is still to be written.
    void put(int lane, Place taken)
    {
        active_ += taken.busy;
        place(lane) = std::move(taken);
    }

    /// The check after `done` steps of a chunk: not finite? fallen? energy out of balance? at rest, or out of time?
    void check(int lane, int done)
    {
        Place& of = place(lane);
        Watch& w = of.watch;
        w.steps += static_cast<std::uint64_t>(model_.check_steps());
        bases_.first_step(lane) = static_cast<double>(w.steps);

        model_.read(lane, of);
        if (!model_.finite(lane))
            return end(lane, State::invalid, InvalidReason::not_finite);
        model_.check_limits(lane, of, done);
        if (model_.fallen(of) && study_.outcome.follow == Follow::collapse)
            return end(lane, State::collapsed, InvalidReason::none);
        if (model_.leaves(lane, of)) {
            of.handed = model_.hand_over(lane, of);
            return;
        }
        if (model_.unbalanced(lane, of))
            return end(lane, State::invalid, InvalidReason::energy);
        if (model_.rests(lane, of)) {
            model_.conclude(of);
            end(lane, model_.fallen(of) ? State::collapsed : State::stood, InvalidReason::none);
        }
    }

private:
    /// What all models watch alike.
    void start_watch(Place& of) const
    {
        const Realization& r = of.realization;
        of.scales = Model::scales(r);
        const bool shaken = study_.excitation.kind != ExcitationKind::none;
        const int interval = model_.check_steps();
        double end_s = 0;
        for (const BaseMotion& motion : of.motions)
            end_s = std::max(end_s, motion.duration_s());
        Watch& w = of.watch;
        w.step_s = r.step_s;
        w.shaking_end_s = shaken ? end_s : 0;
        w.barrier_j = of.scales.barrier_j;
        w.rest_energy_j = rest_energy * of.scales.barrier_j;
        w.rest_slip_m = rest_slip * of.scales.width_m * of.scales.p_rad_s * interval * r.step_s;
        w.may_rest = shaken;
        w.last_step = whole_checks(end_s + tail_s(study_.excitation, of.scales), r.step_s, interval);
        w.rest_steps = whole_checks(rest_time / of.scales.p_rad_s, r.step_s, interval);
    }

    void end(int lane, State state, InvalidReason reason)
    {
        Place& of = place(lane);
        const Watch& w = of.watch;
        Outcome o;
        o.step_s = w.step_s;
        o.steps = of.steps_before + (w.steps - of.first_step);
        o.end_time_s = static_cast<double>(w.steps) * w.step_s;
        o.at_rest = at_rest(w) ? 1 : 0;
        const EnergyBalance balance = model_.balance(lane, of);
        o.energy_kinetic_j = balance.kinetic;
        o.energy_potential_j = balance.potential;
        o.energy_spring_j = balance.spring;
        o.energy_friction_j = balance.friction;
        o.energy_damping_j = balance.damping;
        o.energy_base_work_j = balance.base_work;
        o.energy_residual = balance.residual;
        if (state != State::invalid && !(std::fabs(o.energy_residual) < energy_bound)) {
            state = State::invalid;
            reason = InvalidReason::energy;
        }
        if (state == State::invalid)
            o.at_rest = 0;
        model_.measure(lane, of, state, o);
        leave_out_other_models(o, study_.structure.dimensions);
        o.state = state == State::stood ? model_.motion_of(of, o) : state;
        o.invalid_reason = reason;
        of.outcome = o;
    }

    const Study& study_;
    const Motion* record_;
    Model model_;
    LaneBases bases_;
    std::vector<Place> places_;
    int active_ = 0;
};

} // namespace stylobate
