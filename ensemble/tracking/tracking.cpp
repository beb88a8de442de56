#include "ensemble/tracking/tracking.hpp"

#include "ensemble/engine/drive.hpp"
#include "ensemble/planar/structure/mechanisms.hpp"
#include "ensemble/tracking/tracked_lanes.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <limits>
#include <mutex>
#include <optional>

namespace stylobate {

namespace {

constexpr double damping = 1.4;      // 2 x 0.7: the nudging settles without ringing
constexpr double largest_turn = 0.1; // w x the time between two settings of the nudging
constexpr std::uint64_t never = ~std::uint64_t{0};
// Steps that are done at a time where no lane asks for fewer: the trace of them is to stay in the first-level cache.
constexpr int most_at_once = 16;
static_assert(most_at_once % tracking_beat == 0 && chunk_steps % most_at_once == 0,
              "a run ends at a beat and in a chunk");
// States that wait for a lane, at the most: windows then go before further observers.
constexpr std::size_t most_waiting = 20000;

/// What a lane works on: an observer, or one of its windows.
struct Leg {
    std::size_t job = 0;
    int window = -1;           ///< -1: the observer
    std::vector<double> state; ///< of a window, at its first step
    std::uint64_t step = 0;
};

/// A time at which blocks are read: the first step not before it, and how far before that step it lies.
struct Reading {
    std::uint64_t step = never;
    double behind = 0;
};

Reading reading_at(double time_s, double step_s)
{
    const double position = time_s / step_s;
    const double step = std::max(std::ceil(position), 1.0);
    return {static_cast<std::uint64_t>(step), std::clamp(step - position, 0.0, 1.0)};
}

/// Step at which a window leaves its observer.
std::uint64_t leaving_step(double start_s, double step_s)
{
    return static_cast<std::uint64_t>(std::max(start_s / step_s, 0.0)) / tracking_beat * tracking_beat;
}

int nudge_steps(const TrackingJob& job)
{
    int steps = std::min(job.nudge_steps, tracking_beat);
    while (steps > 1 && steps * job.realization.step_s * job.nudge_rad_s > largest_turn)
        steps /= 2;
    return steps;
}

/// What a lane knows of its leg.
struct Work {
    bool busy = false;
    Leg leg;
    const std::vector<double>* times = nullptr; ///< to be read
    Readings* readings = nullptr;
    std::size_t next_time = 0;
    Reading next_reading;        ///< at that time
    std::size_t next_window = 0; ///< of an observer
    std::uint64_t needed = 0;    ///< steps up to what was last read or left; the neighbours decide how many are done
    int nudge_steps = 0;         ///< 0: no nudging
};

/// Only the step with mechanisms can be nudged.
Realization tracked(Realization realization)
{
    realization.with_mechanisms = true;
    return realization;
}

/// Queue of the legs of jobs that share a structure, and their results.
class Course {
public:
    Course(const std::vector<TrackingJob>& jobs, std::vector<std::size_t> mine, TrackingReport& report,
           const Crew& crew)
        : jobs_(jobs), mine_(std::move(mine)), left_(jobs.size(), 0), report_(report), crew_(crew)
    {
        for (const std::size_t job : mine_) {
            TrackingResult& result = report_.results[job];
            const std::size_t blocks = jobs[job].realization.blocks.size();
            result.windows.resize(jobs[job].windows ? jobs[job].windows->size() : 0);
            for (std::size_t w = 0; w < result.windows.size(); ++w)
                prepare(result.windows[w], (*jobs[job].windows)[w].times_s.size() * blocks);
            prepare(result.watched, (jobs[job].watched_s ? jobs[job].watched_s->size() : 0) * blocks);
            left_[job] = result.windows.size() + 1;
        }
    }

    /// The next leg; waits where windows may still come. Nothing is left: nothing.
    std::optional<Leg> next(bool wait)
    {
        std::unique_lock lock(mutex_);
        for (;;) {
            if (crew_.stopped())
                return std::nullopt;
            if (next_ < mine_.size() && waiting_.size() < most_waiting) {
                ++observers_;
                return Leg{mine_[next_++], -1, {}, 0};
            }
            if (!waiting_.empty()) {
                Leg leg = std::move(waiting_.front());
                waiting_.pop_front();
                return leg;
            }
            if (!wait || observers_ == 0)
                return std::nullopt;
            more_.wait_for(lock, std::chrono::milliseconds(20));
        }
    }

    void add(Leg window)
    {
        {
            const std::lock_guard lock(mutex_);
            waiting_.push_back(std::move(window));
        }
        more_.notify_one();
    }

    /// @return jobs that are complete now
    void end(const Leg& leg, std::uint64_t block_steps, std::size_t windows_lost)
    {
        const std::lock_guard lock(mutex_);
        report_.block_steps += block_steps;
        report_.windows += leg.window >= 0;
        if (leg.window < 0) {
            --observers_;
            more_.notify_all();
        }
        left_[leg.job] -= 1 + windows_lost;
        jobs_done_ += left_[leg.job] == 0;
    }

    std::size_t jobs_done()
    {
        const std::lock_guard lock(mutex_);
        return jobs_done_;
    }
    const std::vector<TrackingJob>& jobs() const { return jobs_; }
    Realization pattern() const { return tracked(jobs_[mine_.front()].realization); }
    TrackingResult& result(std::size_t job) { return report_.results[job]; }

private:
    static void prepare(Readings& readings, std::size_t values)
    {
        for (std::vector<double>* v : {&readings.x_m, &readings.y_m, &readings.theta_rad})
            v->assign(values, std::numeric_limits<double>::quiet_NaN());
    }

    const std::vector<TrackingJob>& jobs_;
    const std::vector<std::size_t> mine_;
    std::size_t next_ = 0;          ///< of `mine_`
    std::deque<Leg> waiting_;       ///< windows
    std::size_t observers_ = 0;     ///< that run
    std::vector<std::size_t> left_; ///< (jobs) legs that are still to end
    std::size_t jobs_done_ = 0;
    TrackingReport& report_;
    const Crew& crew_;
    std::mutex mutex_;
    std::condition_variable more_;
};

/// Legs in the lanes of a bundle, as `drive` steps them. What has ended has freed its lane.
class LegSet {
public:
    LegSet(const Study& study, const KernelTable& kernels, Course& course)
        : course_(course), lanes_(study, nullptr, kernels, course.pattern()),
          work_(static_cast<std::size_t>(lanes_.lanes())), steps_(work_.size(), 0)
    {
    }

    int lanes() const { return lanes_.lanes(); }
    int active() const { return lanes_.active(); }
    bool free(int lane) const { return lanes_.free(lane); }
    static bool done(int) { return false; }

    void load(int lane, Leg leg) { begin(static_cast<std::size_t>(lane), std::move(leg)); }

    /// To the next beat at which a lane may be filled, or over some of them.
    void advance()
    {
        do {
            // up to the next time at which any lane is changed; where that is makes no difference to the others
            std::uint64_t until = static_cast<std::uint64_t>(most_at_once - phase_ % most_at_once);
            for (std::size_t lane = 0; lane < work_.size(); ++lane)
                if (work_[lane].busy)
                    until = std::min(until, steps_to_change(lane));
            const int last = phase_ + static_cast<int>(until);
            lanes_.step(phase_, last);
            lane_steps_ += until * work_.size();
            active_steps_ += until * static_cast<std::uint64_t>(lanes_.active());
            phase_ = last;
            for (std::size_t lane = 0; lane < work_.size(); ++lane)
                if (work_[lane].busy) {
                    steps_[lane] += until;
                    events(lane);
                }
        } while (phase_ % tracking_beat != 0);
        phase_ %= chunk_steps;
    }

    std::uint64_t lane_steps() const { return lane_steps_; }
    std::uint64_t active_steps() const { return active_steps_; }

private:
    const TrackingJob& job(const Work& work) const { return course_.jobs()[work.leg.job]; }

    void begin(std::size_t lane, Leg leg)
    {
        Work& work = work_[lane];
        work = Work{};
        work.busy = true;
        work.leg = std::move(leg);
        steps_[lane] = work.needed = work.leg.step;
        const TrackingJob& j = job(work);
        TrackingResult& result = course_.result(work.leg.job);
        if (work.leg.window < 0) {
            lanes_.load(static_cast<int>(lane), tracked(j.realization), phase_);
            work.times = j.watched_s.get();
            work.readings = &result.watched;
            work.nudge_steps = j.targets && j.nudge_rad_s > 0 ? nudge_steps(j) : 0;
        } else {
            lanes_.load(static_cast<int>(lane), tracked(j.realization), phase_, work.leg.state, work.leg.step);
            work.times = &(*j.windows)[static_cast<std::size_t>(work.leg.window)].times_s;
            work.readings = &result.windows[static_cast<std::size_t>(work.leg.window)];
        }
        await(work);
        events(lane);
    }

    /// Sets when the lane is read next.
    void await(Work& work) const
    {
        work.next_reading = work.times && work.next_time < work.times->size()
                                ? reading_at((*work.times)[work.next_time], job(work).realization.step_s)
                                : Reading();
    }
    std::uint64_t next_leaving(const Work& work) const
    {
        const TrackingJob& j = job(work);
        return work.leg.window < 0 && j.windows && work.next_window < j.windows->size()
                   ? leaving_step((*j.windows)[work.next_window].start_s, j.realization.step_s)
                   : never;
    }

    /// Until the lane's state is taken or nudged. (It is read from the trace.)
    std::uint64_t steps_to_change(std::size_t lane) const
    {
        const Work& work = work_[lane];
        const std::uint64_t now = steps_[lane];
        std::uint64_t next = next_leaving(work);
        if (work.nudge_steps > 0) {
            const auto every = static_cast<std::uint64_t>(work.nudge_steps);
            next = std::min(next, now - now % every + every);
        }
        return next - now;
    }

    /// Reads, windows that leave, the nudging, and the end: what falls on the steps up to that which the lane has
    /// reached.
    void events(std::size_t lane)
    {
        Work& work = work_[lane];
        bool finite = true;
        while (work.next_reading.step <= steps_[lane] && finite)
            finite = read(lane);
        while (next_leaving(work) <= steps_[lane] && finite) {
            finite = is_finite(lane);
            work.needed = steps_[lane];
            if (finite)
                course_.add({work.leg.job, static_cast<int>(work.next_window++), lanes_.state(static_cast<int>(lane)),
                             steps_[lane]});
        }
        if (!finite || (work.next_reading.step == never && next_leaving(work) == never))
            return end(lane);
        if (work.nudge_steps > 0 && steps_[lane] % static_cast<std::uint64_t>(work.nudge_steps) == 0)
            nudge(lane);
    }

    bool is_finite(std::size_t lane) const
    {
        double sum = 0;
        const std::size_t blocks = job(work_[lane]).realization.blocks.size();
        for (std::size_t i = 0; i < blocks; ++i) {
            const BlockMotion m = lanes_.moved(static_cast<int>(lane), static_cast<int>(i), phase_);
            sum += m.x_m + m.y_m + m.theta_rad;
        }
        return std::isfinite(sum);
    }

    /// @return false, and NaN kept, if the model is no longer finite
    bool read(std::size_t lane)
    {
        Work& work = work_[lane];
        work.needed = work.next_reading.step;
        const int phase = phase_ - static_cast<int>(steps_[lane] - work.needed);
        const std::size_t blocks = job(work).realization.blocks.size(), first = work.next_time * blocks;
        double sum = 0;
        for (std::size_t i = 0; i < blocks; ++i) {
            const BlockMotion m =
                lanes_.moved(static_cast<int>(lane), static_cast<int>(i), phase, work.next_reading.behind);
            work.readings->x_m[first + i] = m.x_m;
            work.readings->y_m[first + i] = m.y_m;
            work.readings->theta_rad[first + i] = m.theta_rad;
            sum += m.x_m + m.y_m + m.theta_rad;
        }
        if (!std::isfinite(sum)) {
            for (std::vector<double>* values : {&work.readings->x_m, &work.readings->y_m, &work.readings->theta_rad})
                std::fill_n(values->begin() + static_cast<std::ptrdiff_t>(first), blocks,
                            std::numeric_limits<double>::quiet_NaN());
            return false;
        }
        ++work.next_time;
        await(work);
        return true;
    }

    void nudge(std::size_t lane)
    {
        const TrackingJob& j = job(work_[lane]);
        const Targets& t = *j.targets;
        const double dt = j.realization.step_s, w = j.nudge_rad_s;
        const double position = (static_cast<double>(steps_[lane]) * dt - t.start_s) / t.spacing_s;
        const bool inside = position >= 0 && position < static_cast<double>(t.samples()) - 1;
        const std::size_t row = inside ? static_cast<std::size_t>(position) : 0;
        const double s = position - static_cast<double>(row);
        for (std::size_t i = 0; i < j.realization.blocks.size(); ++i) {
            if (j.realization.blocks[i].fixed)
                continue;
            const std::size_t k = row * t.blocks + i;
            const BlockMotion now = lanes_.moved(static_cast<int>(lane), static_cast<int>(i), phase_);
            const BlockMotion last = lanes_.increment(static_cast<int>(lane), static_cast<int>(i), phase_);
            const auto towards = [&](const std::vector<double>& q, const std::vector<double>& v, double at,
                                     double step) {
                if (!inside)
                    return 0.0;
                // the cubic through two positions and velocities, and the line between the velocities
                const double d = t.spacing_s;
                const double where = (1 + 2 * s) * (1 - s) * (1 - s) * q[k] + s * s * (3 - 2 * s) * q[k + t.blocks] +
                                     s * (1 - s) * d * ((1 - s) * v[k] - s * v[k + t.blocks]);
                const double speed = (1 - s) * v[k] + s * v[k + t.blocks];
                const double a = w * w * (where - at) + damping * w * (speed - step / dt);
                return std::isfinite(a) ? a : 0.0;
            };
            lanes_.nudge(static_cast<int>(lane), static_cast<int>(i), towards(t.x_m, t.velocity_m_s, now.x_m, last.x_m),
                         0, towards(t.theta_rad, t.rotation_rad_s, now.theta_rad, last.theta_rad));
        }
    }

    void end(std::size_t lane)
    {
        Work& work = work_[lane];
        const TrackingJob& j = job(work);
        const std::size_t lost =
            work.leg.window < 0 && j.windows ? j.windows->size() - work.next_window : 0; // it ended before them
        course_.end(work.leg, j.realization.free_blocks() * (work.needed - work.leg.step), lost);
        work.busy = false;
        lanes_.clear(static_cast<int>(lane));
    }

    Course& course_;
    TrackedLanes lanes_;
    int phase_ = 0;                    ///< steps of the chunk, which all lanes share, that have been done
    std::vector<Work> work_;           ///< (lanes)
    std::vector<std::uint64_t> steps_; ///< (lanes) done by the realization
    std::uint64_t lane_steps_ = 0, active_steps_ = 0;
};

/// Whether two jobs may share a bundle.
bool alike(const TrackingJob& a, const TrackingJob& b)
{
    const Realization &r = a.realization, &q = b.realization;
    const auto same_block = [](const Block& m, const Block& n) { return m.fixed == n.fixed; };
    const auto same_joint = [](const Joint& m, const Joint& n) { return m.lower == n.lower && m.upper == n.upper; };
    return r.form == q.form && r.watched == q.watched && model_of(r).strengthened == model_of(q).strengthened &&
           std::equal(r.blocks.begin(), r.blocks.end(), q.blocks.begin(), q.blocks.end(), same_block) &&
           std::equal(r.joints.begin(), r.joints.end(), q.joints.begin(), q.joints.end(), same_joint);
}

} // namespace

TrackingReport track(const std::vector<TrackingJob>& jobs, const RunOptions& options, Observer& observer)
{
    TrackingReport report;
    report.results.resize(jobs.size());
    // jobs that can share bundles, in the order of their first ones
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        assert(jobs[i].realization.motion && "the base motion is the realization's own");
        const auto group =
            std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return alike(jobs[g.front()], jobs[i]); });
        if (group == groups.end())
            groups.push_back({i});
        else
            group->push_back(i);
    }

    Crew crew(observer);
    std::uint64_t lane_steps = 0, active_steps = 0;
    Progress progress;
    progress.total = jobs.size();
    std::size_t before = 0;
    for (const std::vector<std::size_t>& group : groups) {
        if (crew.stopped())
            break;
        Study study; // of the way that lanes are driven: each along its own motion
        study.excitation.kind = ExcitationKind::noise;
        Course course(jobs, group, report, crew);
        const auto tell = [&](bool last) {
            crew.tell(last, [&](double seconds) -> const Progress& {
                progress.done = before + course.jobs_done();
                progress.seconds = seconds;
                progress.rate = static_cast<double>(progress.done) / std::max(seconds, 1e-9);
                return progress;
            });
        };
        crew.run(options.threads, [&] {
            LegSet set(study, kernels(options.isa), course);
            const auto source = [&](int lane) {
                std::optional<Leg> leg = course.next(set.active() == 0);
                if (leg)
                    set.load(lane, std::move(*leg));
                return true; // windows may still come
            };
            drive(
                set, source, [](int) {},
                [&](int, bool) {
                    tell(false);
                    return !crew.stopped();
                });
            const std::lock_guard lock(crew.mutex());
            lane_steps += set.lane_steps();
            active_steps += set.active_steps();
        });
        tell(true);
        before += course.jobs_done();
    }
    report.complete = before == jobs.size();
    report.seconds = crew.seconds();
    report.occupancy = lane_steps > 0 ? static_cast<double>(active_steps) / static_cast<double>(lane_steps) : 0;
    return report;
}

} // namespace stylobate
