#include "studies/check/study_trial.hpp"

#include "ensemble/experiment.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/replicas/replicas.hpp"
#include "ensemble/sampling/structure_builder.hpp"
#include "studies/check/run_cost.hpp"
#include "studies/experiment/trajectory.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace stylobate {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin)
{
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Stops a trial that takes far too long, or that the user stops.
class Deadline : public Observer {
public:
    Deadline(Observer& user, Clock::time_point begin, double limit_s) : user_(user), begin_(begin), limit_s_(limit_s) {}
    bool stop_requested() override { return user_.stop_requested() || over(); }
    bool over() const { return seconds_since(begin_) > limit_s_; }

private:
    Observer& user_;
    const Clock::time_point begin_;
    const double limit_s_;
};

/// One part of a study in a trial.
class PartTrial {
public:
    PartTrial(const Experiment& experiment, const RunOptions& options, const Study* as, TrialOrder order)
        : experiment_(experiment), options_(options), as_(as), order_(std::move(order))
    {
        part_.total = order_.total();
    }

    /// Runs the next ones.
    /// @returns whether all of them have ended
    bool run(std::uint64_t count, std::uint64_t trajectories, Observer& observer)
    {
        const std::vector<std::uint64_t> indices = order_.next(count);
        const std::size_t before = part_.run.size();
        const double begin = processor_seconds();
        const double occupancy =
            experiment_.study().design().traced ? follow(indices, trajectories, observer) : step(indices, observer);
        const double took = processor_seconds() - begin;
        processor_s_ += took;
        busy_s_ += took * occupancy;
        return part_.run.size() - before == indices.size();
    }

    std::uint64_t left() const { return order_.total() - order_.taken(); }

    TrialPart result() const
    {
        TrialPart part = part_;
        std::sort(part.run.begin(), part.run.end(),
                  [](const TrialRealization& a, const TrialRealization& b) { return a.index < b.index; });
        const auto n = static_cast<double>(part.run.size());
        if (n == 0)
            return part;
        part.processor_s = (left() == 0 ? processor_s_ : busy_s_) / n;
        double sum = 0, squares = 0;
        for (const TrialRealization& r : part.run) {
            sum += static_cast<double>(r.steps);
            squares += static_cast<double>(r.steps) * static_cast<double>(r.steps);
        }
        const double mean = sum / n, scatter = std::max(0.0, squares / n - mean * mean);
        if (left() > 0 && mean > 0)
            part.processor_sd = part.processor_s * std::sqrt(scatter / std::max(n - 1, 1.0)) / mean;
        return part;
    }

private:
    void take(const Realization& realization, const Outcome& outcome)
    {
        const Study& study = experiment_.study();
        const bool shaken = study.excitation.kind != ExcitationKind::none;
        const double energy_j = outcome.energy_kinetic_j + outcome.energy_potential_j + outcome.energy_spring_j;
        const bool ended_upright = outcome.state != State::collapsed && outcome.state != State::invalid;
        part_.run.push_back({.index = realization.index,
                             .cell = study.cell(realization.index),
                             .state = outcome.state,
                             .steps = outcome.steps,
                             .step_s = outcome.step_s,
                             .end_s = outcome.end_time_s,
                             .cut_off = shaken && ended_upright &&
                                        outcome.end_time_s >= longest_s(experiment_, realization) &&
                                        energy_j >= StructureBuilder::scales(realization).barrier_j,
                             .at_rest = outcome.at_rest != 0});
    }

    double step(const std::vector<std::uint64_t>& indices, Observer& observer)
    {
        RunPlan plan;
        plan.total = indices.size();
        plan.indices = indices;
        plan.as = as_;
        plan.sink = [this](const Realization& realization, const Outcome& outcome) { take(realization, outcome); };
        return run_ensemble(experiment_, options_, plan, observer).occupancy;
    }

    /// As a single study is run.
    double follow(const std::vector<std::uint64_t>& indices, std::uint64_t trajectories, Observer& observer)
    {
        double busy = 0;
        std::uint64_t asked = 0;
        TracePlan plan;
        plan.indices = indices;
        plan.recorded = trajectories;
        plan.sink = [this](const TracedRealization& f) { take(f.realization, f.outcome); };
        plan.stop = [&](double occupancy, const SimulatedTime&) {
            busy += occupancy;
            ++asked;
            return observer.stop_requested();
        };
        trace_all(experiment_, options_, plan);
        return asked > 0 ? busy / static_cast<double>(asked) : 1;
    }

    const Experiment& experiment_;
    const RunOptions& options_;
    const Study* as_;
    TrialOrder order_;
    TrialPart part_;
    double processor_s_ = 0, busy_s_ = 0;
};

/// Runs a part in larger and larger pieces while the next one ends in time.
/// @returns false if not even the first one has
bool try_part(PartTrial& part, std::uint64_t lanes, double seconds, std::uint64_t trajectories, Observer& observer,
              Clock::time_point begun)
{
    constexpr double longest = 4; // times the time that it may take
    Deadline deadline(observer, begun, longest * seconds);
    const Clock::time_point begin = Clock::now();
    for (std::uint64_t count = lanes, pieces = 0;; ++pieces) {
        count = std::min(count, part.left());
        if (count == 0)
            return true;
        const Clock::time_point piece = Clock::now();
        if (!part.run(count, trajectories, deadline))
            return pieces > 0 && !observer.stop_requested();
        const double took = std::max(seconds_since(piece), 1e-6), left = seconds - seconds_since(begin);
        const double fits = 0.8 * left * static_cast<double>(count) / took;
        if (fits < static_cast<double>(lanes) && fits < static_cast<double>(part.left()))
            return true;
        count = std::min(4 * count, static_cast<std::uint64_t>(std::max(fits, 1.0)));
    }
}

/// Processor time of a step of one realization [s], in a register that is as full as the study fills it.
double time_of_step(const Experiment& experiment, Isa isa, std::uint64_t realizations)
{
    constexpr double enough_s = 0.3;
    TrialOrder order(experiment.study(), 0, realizations);
    const std::vector<std::uint64_t> indices = order.next(static_cast<std::uint64_t>(kernels(isa).lanes));
    LaneSet lanes(experiment.study(), experiment.record(), kernels(isa), experiment.sampler().realization(indices[0]),
                  realizations);
    for (std::size_t i = 0; i < indices.size() && static_cast<int>(i) < lanes.lanes(); ++i)
        lanes.load(static_cast<int>(i), experiment.sampler().realization(indices[i]));
    const double begin = processor_seconds();
    double steps = 0, took = 0;
    while (took < enough_s) {
        steps += static_cast<double>(chunk_steps * lanes.active());
        lanes.advance();
        for (int lane = 0; lane < lanes.lanes(); ++lane)
            if (!lanes.free(lane) && lanes.done(lane))
                lanes.clear(lane);
        took = processor_seconds() - begin;
        if (lanes.active() == 0)
            break;
    }
    return took / steps;
}

} // namespace

TrialShares shares_of(const TrialPart& part)
{
    TrialShares shares;
    for (const TrialRealization& r : part.run) {
        shares.valid += r.state != State::invalid;
        shares.collapsed += r.state == State::collapsed;
    }
    return shares;
}

TrialShares Trial::shares() const
{
    TrialShares shares;
    for (const TrialPart& part : parts) {
        const TrialShares of_part = shares_of(part);
        shares.valid += of_part.valid;
        shares.collapsed += of_part.collapsed;
    }
    return shares;
}

std::uint64_t Trial::count() const
{
    return std::accumulate(parts.begin(), parts.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const TrialPart& part) { return sum + part.run.size(); });
}

bool Trial::whole() const
{
    return std::all_of(parts.begin(), parts.end(), [](const TrialPart& part) { return part.run.size() == part.total; });
}

double Trial::share_of_processor() const
{
    return seconds > 0 ? std::min(1.0, processor_s / (seconds * threads)) : 1;
}

Trial try_study(const Experiment& experiment, const RunOptions& options, double seconds, std::uint64_t trajectories,
                Observer& observer)
{
    const Study& study = experiment.study();
    const StudyDesign design = study.design();
    std::vector<ReplicaRange> ranges;
    if (design.replica_set)
        ranges = replica_ranges(study);
    else
        ranges.push_back({0, design.drawn_alone(design.total()), study});
    const std::uint64_t lanes =
        static_cast<std::uint64_t>(kernels(options.isa).lanes) * static_cast<std::uint64_t>(options.threads);
    const double processor_begin = processor_seconds();
    const Clock::time_point begin = Clock::now();
    Trial trial;
    trial.threads = options.threads;
    trial.lanes = lanes;
    for (const ReplicaRange& range : ranges) {
        PartTrial part(experiment, options, design.replica_set ? &range.study : nullptr,
                       TrialOrder(study, range.begin, range.end));
        trial.unfinished = trial.unfinished || !try_part(part, lanes, seconds / static_cast<double>(ranges.size()),
                                                         trajectories, observer, Clock::now());
        trial.parts.push_back(part.result());
        if (observer.stop_requested())
            break;
    }
    if (trial.unfinished && !observer.stop_requested())
        trial.lane_s_per_step = time_of_step(experiment, options.isa, design.drawn_alone(design.originals()));
    trial.seconds = seconds_since(begin);
    trial.processor_s = processor_seconds() - processor_begin;
    return trial;
}

TrialOrder::TrialOrder(const Study& study, std::uint64_t begin, std::uint64_t end) : begin_(begin), end_(end)
{
    const std::uint64_t total = end - begin;
    const StudyDesign design = study.design();
    if (total % design.cells != 0)
        counts_ = {1, 1, total};
    else
        counts_ = {design.cells / design.columns, design.columns, total / design.cells};
    const auto dimensions = std::count_if(counts_.begin(), counts_.end(), [](std::uint64_t n) { return n > 1; });
    double g = 1.5; // a fixed point of g = (1 + g)^(1 / (d + 1))
    for (int i = 0; i < 64; ++i)
        g = std::pow(1 + g, 1 / static_cast<double>(dimensions + 1));
    double power = 1;
    for (std::size_t d = 0; d < counts_.size(); ++d)
        if (counts_[d] > 1)
            step_[d] = power /= g;
}

std::vector<std::uint64_t> TrialOrder::next(std::uint64_t count)
{
    count = std::min(count, total() - taken());
    std::vector<std::uint64_t> indices;
    while (indices.size() < count) {
        std::array<std::uint64_t, 3> at{};
        for (std::size_t d = 0; d < at.size(); ++d) {
            double whole = 0;
            const double part = std::modf(0.5 + static_cast<double>(point_) * step_[d], &whole);
            at[d] = std::min(counts_[d] - 1, static_cast<std::uint64_t>(part * static_cast<double>(counts_[d])));
        }
        ++point_;
        std::uint64_t cell = at[0] * counts_[1] + at[1], k = at[2];
        std::uint64_t tried = 0;
        while (!taken_.insert(cell * counts_[2] + k).second) {
            k = (k + 1) % counts_[2];
            if (++tried % counts_[2] == 0)
                cell = (cell + 1) % (counts_[0] * counts_[1]);
        }
        indices.push_back(begin_ + cell * counts_[2] + k);
    }
    std::sort(indices.begin(), indices.end());
    return indices;
}

} // namespace stylobate
