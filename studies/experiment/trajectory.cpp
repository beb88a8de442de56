#include "studies/experiment/trajectory.hpp"

#include "ensemble/engine/drive.hpp"
#include "ensemble/planar/hand_over.hpp"
#include "ensemble/replicas/replicas.hpp"
#include "studies/experiment/loaded_study.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace stylobate {

namespace {

/// Samples between two snapshots, one step apart.
class Recorder {
public:
    Recorder(Trajectory& trajectory, const BaseMotion& motion, double rate_hz, double step_s)
        : trajectory_(trajectory), motion_(motion), rate_hz_(rate_hz), step_s_(step_s)
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

    void sample(std::uint64_t n, const Snapshot& before, const Snapshot& after)
    {
        while (due(n)) {
            const double time = next_time();
            const double share = time / step_s_ - static_cast<double>(n);
            std::size_t pose = 0;
            for (std::size_t c = 0; c < trajectory_.channels.size(); ++c) {
                if (trajectory_.channels[c].of != ListOf::poses)
                    continue;
                const std::vector<double>&a = before.pose(pose), &b = after.pose(pose);
                for (std::size_t i = 0; i < trajectory_.blocks(); ++i)
                    trajectory_.lists[c].push_back(a[i] + share * (b[i] - a[i]));
                ++pose;
            }
            trajectory_["base_x_m"].push_back(motion_.displacement_m(time));
            trajectory_.time_s.push_back(time);
        }
    }

private:
    Trajectory& trajectory_;
    const BaseMotion& motion_;
    const double rate_hz_, step_s_;
};

/// Realizations in the lanes of a bundle, each with its trajectory if it is recorded.
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
            trajectory = PlanarModel::trajectory_of(realization, block_names(experiment_.study()));
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
        if (const std::optional<HandOver>& handed = lanes_.handed(lane)) {
            TracedLanes taker(experiment_, stepped_, isa_, compliant_form(handed->realization), 1);
            take_over(taker.lanes_, 0, *handed);
            taker.begin_trace(0, std::move(followed.trajectory), place.recorder.has_value());
            std::optional<TracedRealization> rest = taker.to_end(go_on);
            if (!rest)
                return std::nullopt;
            followed.outcome = std::move(rest->outcome);
            followed.trajectory = std::move(rest->trajectory);
        } else {
            followed.outcome = *lanes_.outcome(lane);
        }
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
    struct Place {
        Trajectory trajectory;
        std::optional<Recorder> recorder; ///< of the trajectory, if it is recorded
        std::uint64_t steps = 0;          ///< of the realization, before this chunk
        bool due = false;                 ///< the next step has a sample
        Snapshot before;                  ///< and begins here
    };

    /// Follows what has just been loaded.
    void begin_trace(int lane, Trajectory trajectory, bool record)
    {
        Place& place = places_[static_cast<std::size_t>(lane)];
        place.steps = lanes_.steps(lane);
        place.trajectory = std::move(trajectory);
        place.recorder.reset();
        if (record)
            place.recorder.emplace(place.trajectory, lanes_.motion(lane), experiment_.study().output.trajectory_rate_hz,
                                   lanes_.realization(lane).step_s);
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
    LaneSet lanes_;
    std::vector<Place> places_;
};

} // namespace

TracedRealization trace(const Experiment& experiment, std::uint64_t index, Isa isa, const std::function<bool()>& go_on)
{
    const Realization r = experiment.sampler().realization(index);
    const Study stepped = stepped_as(experiment.study(), index);
    TracedLanes lanes(experiment, stepped, isa, r, 1);
    lanes.load(0, r, true);
    std::optional<TracedRealization> followed = lanes.to_end([&] { return !go_on || go_on(); });
    if (!followed)
        throw TraceStopped();
    return std::move(*followed);
}

bool trace_all(const Experiment& experiment, const RunOptions& options, const TracePlan& plan)
{
    if (plan.indices.empty())
        return true;
    const Sampler& sampler = experiment.sampler();
    const std::uint64_t count = plan.indices.size();
    const Realization pattern = sampler.realization(plan.indices[0]);
    Observer nobody;
    Crew crew(nobody); // its mutex guards the plan's functions and what follows
    std::atomic<std::size_t> next = 0;
    std::map<std::size_t, TracedRealization> ended;
    std::size_t delivered = 0;
    crew.run(options.threads, [&] {
        TracedLanes lanes(experiment, experiment.study(), options.isa, pattern,
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
