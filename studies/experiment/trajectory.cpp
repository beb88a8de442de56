#include "studies/experiment/trajectory.hpp"

#include "ensemble/engine/drive.hpp"
#include "ensemble/planar/hand_over.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/replicas/replicas.hpp"
#include "ensemble/spatial/spatial_model.hpp"
#include "studies/experiment/loaded_study.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>

namespace stylobate {

namespace {

/// Samples between two snapshots, one step apart.
template <class Model>
class Recorder {
public:
    Recorder(Trajectory& trajectory, const typename Model::Place& place, double rate_hz)
        : trajectory_(trajectory), place_(place), rate_hz_(rate_hz), step_s_(place.realization.step_s)
    {
    }

    double next_time() const { return static_cast<double>(trajectory_.time_s.size()) / rate_hz_; }
    /// Whether the stretch that ends at step n + 1 has a sample.
    bool due(std::uint64_t n) const { return next_time() <= static_cast<double>(n + 1) * step_s_; }
    /// The first step from n on whose stretch has one.
    std::uint64_t next_due(std::uint64_t n) const
    {
        n = std::max(n, static_cast<std::uint64_t>(std::max(next_time() / step_s_ - 2, 0.0)));
        while (!due(n))
            ++n;
        return n;
    }

    template <class Snapshot>
    void sample(std::uint64_t n, const Snapshot& before, const Snapshot& after)
    {
        while (due(n)) {
            const double time = next_time();
            const double share = time / step_s_ - static_cast<double>(n);
            std::size_t pose = 0, base = 0;
            const auto base_place = Model::base_place(place_, time);
            for (std::size_t c = 0; c < trajectory_.channels.size(); ++c) {
                if (trajectory_.channels[c].of == ListOf::times)
                    trajectory_.lists[c].push_back(base_place[base++]);
                if (trajectory_.channels[c].of != ListOf::poses)
                    continue;
                const std::vector<double>&a = before.pose(pose), &b = after.pose(pose);
                for (std::size_t i = 0; i < trajectory_.blocks(); ++i)
                    trajectory_.lists[c].push_back(a[i] + share * (b[i] - a[i]));
                ++pose;
            }
            trajectory_.time_s.push_back(time);
        }
    }

private:
    Trajectory& trajectory_;
    const typename Model::Place& place_;
    const double rate_hz_, step_s_;
};

/// Realizations in the lanes of a bundle, each with its trajectory if it is recorded.
template <class Model>
class TracedLanes {
public:
    TracedLanes(const Experiment& experiment, const Study& stepped, Isa isa, const Realization& pattern,
                std::uint64_t waiting)
        : experiment_(experiment), stepped_(stepped), isa_(isa),
          lanes_(stepped, experiment.record(), kernels(isa), pattern, waiting),
          places_(static_cast<std::size_t>(lanes_.lanes()))
    {
    }

    int lanes() const { return lanes_.lanes(); }
    int active() const { return lanes_.active(); }
    SimulatedTime furthest() const { return lanes_.furthest(); }

    void load(int lane, Realization realization, bool record)
    {
        Trajectory trajectory;
        if (record)
            trajectory = Model::trajectory_of(realization, block_names(experiment_.study()));
        lanes_.load(lane, std::move(realization));
        begin_trace(lane, std::move(trajectory), record);
    }

    /// A chunk, from sample to sample of any of them: where the steps are parted changes no bit.
    void advance()
    {
        for (int k = 0; k < chunk_steps;) {
            int until = chunk_steps - k;
            for (int lane = 0; lane < lanes(); ++lane)
                until = std::min(until, steps_to_sample(lane, k));
            lanes_.advance(k, k + until);
            k += until;
            for (int lane = 0; lane < lanes(); ++lane) {
                Place& place = places_[static_cast<std::size_t>(lane)];
                if (place.due)
                    place.recorder->sample(place.steps + static_cast<std::uint64_t>(k - 1), place.before,
                                           lanes_.snapshot(lane));
            }
        }
        for (Place& place : places_)
            place.steps += chunk_steps;
    }

    bool free(int lane) const { return lanes_.free(lane); }
    bool done(int lane) const { return lanes_.done(lane); }
    /// Frees the lane of one that has ended. One that is handed over is followed to its end before.
    /// @param go_on asked meanwhile; false: stop
    /// @return nothing if it was stopped
    std::optional<TracedRealization> take(int lane, const std::function<bool()>& go_on)
    {
        Place& place = places_[static_cast<std::size_t>(lane)];
        TracedRealization followed{lanes_.realization(lane), {}, std::move(place.trajectory)};
        if (lanes_.outcome(lane))
            followed.outcome = *lanes_.outcome(lane);
        else if (!follow_handed(lane, followed, go_on))
            return std::nullopt;
        place.recorder.reset();
        lanes_.clear(lane);
        return followed;
    }

    /// The one in the first lane alone. @return nothing if `go_on`, asked every 1024 steps, returned false
    std::optional<TracedRealization> to_end(const std::function<bool()>& go_on)
    {
        constexpr int chunks_between_questions = 1024 / chunk_steps;
        for (int chunk = 0; !done(0); ++chunk) {
            if (chunk % chunks_between_questions == 0 && !go_on())
                return std::nullopt;
            advance();
        }
        return take(0, go_on);
    }

private:
    /// Follows what is handed over to its end. @return false if it was stopped
    bool follow_handed(int lane, TracedRealization& followed, const std::function<bool()>& go_on)
    {
        if constexpr (std::is_same_v<Model, PlanarModel>) {
            const HandOver& handed = *lanes_.handed(lane);
            TracedLanes taker(experiment_, stepped_, isa_, compliant_form(handed.realization), 1);
            take_over(taker.lanes_, 0, handed);
            taker.begin_trace(0, std::move(followed.trajectory),
                              places_[static_cast<std::size_t>(lane)].recorder.has_value());
            std::optional<TracedRealization> rest = taker.to_end(go_on);
            if (!rest)
                return false;
            followed.outcome = std::move(rest->outcome);
            followed.trajectory = std::move(rest->trajectory);
        }
        return true;
    }

    struct Place {
        Trajectory trajectory;
        std::optional<Recorder<Model>> recorder; ///< of the trajectory, if it is recorded
        std::uint64_t steps = 0;                 ///< of the realization, before this chunk
        bool due = false;                        ///< the next step has a sample
        decltype(std::declval<Model>().snapshot(0, std::declval<typename Model::Place>())) before; ///< and begins here
    };

    /// Follows what has just been loaded.
    void begin_trace(int lane, Trajectory trajectory, bool record)
    {
        Place& place = places_[static_cast<std::size_t>(lane)];
        place.steps = lanes_.steps(lane);
        place.trajectory = std::move(trajectory);
        place.recorder.reset();
        if (record)
            place.recorder.emplace(place.trajectory, lanes_.place(lane), experiment_.study().output.trajectory_rate_hz);
    }

    /// How many steps may be done at once after the first `k` of the chunk: up to the step that has a sample, or that
    /// one alone, for which the snapshot before it is taken.
    int steps_to_sample(int lane, int k)
    {
        Place& place = places_[static_cast<std::size_t>(lane)];
        place.due = false;
        if (!place.recorder || lanes_.done(lane))
            return chunk_steps;
        const std::uint64_t now = place.steps + static_cast<std::uint64_t>(k);
        if (const std::uint64_t wait = place.recorder->next_due(now) - now; wait > 0)
            return static_cast<int>(std::min<std::uint64_t>(wait, chunk_steps));
        place.due = true;
        place.before = lanes_.snapshot(lane);
        return 1;
    }

    const Experiment& experiment_;
    const Study& stepped_;
    const Isa isa_;
    LaneSetOf<Model> lanes_;
    std::vector<Place> places_;
};

template <class Model>
TracedRealization trace_in(const Experiment& experiment, const Realization& r, Isa isa,
                           const std::function<bool()>& go_on)
{
    const Study stepped = stepped_as(experiment.study(), r.index);
    TracedLanes<Model> lanes(experiment, stepped, isa, r, 1);
    lanes.load(0, r, true);
    std::optional<TracedRealization> followed = lanes.to_end([&] { return !go_on || go_on(); });
    if (!followed)
        throw TraceStopped();
    return std::move(*followed);
}

template <class Model>
bool trace_all_in(const Experiment& experiment, const RunOptions& options, const TracePlan& plan)
{
    const Sampler& sampler = experiment.sampler();
    const std::uint64_t count = plan.indices.size();
    const Realization pattern = sampler.realization(plan.indices[0]);
    Observer nobody;
    Crew crew(nobody); // its mutex guards the plan's functions and what follows
    std::atomic<std::size_t> next = 0;
    std::map<std::size_t, TracedRealization> ended;
    std::size_t delivered = 0;
    crew.run(options.threads, [&] {
        TracedLanes<Model> lanes(experiment, experiment.study(), options.isa, pattern,
                                 count / static_cast<std::uint64_t>(options.threads));
        std::vector<std::size_t> number(static_cast<std::size_t>(lanes.lanes()));
        const auto go_on = [&] {
            const std::unique_lock lock(crew.mutex(), std::try_to_lock);
            if (lock.owns_lock() && plan.stop &&
                plan.stop(static_cast<double>(lanes.active()) / lanes.lanes(), lanes.furthest()))
                crew.stop();
            return !crew.stopped();
        };
        const auto source = [&](int lane) {
            const std::size_t at = next++;
            if (at >= count)
                return false;
            number[static_cast<std::size_t>(lane)] = at;
            lanes.load(lane, sampler.realization(plan.indices[at]), plan.indices[at] < plan.recorded);
            return true;
        };
        const auto sink = [&](int lane) {
            auto followed = lanes.take(lane, go_on);
            if (!followed)
                return;
            const std::lock_guard lock(crew.mutex());
            ended.emplace(number[static_cast<std::size_t>(lane)], std::move(*followed));
            for (; !ended.empty() && ended.begin()->first == delivered; ++delivered) {
                plan.sink(std::move(ended.begin()->second));
                ended.erase(ended.begin());
            }
        };
        drive(lanes, source, sink, [&](int, bool) { return go_on(); });
    });
    for (auto& [at, followed] : ended) // those that wait for one that was stopped
        plan.sink(std::move(followed));
    return delivered + ended.size() == count;
}

} // namespace

TracedRealization trace(const Experiment& experiment, std::uint64_t index, Isa isa, const std::function<bool()>& go_on)
{
    const Realization r = experiment.sampler().realization(index);
    return r.spatial() ? trace_in<SpatialModel>(experiment, r, isa, go_on)
                       : trace_in<PlanarModel>(experiment, r, isa, go_on);
}

bool trace_all(const Experiment& experiment, const RunOptions& options, const TracePlan& plan)
{
    if (plan.indices.empty())
        return true;
    return experiment.study().structure.spatial() ? trace_all_in<SpatialModel>(experiment, options, plan)
                                                  : trace_all_in<PlanarModel>(experiment, options, plan);
}

ResultRow result_row(const Study& study, const RealizationHeader& realization, const Outcome& outcome)
{
    ResultRow row;
    row.index = realization.index;
    row.cell = study.cell(realization.index);
    row.frequency_hz = realization.frequency_hz;
    row.pga_m_s2 = realization.pga_m_s2;
    row.inputs = realization.inputs;
    row.outcome = outcome;
    return row;
}

} // namespace stylobate
