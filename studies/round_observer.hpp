#pragma once
/// Tells of one of several rounds as a part of the whole run.

#include "ensemble/observer.hpp"

namespace stylobate {

class RoundObserver : public Observer {
public:
    /// @param before all that had been done when the round began
    RoundObserver(Observer& whole, const Progress& before) : whole_(whole), before_(before) {}
    void progress(const Progress& round) override { whole_.progress(joined(round)); }
    void warn(const std::string& text) override { whole_.warn(text); }
    bool stop_requested() override { return whole_.stop_requested(); }

    /// What had been done before the round, and the round.
    Progress joined(const Progress& round) const
    {
        Progress all = before_;
        all.done += round.done;
        all.collapsed += round.collapsed;
        all.invalid += round.invalid;
        all.block_steps += round.block_steps;
        all.seconds += round.seconds;
        const double before = before_.rate * before_.seconds;
        all.rate = all.seconds > 0 ? (before + round.rate * round.seconds) / all.seconds : 0;
        all.occupancy =
            all.seconds > 0 ? (before_.occupancy * before_.seconds + round.occupancy * round.seconds) / all.seconds : 0;
        return all;
    }

private:
    Observer& whole_;
    Progress before_;
};

} // namespace stylobate
