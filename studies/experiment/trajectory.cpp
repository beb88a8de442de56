#include "studies/experiment/trajectory.hpp"

#include "ensemble/engine/lanes.hpp"
#include "ensemble/replicas/twins.hpp"
#include "studies/experiment/block_names.hpp"

#include <cmath>

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

    void sample(std::uint64_t n, const Snapshot& before, const Snapshot& after)
    {
        while (due(n)) {
            const double time = next_time();
            const double share = time / step_s_ - static_cast<double>(n);
            const auto append = [&](std::vector<double>& to, const std::vector<double>& a,
                                    const std::vector<double>& b) {
                for (std::size_t i = 0; i < trajectory_.blocks(); ++i)
                    to.push_back(a[i] + share * (b[i] - a[i]));
            };
            append(trajectory_.x_m, before.x_m, after.x_m);
            append(trajectory_.y_m, before.y_m, after.y_m);
            append(trajectory_.theta_rad, before.theta_rad, after.theta_rad);
            trajectory_.base_x_m.push_back(motion_.displacement_m(time));
            trajectory_.time_s.push_back(time);
        }
    }

private:
    Trajectory& trajectory_;
    const BaseMotion& motion_;
    const double rate_hz_, step_s_;
};

} // namespace

FollowedRealization follow(const Experiment& experiment, std::uint64_t index, Isa isa,
                           const std::function<bool()>& go_on)
{
    FollowedRealization followed;
    followed.realization = experiment.sampler().realization(index);
    const Realization& r = followed.realization;
    Trajectory& t = followed.trajectory;
    t.index = index;
    t.name = block_names(experiment.study());
    for (std::size_t i = 0; i < t.name.size(); ++i) { // the ground is not recorded
        t.rest_x_m.push_back(r.blocks[i].x_m);
        t.rest_y_m.push_back(r.blocks[i].y_m);
        t.half_width_m.push_back(r.blocks[i].half_width_m);
        t.half_height_m.push_back(r.blocks[i].half_height_m);
        t.role.push_back(r.blocks[i].role);
        t.column.push_back(r.blocks[i].column);
    }

    constexpr int lane = 0;
    const Study stepped = stepped_as(experiment.study(), index);
    LaneSet lanes(stepped, experiment.record(), kernels(isa), r);
    lanes.load(lane, r);
    Recorder recorder(t, lanes.motion(lane), experiment.study().output.trajectory_rate_hz, r.step_s);
    constexpr std::uint64_t steps_between_questions = 1024;
    for (std::uint64_t n = 0; !lanes.outcome(lane); ++n) {
        if (go_on && n % steps_between_questions == 0 && !go_on())
            throw FollowStopped();
        const int k = static_cast<int>(n % chunk_steps);
        const bool due = recorder.due(n);
        const Snapshot before = due ? lanes.snapshot(lane) : Snapshot{};
        lanes.advance(k, k + 1);
        if (due)
            recorder.sample(n, before, lanes.snapshot(lane));
    }
    followed.outcome = *lanes.outcome(lane);
    return followed;
}

ResultRow result_row(const Study& study, const Realization& realization, const Outcome& outcome)
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
