#pragma once
/// The one loop of the engine: lanes are filled, stepped together and emptied, on each of the threads of a run.

#include "ensemble/model/observer.hpp"
#include "ensemble/numerics/in_parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <string>

namespace stylobate {

/// The threads of one run: an error or a request to stop ends all of them, and one at a time tells how far they are.
class Crew {
public:
    explicit Crew(Observer& observer) : observer_(observer) {}

    bool stopped() const { return stopped_; }
    void stop() { stopped_ = true; }
    /// Since the crew began.
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    /// Guards what the threads share; the observer is called under it.
    std::mutex& mutex() { return mutex_; }

    /// Calls work() on so many threads at a time, and waits for all of them.
    /// @throws the first error of one of them
    template <class Work>
    void run(int threads, const Work& work)
    {
        // TBB would otherwise not start more threads than there are cores
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads));
        tbb::task_arena(threads).execute([&] {
            in_parallel(
                0, threads, [&](int) { guarded(work); }, tbb::simple_partitioner());
        });
        rethrow();
    }

    /// Calls work() in this thread; an error is kept for `rethrow`, and stops all threads.
    template <class Work>
    void guarded(const Work& work) noexcept
    {
        try {
            work();
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!error_)
                error_ = std::current_exception();
            stopped_ = true;
        }
    }
    void rethrow() const
    {
        if (error_)
            std::rethrow_exception(error_);
    }

    /// Tells the observer what the user should know.
    void warn(const std::string& text)
    {
        const std::lock_guard lock(mutex_);
        observer_.warn(text);
    }

    /// Tells the observer how far the run is, and asks it whether to go on: at most ten times a second but for the last
    /// time, and not while another thread has the mutex.
    /// @param progress (double seconds) -> const Progress&, called under the mutex
    template <class Tell>
    void tell(bool last, const Tell& progress)
    {
        const double now = seconds();
        if (!last && now < next_)
            return;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock.owns_lock())
            return;
        next_ = now + 0.1;
        observer_.progress(progress(now));
        if (observer_.stop_requested())
            stopped_ = true;
    }

private:
    using Clock = std::chrono::steady_clock;

    Observer& observer_;
    const Clock::time_point start_ = Clock::now();
    std::mutex mutex_;
    std::exception_ptr error_;
    std::atomic<bool> stopped_ = false;
    std::atomic<double> next_ = 0; ///< time of the next telling [s]
};

/// Calls f(lane) for each lane that `when` picks, one after the other. A set whose lanes may be filled side by side has
/// its own (`slots.hpp`).
template <class Set, class When, class F>
void each_lane(Set& set, const When& when, const F& f)
{
    for (int lane = 0; lane < set.lanes(); ++lane)
        if (when(lane))
            f(lane);
}

/// Fills the lanes of a set from a source, steps them together, and gives what has ended to a sink, until the source
/// has nothing left and no lane is busy.
/// @tparam Set lanes(), active(), free(lane), done(lane), advance(), and `each_lane`
/// @param source (int lane) puts something into this free lane; false: it has nothing more, and is not asked again
/// @param sink (int lane) takes out what is done; the lane may be free afterwards, or busy with something else
/// @param turn (int stepped, bool more) after each advance, with the number of lanes that it stepped and whether the
///        source may have more; false: stop
template <class Set, class Source, class Sink, class Turn>
void drive(Set& set, const Source& source, const Sink& sink, const Turn& turn)
{
    std::atomic<bool> more = true;
    const auto fill = [&] {
        each_lane(
            set, [&](int lane) { return more && set.free(lane); },
            [&](int lane) {
                if (!source(lane))
                    more = false;
            });
    };
    fill();
    for (int stepped = set.active(); stepped > 0; stepped = set.active()) {
        set.advance();
        for (int lane = 0; lane < set.lanes(); ++lane)
            if (!set.free(lane) && set.done(lane))
                sink(lane);
        fill();
        if (!turn(stepped, more))
            return;
    }
}

} // namespace stylobate
