#include "ensemble/replicas/replicas.hpp"

#include "ensemble/engine/drive.hpp"
#include "ensemble/model/fields.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/planar/structure/scales.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

namespace stylobate {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Positions of the free blocks, sample by sample.
class History {
public:
    explicit History(const Realization& r)
    {
        for (const TrajectoryChannel& channel : planar_channels)
            if (channel.of == ListOf::poses)
                per_.push_back(unit_of(channel.name) == "m" ? scales_of(r).width_m : 1);
        for (std::size_t i = 0; i < r.blocks.size(); ++i)
            if (!r.blocks[i].fixed)
                free_.push_back(i);
    }
    void add(const Snapshot& s)
    {
        for (const std::size_t i : free_)
            for (std::size_t c = 0; c < per_.size(); ++c)
                values_.push_back(s.pose(c)[i] / per_[c]);
    }
    std::size_t checks() const { return values_.size() / (per_.size() * free_.size()); }

    double separation(const Snapshot& replica, std::size_t check) const
    {
        double sum = 0;
        visit(check, replica, [&](double d) { sum += d * d; });
        return std::sqrt(sum);
    }
    /// Distance of the last sample from the first one.
    double moved(const Snapshot& now) const
    {
        double most = 0;
        visit(0, now, [&](double d) { most = std::max(most, std::fabs(d)); });
        return most;
    }

private:
    template <class F>
    void visit(std::size_t check, const Snapshot& s, const F& f) const
    {
        const double* before = &values_[check * per_.size() * free_.size()];
        for (const std::size_t i : free_)
            for (std::size_t c = 0; c < per_.size(); ++c)
                f(s.pose(c)[i] / per_[c] - *before++);
    }

    std::vector<double> per_; ///< (channels of a pose) the mean width of the drums, of a length; else 1
    std::vector<std::size_t> free_;
    std::vector<double> values_; ///< (checks x free blocks x channels)
};

/// One original and its displaced replicas, one after the other in the same lane.
class Group {
public:
    Group(const Study& study, const Sampler& sampler, std::uint64_t original)
        : study_(study), sampler_(sampler), original_(original), history_(sampler.realization(original))
    {
    }

    /// Puts the original into the lane.
    void begin(LaneSet& lanes, int lane)
    {
        lanes.load(lane, sampler_.realization(original_));
        step_s_ = lanes.realization(lane).step_s;
        shaking_s_ = lanes.motion(lane).duration_s();
        history_.add(lanes.snapshot(lane));
    }

    /// After each chunk. @return false when all is done
    bool check(LaneSet& lanes, int lane)
    {
        return kind_ < 0 ? check_original(lanes, lane) : check_replica(lanes, lane);
    }

    std::vector<ReplicaSeparation> pairs() && { return std::move(pairs_); }

private:
    double time(std::size_t check) const { return static_cast<double>(check * chunk_steps) * step_s_; }

    bool check_original(LaneSet& lanes, int lane)
    {
        const Snapshot now = lanes.snapshot(lane);
        if (left_at_ == 0 && history_.moved(now) > left_place)
            left_at_ = history_.checks();
        history_.add(now);
        if (!lanes.done(lane))
            return true;
        return !(lanes.outcome(lane) && lanes.outcome(lane)->state == State::invalid) && next(lanes, lane);
    }

    /// The next displaced replica, if there is one. One that begins beyond the tolerance is done at once.
    bool next(LaneSet& lanes, int lane)
    {
        const ReplicasSpec& replicas = *study_.design().replica_set;
        const std::vector<Replica>& kinds = replicas.kinds;
        while (++kind_ < static_cast<int>(kinds.size())) {
            if (kinds[static_cast<std::size_t>(kind_)].by != ReplicaBy::move)
                continue;
            lanes.load(lane,
                       sampler_.realization(original_ + (static_cast<std::uint64_t>(kind_) + 1) * study_.originals()));
            check_ = 0;
            growth_ = Slope();
            ReplicaSeparation pair;
            pair.original = original_;
            pair.kind = static_cast<std::uint64_t>(kind_);
            pair.start = history_.separation(lanes.snapshot(lane), 0);
            pair.original_end_s = time(history_.checks() - 1);
            pair.exponent_per_s = nan;
            pair.horizon_s = pair.start < replicas.tolerance ? nan : 0;
            pairs_.push_back(pair);
            if (std::isnan(pair.horizon_s))
                return true;
        }
        return false;
    }

    bool check_replica(LaneSet& lanes, int lane)
    {
        ReplicaSeparation& pair = pairs_.back();
        const double s = history_.separation(lanes.snapshot(lane), ++check_);
        pair.followed_s = time(check_);
        if (s < study_.design().replica_set->tolerance) {
            if (left_at_ > 0 && check_ >= left_at_ && time(check_) <= shaking_s_ && s > 0)
                growth_.add(time(check_), std::log(s));
            if (check_ + 1 < history_.checks() && !lanes.done(lane))
                return true;
        } else {
            pair.horizon_s = time(check_);
        }
        pair.exponent_per_s = growth_.count() < least_checks ? nan : growth_.value();
        return next(lanes, lane);
    }

    const Study& study_;
    const Sampler& sampler_;
    const std::uint64_t original_;
    History history_;
    std::size_t left_at_ = 0; ///< check at which the original had left its place; 0: never
    double step_s_ = 0, shaking_s_ = 0;
    int kind_ = -1; ///< of the replica that is followed; -1: the original
    std::size_t check_ = 0;
    Slope growth_;
    std::vector<ReplicaSeparation> pairs_;
};

/// Groups in the lanes of a bundle, as `drive` steps them.
class GroupSet {
public:
    GroupSet(const Experiment& experiment, Isa isa, const Realization& pattern, std::uint64_t waiting)
        : lanes_(experiment.study(), experiment.record(), kernels(isa), pattern, waiting),
          places_(static_cast<std::size_t>(lanes_.lanes()))
    {
    }

    int lanes() const { return lanes_.lanes(); }
    int active() const { return lanes_.active(); }
    bool free(int lane) const { return lanes_.free(lane); }
    bool done(int lane) const { return places_[static_cast<std::size_t>(lane)].done; }

    void load(int lane, std::uint64_t number, Group group)
    {
        Place& place = places_[static_cast<std::size_t>(lane)];
        place.number = number;
        place.done = false;
        place.group.emplace(std::move(group)).begin(lanes_, lane);
    }
    void advance()
    {
        lanes_.advance();
        for (int lane = 0; lane < lanes(); ++lane)
            if (!free(lane)) {
                Place& place = places_[static_cast<std::size_t>(lane)];
                place.done = !place.group->check(lanes_, lane);
            }
    }
    /// Frees the lane of a group that is done. @return its number, and its pairs
    std::pair<std::uint64_t, std::vector<ReplicaSeparation>> take(int lane)
    {
        Place& place = places_[static_cast<std::size_t>(lane)];
        lanes_.clear(lane);
        return {place.number, std::move(*place.group).pairs()};
    }

private:
    struct Place {
        std::uint64_t number = 0;
        bool done = false;
        std::optional<Group> group;
    };
    LaneSet lanes_;
    std::vector<Place> places_;
};

} // namespace

Study stepped_as(const Study& study, std::uint64_t index)
{
    Study stepped = study;
    if (const Replica* replica = study.replica(index); replica && replica->by == ReplicaBy::precision)
        stepped.run.precision = Precision::single;
    return stepped;
}

std::vector<ReplicaRange> replica_ranges(const Study& study)
{
    std::vector<ReplicaRange> ranges;
    const std::uint64_t n = study.originals();
    for (std::uint64_t begin = 0; begin < study.total(); begin += n) {
        const Replica* replica = study.replica(begin);
        // moves and steps go with the originals
        if (replica == nullptr || replica->by == ReplicaBy::precision || replica->by == ReplicaBy::form)
            ranges.push_back({begin, begin, stepped_as(study, begin)});
        ranges.back().end = begin + n;
    }
    return ranges;
}

std::uint64_t moves_of(const Study& study)
{
    const ReplicasSpec* replicas = study.design().replica_set;
    return replicas == nullptr
               ? 0
               : static_cast<std::uint64_t>(std::ranges::count(replicas->kinds, ReplicaBy::move, &Replica::by));
}

std::uint64_t separated_originals(const Study& study)
{
    return moves_of(study) > 0 ? study.cells() * std::min(study.design().replica_set->followed, study.realizations) : 0;
}

std::vector<ReplicaSeparation> replica_separations(const Experiment& experiment, const RunOptions& options,
                                                   Observer& observer)
{
    const Study& study = experiment.study();
    const Sampler& sampler = experiment.sampler();
    const std::uint64_t all = separated_originals(study), of_cell = all / study.cells();
    std::vector<std::vector<ReplicaSeparation>> pairs(all);
    if (all == 0)
        return {};
    const Realization pattern = sampler.realization(0);
    std::atomic<std::uint64_t> next = 0;
    Progress progress;
    progress.total = all;
    Crew crew(observer);
    const auto report = [&](bool last) {
        crew.tell(last, [&](double seconds) -> const Progress& {
            progress.seconds = seconds;
            progress.rate = static_cast<double>(progress.done) / seconds;
            return progress;
        });
    };
    crew.run(options.threads, [&] {
        GroupSet set(experiment, options.isa, pattern, all / static_cast<std::uint64_t>(options.threads));
        const auto source = [&](int lane) {
            const std::uint64_t number = next++;
            if (number < all)
                set.load(lane, number, Group(study, sampler, number / of_cell * study.realizations + number % of_cell));
            return number < all;
        };
        const auto sink = [&](int lane) {
            auto [number, found] = set.take(lane);
            pairs[number] = std::move(found);
            const std::lock_guard lock(crew.mutex());
            ++progress.done;
        };
        drive(set, source, sink, [&](int, bool) {
            report(false);
            return !crew.stopped();
        });
    });
    report(true);

    std::vector<ReplicaSeparation> joined;
    for (const std::vector<ReplicaSeparation>& of : pairs)
        joined.insert(joined.end(), of.begin(), of.end());
    return joined;
}

} // namespace stylobate
