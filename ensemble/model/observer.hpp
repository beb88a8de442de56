#pragma once
/// Messages from a run to its caller. The library itself prints nothing.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace stylobate {

/// How far a realization is that has not ended [s].
struct SimulatedTime {
    double reached_s = 0, latest_end_s = 0; ///< 0: not known
};

struct Progress {
    std::uint64_t done = 0;        ///< realizations that have ended, those of an earlier part of the run counted
    std::uint64_t total = 0;       ///< of the study, or the most that it can take
    std::uint64_t collapsed = 0;   ///< among `done`
    std::uint64_t invalid = 0;     ///< among `done`
    std::uint64_t block_steps = 0; ///< free blocks x steps of this run
    double seconds = 0;            ///< since this run began
    double rate = 0;               ///< realizations per second of this run
    double occupancy = 0;          ///< part of the lanes that worked on a realization
    SimulatedTime furthest{};      ///< of those that run now, the one that is furthest
    /// Share of the collapse in the whole study, as estimated from a fair sample of it, and its 95 % interval; NaN:
    /// nothing is known yet.
    double share = std::numeric_limits<double>::quiet_NaN();
    double share_lower = std::numeric_limits<double>::quiet_NaN();
    double share_upper = std::numeric_limits<double>::quiet_NaN();
    /// Whether `total` is only the most that it can take; `expected` is then an estimate of what it takes, 0: unknown.
    bool open_end = false;
    std::uint64_t expected = 0;

    /// How many there will be at the end: `total`, of an open end an estimate; nullopt: not known.
    std::optional<std::uint64_t> end() const
    {
        if (!open_end)
            return total;
        return expected > 0 ? std::optional(std::max(expected, done)) : std::nullopt;
    }
    /// Time to the end if it goes on as it did [s]; of a single realization the most that it can take. nullopt: not
    /// known, or nothing is left.
    std::optional<double> seconds_left() const
    {
        if (const std::optional<std::uint64_t> last = end(); last && rate > 0 && done < *last)
            return static_cast<double>(*last - done) / rate;
        if (simulates_first() && seconds > 0 && total == 1)
            return (furthest.latest_end_s / furthest.reached_s - 1) * seconds;
        return std::nullopt;
    }
    /// Whether the first realizations take long: none has ended, and how far one is is known.
    bool simulates_first() const { return done == 0 && furthest.reached_s > 0; }
};

class Observer {
public:
    virtual ~Observer() = default;
    /// Called from one thread at a time, about ten times a second at the most.
    virtual void progress(const Progress&) {}
    virtual void warn(const std::string&) {}
    /// True once the user has asked to stop: the run ends soon, keeping what is complete.
    virtual bool stop_requested() { return false; }
};

/// The observer of a part of larger work: passes on requests to stop, but no progress.
class StopOnly : public Observer {
public:
    explicit StopOnly(Observer& outer) : outer_(outer) {}
    bool stop_requested() override { return outer_.stop_requested(); }

private:
    Observer& outer_;
};

} // namespace stylobate
