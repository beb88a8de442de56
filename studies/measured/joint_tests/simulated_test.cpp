#include "studies/measured/joint_tests/simulated_test.hpp"

#include "ensemble/model/motion.hpp"
#include "ensemble/numerics/in_parallel.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/planar/structure/static_state.hpp"
#include "studies/measured/joint_tests/joint_bench.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace stylobate {

namespace {

// A body has fallen whose centre is below this part of its height at rest, or that leans by more: it is seen no more.
constexpr double fallen_part = 0.6;
constexpr double most_lean_rad = 0.8;
// The safe step is for ten times the load at rest. A body that falls meets its bed with more, and beds that harden gain
// energy there: in one of seven healthy laws a drop threw the body up.
constexpr double steps_of_a_fall = 4;

/// Normal numbers of one run of one subject, one after the other.
class RunNoise {
public:
    RunNoise(std::uint64_t seed, std::uint64_t subject, const MeasuredRun& run, Stream stream)
        : seed_(seed), stream_(stream)
    {
        std::uint64_t name = 0xcbf29ce484222325u; // FNV-1a
        for (const char letter : run.name + '/' + std::to_string(run.repeat))
            name = (name ^ static_cast<unsigned char>(letter)) * 0x100000001b3u;
        index_ = name ^ random_bits(seed, subject, stream, 0);
    }
    double operator()() { return to_normal(uniform01(seed_, index_, stream_, next_++)); }

private:
    std::uint64_t seed_, index_ = 0;
    Stream stream_;
    std::uint64_t next_ = 0;
};

double spacing_s(const MeasuredRun& run)
{
    return (run.time_s.back() - run.time_s.front()) / static_cast<double>(run.time_s.size() - 1);
}

/// Through all samples of what was commanded; at rest where nothing was.
std::shared_ptr<const Motion> commanded(const MeasuredRun& run, const Series& series)
{
    if (series.empty())
        return std::make_shared<const Motion>(motion_of({0, 0}, run.time_s.back() - run.time_s.front()));
    std::vector<double> moved;
    for (const double value : series.values)
        moved.push_back(value - series.values.front());
    const double dt = spacing_s(run);
    return std::make_shared<const Motion>(motion_of(acceleration_through(moved, dt), dt));
}

/// What all subjects have in common in a planned run.
struct PlannedMotion {
    std::shared_ptr<const Motion> base, tilt;           ///< tilt null: the table does not turn
    std::shared_ptr<const std::vector<double>> times_s; ///< of the samples after the release, since then
    std::size_t first = 0;                              ///< sample that these begin with
};

PlannedMotion planned_motion(const MeasuredRun& run)
{
    PlannedMotion motion;
    motion.base = commanded(run, run.base_displacement_m);
    if (!run.base_tilt_rad.empty())
        motion.tilt = commanded(run, run.base_tilt_rad);
    const double released = run.released_s.value_or(run.time_s.front());
    std::vector<double> times;
    for (std::size_t i = 0; i < run.time_s.size(); ++i)
        if (run.time_s[i] > released || (!run.released_s && i == 0))
            times.push_back(run.time_s[i] - released);
    motion.first = run.time_s.size() - times.size();
    motion.times_s = std::make_shared<const std::vector<double>>(std::move(times));
    return motion;
}

/// Where the body is at a sample.
struct BodyPlace {
    double x_m = 0, y_m = 0, theta_rad = 0; ///< displacement from its place in the reference stack
};

/// The sensors of a run.
class Seen {
public:
    Seen(const Specimen& specimen, const SpecimenStructure& built, const JointBench& bench, const MeasuredRun& planned,
         const TestSensors& sensors, RunNoise noise)
        : built_(built), bench_(bench), sensors_(sensors), noise_(noise), run_(planned),
          columns_(specimen.half_width_m.size()), samples_(planned.time_s.size())
    {
        prepare(run_.blocks.x_m, sensors.camera_m);
        prepare(run_.blocks.y_m, sensors.camera_m);
        prepare(run_.blocks.theta_rad, sensors.camera_rad);
        run_.collapsed = false;
        run_.collapse_time_s = -1;
        if (!run_.base_tilt_rad.empty()) {
            run_.base_tilt_rad.noise_sd = run_.base_tilt_rad.noise_sd.value_or(sensors.tilt_rad);
            for (double& tilt : run_.base_tilt_rad.values)
                tilt += *run_.base_tilt_rad.noise_sd * noise_();
        }
    }

    /// @param whole realization of the specimen, whose other blocks are fixed
    void see(const Realization& whole, const PlannedMotion& motion, const Readings& readings)
    {
        const std::size_t blocks = bench_.realization.blocks.size();
        const auto place = [&](std::size_t row) {
            const std::size_t at = row * blocks + bench_.body;
            return BodyPlace{readings.x_m[at], readings.y_m[at], readings.theta_rad[at]};
        };
        const Block& body = bench_.realization.blocks[bench_.body];
        const BodyPlace start = held();
        if (bench_.gauge)
            begin_force();
        for (std::size_t i = 0; i < samples_ && !*run_.collapsed; ++i) {
            const BodyPlace now = i < motion.first ? start : place(i - motion.first);
            if (!(body.y_m + now.y_m > fallen_part * body.y_m) || !(std::fabs(now.theta_rad) < most_lean_rad)) {
                run_.collapsed = true;
                run_.collapse_time_s = run_.time_s[i];
                break;
            }
            see_blocks(whole, i, now);
            if (bench_.gauge)
                see_force(motion, i, start, now);
        }
    }

    MeasuredRun take() { return std::move(run_); }

private:
    void prepare(Series& series, double usual_sd) const
    {
        series.noise_sd = series.noise_sd.value_or(usual_sd);
        series.values.assign(samples_ * columns_, std::numeric_limits<double>::quiet_NaN());
    }

    /// Where it is held before the release, or stands at the start.
    BodyPlace held() const
    {
        const StaticState start = static_state(bench_.realization);
        return {start.x_m[bench_.body], start.y_m[bench_.body], start.theta_rad[bench_.body]};
    }

    bool present(int block) const
    {
        return run_.present.empty() || std::find(run_.present.begin(), run_.present.end(), block) != run_.present.end();
    }

    double base_m(std::size_t i) const
    {
        return run_.base_displacement_m.empty() ? 0 : run_.base_displacement_m.values[i];
    }

    void see_blocks(const Realization& whole, std::size_t i, const BodyPlace& now)
    {
        const Block& body = bench_.realization.blocks[bench_.body];
        const double sine = std::sin(now.theta_rad), cosine = std::cos(now.theta_rad);
        for (std::size_t b = 0; b < columns_; ++b) {
            if (!present(static_cast<int>(b)))
                continue;
            const Block& block = whole.blocks[static_cast<std::size_t>(built_.block[b])];
            double x = block.x_m, y = block.y_m, theta = 0;
            const auto part = std::find(bench_.blocks.begin(), bench_.blocks.end(), static_cast<int>(b));
            if (part != bench_.blocks.end()) {
                const auto [dx, dy] = bench_.centre_m[static_cast<std::size_t>(part - bench_.blocks.begin())];
                x = body.x_m + now.x_m + cosine * dx - sine * dy;
                y = body.y_m + now.y_m + sine * dx + cosine * dy;
                theta = now.theta_rad;
            }
            const std::size_t at = i * columns_ + b;
            run_.blocks.x_m.values[at] = built_.origin_x_m + x + base_m(i) + *run_.blocks.x_m.noise_sd * noise_();
            run_.blocks.y_m.values[at] = built_.origin_y_m + y + *run_.blocks.y_m.noise_sd * noise_();
            run_.blocks.theta_rad.values[at] = theta + *run_.blocks.theta_rad.noise_sd * noise_();
        }
    }

    void begin_force()
    {
        ForceGauge& gauge = run_.forces[*bench_.gauge];
        if (gauge.gain_sd == 0)
            gauge.gain_sd = sensors_.gain;
        gauge.value_n.noise_sd = gauge.value_n.noise_sd.value_or(sensors_.force_n);
        gauge.value_n.values.assign(samples_, std::numeric_limits<double>::quiet_NaN());
        gain_ = 1 + gauge.gain_sd * noise_();
    }

    void see_force(const PlannedMotion& motion, std::size_t i, const BodyPlace& start, const BodyPlace& now)
    {
        Series& value = run_.forces[*bench_.gauge].value_n;
        const std::size_t release = motion.first == 0 ? 0 : motion.first - 1;
        const double force = i < motion.first
                                 ? 0
                                 : rod_force_n(bench_, (*motion.times_s)[i - motion.first], now.x_m - start.x_m,
                                               start.theta_rad, now.theta_rad, base_m(i) - base_m(release));
        value.values[i] = gain_ * force + *value.noise_sd * noise_();
    }

    const SpecimenStructure& built_;
    const JointBench& bench_;
    const TestSensors& sensors_;
    RunNoise noise_;
    MeasuredRun run_;
    std::size_t columns_, samples_;
    double gain_ = 1;
};

} // namespace

SimulatedTests simulated_tests(const Specimen& specimen, const Study& about, std::span<const MeasuredRun> planned,
                               std::span<const TestSubject> subjects, std::uint64_t seed, const RunOptions& options,
                               Observer& observer, const TestSensors& sensors)
{
    const SpecimenStructure built = build_specimen(specimen);
    std::vector<Realization> whole;
    for (const TestSubject& subject : subjects)
        whole.push_back(draw_specimen(specimen, about, built, seed, subject.number,
                                      subject.law ? &*subject.law : nullptr, subject.causes));
    std::vector<PlannedMotion> motions;
    std::vector<JointBench> benches; // (planned x subjects), those of a run together
    std::vector<TrackingJob> jobs;
    for (const MeasuredRun& run : planned) {
        for (std::size_t s = 0; s < subjects.size(); ++s) {
            RunNoise put(seed, subjects[s].number, run, Stream::joint_test_placement);
            const double offset = specimen.placement_tolerance_m * put();
            benches.push_back(
                joint_bench(specimen, built, whole[s], run, offset, run.released_s ? sensors.level_rad * put() : 0.0));
            if (s == 0)
                motions.push_back(planned_motion(run));
            Realization& r = benches.back().realization;
            r.motion = motions.back().base;
            r.tilt = motions.back().tilt;
            if (r.tilt)
                r.base_tilt_rad = -run.base_tilt_rad.values.front(); // gravity to the right: clockwise
            r.change.offset_s = benches.back().released_s;
            r.step_s = about.run.step_fraction * safe_step_s(r) / (run.released_s ? steps_of_a_fall : 1);
            TrackingJob job;
            job.realization = r;
            job.watched_s = motions.back().times_s;
            jobs.push_back(std::move(job));
        }
    }
    SimulatedTests out;
    const TrackingReport report = track(jobs, options, observer);
    out.cost = {jobs.size(), 0, report.block_steps};
    out.complete = report.complete;
    if (!out.complete)
        return out;
    out.runs.assign(subjects.size(), std::vector<MeasuredRun>(planned.size()));
    tbb::task_arena(options.threads).execute([&] {
        in_parallel(std::size_t{0}, jobs.size(), [&](std::size_t j) {
            const std::size_t p = j / subjects.size(), s = j % subjects.size();
            Seen seen(specimen, built, benches[j], planned[p], sensors,
                      RunNoise(seed, subjects[s].number, planned[p], Stream::joint_test_noise));
            seen.see(whole[s], motions[p], report.results[j].watched);
            out.runs[s][p] = seen.take();
        });
    });
    return out;
}

} // namespace stylobate
