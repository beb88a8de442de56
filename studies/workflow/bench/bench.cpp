#include "studies/workflow/bench/bench.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"
#include "studies/report/words.hpp"
#include "studies/workflow/bench/scenes.hpp"
#include "studies/workflow/bench/warm_kernel.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>

namespace stylobate {

namespace {

constexpr double least_seconds = 1, most_seconds = 600;
constexpr std::size_t most_repeats = 15;
constexpr int specimen_blocks = 7;

using BenchClock = std::chrono::steady_clock;

double seconds_since(BenchClock::time_point begin)
{
    return std::chrono::duration<double>(BenchClock::now() - begin).count();
}

/// A rate of the kernel or of the lanes of one thread. Each is of some 20 ms, so that the clock does not count.
using Rate = std::function<double()>;
constexpr double sample_s = 0.02;

Rate peak_rate(Isa isa)
{
    return [isa] {
        constexpr long count = 2'000'000;
        double done = 0;
        const auto begin = BenchClock::now();
        volatile double kept = 0; // so that nothing is removed
        do {
            kept = kept + kernels(isa).peak_fma(count);
            done += 2.0 * count * kernels(isa).lanes;
        } while (seconds_since(begin) < sample_s);
        return done / seconds_since(begin);
    };
}

/// The steps alone.
Rate kernel_rate(Isa isa)
{
    return [warm = std::make_shared<WarmKernel>(isa, specimen_blocks)] {
        constexpr int chunks = 50; // from one start: it must not walk away in time
        double done = 0, seconds = 0;
        while (seconds < sample_s) {
            warm->restart();
            const auto begin = BenchClock::now();
            for (int chunk = 0; chunk < chunks; ++chunk)
                warm->run();
            seconds += seconds_since(begin);
            done += static_cast<double>(chunks) * warm->block_steps();
        }
        return done / seconds;
    };
}

/// Lanes as the ensemble runs them: base motion, steps, and the check of each realization after every chunk.
Rate lanes_rate(Isa isa)
{
    return [isa] {
        const Study study = rocking_column(specimen_blocks);
        const Sampler sampler(study, nullptr);
        LaneSet lanes(study, nullptr, kernels(isa), sampler.realization(0), study.realizations);
        std::uint64_t next = 0;
        const auto start = [&](int lane) {
            lanes.clear(lane);
            lanes.load(lane, sampler.realization(next++));
        };
        for (int lane = 0; lane < lanes.lanes(); ++lane)
            start(lane);
        for (int chunk = 0; chunk < 100; ++chunk)
            lanes.advance();
        const double per_chunk = static_cast<double>(lanes.lanes()) * (specimen_blocks - 1) * chunk_steps;
        double done = 0;
        const auto begin = BenchClock::now();
        while (seconds_since(begin) < sample_s) {
            lanes.advance();
            done += per_chunk;
            for (int lane = 0; lane < lanes.lanes(); ++lane)
                if (lanes.outcome(lane))
                    start(lane);
        }
        return done / seconds_since(begin);
    };
}

/// A column of six round drums in space with the sizes and the contacts of the specimen, under two components at once.
Study column_in_space(int realizations)
{
    return parse_study(fmt::format(R"([study]
kind = "surface"
realizations = {}
[structure]
dimensions = 3
kind = "column"
shape = "round"
blocks = 6
drum_width_m = 0.048
drum_height_m = 0.029
density_kg_m3 = 2030
[contact]
normal_stiffness_n_m3 = 2e9
friction = 0.68
[excitation]
kind = "harmonic"
cycles = 10
second_ratio = 0.8
[surface]
frequency_hz = {{ from = 1.0, to = 10.0, count = 4, spacing = "log" }}
pga_m_s2 = {{ from = 1.0, to = 12.0, count = 4, spacing = "linear" }}
[perturbation]
friction = {{ distribution = "normal", cov = 0.10, per = "joint" }}
)",
                                   realizations),
                       "the column in space");
}

Study rigid_surface_of(int realizations)
{
    Study study = small_surface(realizations);
    make_rigid(study, usual_accuracy);
    return study;
}

/// A structure whose ensemble is measured.
struct BenchScene {
    const char* name;
    Study (*study)(int realizations); ///< in each of its 16 cells
    int per_lane;                     ///< realizations of each lane of a thread; with one thread twice as many
};

const BenchScene scenes[] = {{"seven-drum column, rigid contacts", rigid_surface_of, 8},
                             {"two columns of two drums and an epistyle, followed to rest",
                              [](int n) { return as_small_surface(shaken_colonnade(2, 2, 4), n); }, 4},
                             {"column of six round drums in space, two components", column_in_space, 4}};

/// The measurements in their order, each with its share of the time.
class Bench {
public:
    Bench(double seconds, int measurements, WorkObserver& observer)
        : each_s_(seconds / measurements), observer_(observer), quiet_(observer)
    {
        progress_.total = static_cast<std::uint64_t>(measurements);
    }

    bool stopped() { return observer_.stop_requested(); }
    double seconds() const { return seconds_since(begin_); }

    /// Repeats one measurement until its time is over. @param once measures; it may be stopped
    template <class Once>
    void measure(const std::string& what, const Once& once)
    {
        const auto begin = BenchClock::now();
        std::size_t repeats = 0;
        for (double longest = 0; !stopped() && repeats < most_repeats; ++repeats) {
            const auto before = BenchClock::now();
            if (repeats > 0 && seconds_since(begin) + longest > each_s_)
                break;
            once();
            longest = std::max(longest, seconds_since(before));
        }
        ++progress_.done;
        progress_.seconds = seconds();
        progress_.rate = static_cast<double>(progress_.done) / progress_.seconds;
        observer_.counted("measurements",
                          fmt::format("{} of {} measurements: {}", progress_.done, progress_.total, what), progress_);
    }

    void measure(const std::string& what, Repeats& into, const Rate& rate)
    {
        measure(what, [&] { into.values.push_back(rate()); });
    }

    /// With one thread and with all. @param per_lane as of `BenchScene`
    void measure(const std::string& what, Study (*study)(int), int per_lane, Isa isa, int threads,
                 std::vector<EnsembleSpeed>& into)
    {
        for (const int n : threads > 1 ? std::vector<int>{1, threads} : std::vector<int>{1}) {
            const int cells = 16, lanes = kernels(isa).lanes * std::max(2, n);
            const Experiment experiment(study(std::max(1, per_lane * lanes / cells)));
            RunPlan plan;
            plan.total = experiment.study().total();
            plan.sink = [](const Realization&, const Outcome&) {};
            EnsembleSpeed speed{.threads = n, .realizations = plan.total};
            measure(fmt::format("{}, {}", what, n == 1 ? "1 thread" : fmt::format("{} threads", n)), [&] {
                const Progress end = run_ensemble(experiment, {isa, n}, plan, quiet_);
                if (end.done < end.total) // it was stopped
                    return;
                speed.per_s.values.push_back(static_cast<double>(end.done) / end.seconds);
                speed.block_steps_per_s.values.push_back(static_cast<double>(end.block_steps) / end.seconds);
            });
            into.push_back(std::move(speed));
        }
    }

private:
    const double each_s_;
    WorkObserver& observer_;
    StopOnly quiet_;
    Progress progress_;
    const BenchClock::time_point begin_ = BenchClock::now();
};

std::string millions_text(const Repeats& rate)
{
    const auto text = [](double value) { return rate_text(value / 1e6); };
    return fmt::format("{} ({} to {})", text(rate.median()), text(rate.lowest()), text(rate.best()));
}

std::string per_second_text(const Repeats& rate)
{
    return fmt::format("{} ({} to {})", rate_text(rate.median()), rate_text(rate.lowest()), rate_text(rate.best()));
}

Json repeats_json(const Repeats& rate)
{
    return Json::object()
        .member("median", rate.median())
        .member("lowest", rate.lowest())
        .member("highest", rate.best())
        .member("repeats", rate.values.size());
}

Json surface_json(const std::vector<EnsembleSpeed>& surface)
{
    return json_list(surface, [](const EnsembleSpeed& speed) {
        return Json::object()
            .member("threads", speed.threads)
            .member("realizations", speed.realizations)
            .member("realizations_per_s", repeats_json(speed.per_s))
            .member("block_steps_per_s", repeats_json(speed.block_steps_per_s));
    });
}

/// The rate of the steps without vectors; 0: it was not measured.
double scalar_steps(const BenchReport& report)
{
    const IsaSpeed& first = report.sets.front();
    return first.isa == Isa::scalar ? first.steps.median() : 0;
}

} // namespace

double Repeats::median() const
{
    std::vector<double> sorted = values;
    std::ranges::sort(sorted);
    const std::size_t n = sorted.size();
    return n % 2 == 1 ? sorted[n / 2] : (sorted[n / 2 - 1] + sorted[n / 2]) / 2;
}

double Repeats::lowest() const
{
    return std::ranges::min(values);
}

double Repeats::best() const
{
    return std::ranges::max(values);
}

double IsaSpeed::of_the_peak() const
{
    return specimen_operations * steps.best() / peak.best();
}

std::vector<SpeedRow> BenchReport::rows() const
{
    std::vector<SpeedRow> rows;
    for (const IsaSpeed& set : sets)
        rows.push_back(
            {.processor = machine.processor,
             .threads = threads,
             .isa = to_string(set.isa),
             .steps = set.steps.best(),
             .of_the_peak = set.of_the_peak(),
             .times_scalar = sets.front().isa == Isa::scalar ? set.steps.best() / sets.front().steps.best() : 0,
             .with_all = set.with_all.best(),
             .one_thread = set.surface.front().per_s.best(),
             .all_threads = threads > 1 ? set.surface.back().per_s.best() : 0});
    return rows;
}

std::optional<BenchReport> run_bench(const BenchRequest& request, const Machine& machine, WorkObserver& observer)
{
    if (!(request.seconds >= least_seconds && request.seconds <= most_seconds))
        throw InputError(
            fmt::format("--seconds {}: a measurement takes {} to {} s", request.seconds, least_seconds, most_seconds));
    const std::vector<Isa> sets = machine.simd == "auto" ? usable_isas() : std::vector<Isa>{machine.isa()};
    BenchReport report{.machine = machine_facts(), .threads = machine.thread_count()};
    observer.begin();
    if (report.machine.busy())
        observer.warn(fmt::format("the load of the machine is {:.2f}: other programs use more than half of its cores, "
                                  "so that the rates are too low. Run it on an idle machine.",
                                  *report.machine.load));
    const int ensembles = report.threads > 1 ? 2 : 1;
    const int measurements =
        static_cast<int>(sets.size()) * (3 + ensembles) + static_cast<int>(std::size(scenes)) * ensembles;
    Bench bench(request.seconds, measurements, observer);
    for (const Isa isa : sets) {
        IsaSpeed& set = report.sets.emplace_back();
        const std::string name = to_string(set.isa = isa);
        bench.measure(name + ", peak", set.peak, peak_rate(isa));
        bench.measure(name + ", steps", set.steps, kernel_rate(isa));
        bench.measure(name + ", with base motion and checks", set.with_all, lanes_rate(isa));
        bench.measure(name + ", small surface", small_surface, 32, isa, report.threads, set.surface);
    }
    for (const BenchScene& scene : scenes) {
        StructureSpeed& structure = report.structures.emplace_back(StructureSpeed{scene.name});
        bench.measure(scene.name, scene.study, scene.per_lane, sets.back(), report.threads, structure.surface);
    }
    if (bench.stopped())
        return std::nullopt;
    report.seconds = bench.seconds();
    return report;
}

std::string bench_text(const BenchReport& r)
{
    std::string text = machine_text(r.machine);
    const std::string all = r.threads > 1 ? fmt::format("{} threads", r.threads) : "";
    text += fmt::format("threads: {}\n\nMedian (lowest to highest) of the repeats, in {}.\n\nThe seven-drum column: "
                        "million block-steps/s of one thread; realizations/s of a small surface\n",
                        r.threads, duration_text(r.seconds));
    const auto line = [&](const auto&... cells) {
        std::string columns = fmt::format("{:<16} {:<20} {:<12} {:<13} {:<20} {:<22} {}", cells...);
        text += columns.substr(0, columns.find_last_not_of(' ') + 1) + "\n";
    };
    line("instruction set", "steps", "of the peak", "times scalar", "with all", "1 thread", all);
    for (const IsaSpeed& set : r.sets)
        line(to_string(set.isa), millions_text(set.steps), fmt::format("{:.0f} %", 100 * set.of_the_peak()),
             scalar_steps(r) > 0 ? fmt::format("{:.1f}", set.steps.median() / scalar_steps(r)) : "",
             millions_text(set.with_all), per_second_text(set.surface.front().per_s),
             r.threads > 1 ? per_second_text(set.surface.back().per_s) : "");
    text += fmt::format("\nSmall surfaces of other structures with {}: million block-steps/s; realizations/s\n",
                        to_string(r.sets.back().isa));
    for (const StructureSpeed& structure : r.structures)
        for (const EnsembleSpeed& speed : structure.surface)
            text += fmt::format("{:<60} {:>2} {:<8} {:<20} {}\n", structure.name, speed.threads,
                                speed.threads == 1 ? "thread" : "threads", millions_text(speed.block_steps_per_s),
                                per_second_text(speed.per_s));
    return text;
}

std::string bench_markdown(const BenchReport& report)
{
    std::string text = speed_head();
    for (const SpeedRow& row : report.rows())
        text += speed_row(row);
    return text;
}

Json bench_json(const BenchReport& r)
{
    Json json = Json::object();
    json.member("machine", machine_json(r.machine)).member("threads", r.threads).member("seconds", r.seconds);
    json.member("instruction_sets", json_list(r.sets, [&](const IsaSpeed& set) {
                    return Json::object()
                        .member("simd", to_string(set.isa))
                        .member("lanes", kernels(set.isa).lanes)
                        .member("peak_operations_per_s", repeats_json(set.peak))
                        .member("steps_block_steps_per_s", repeats_json(set.steps))
                        .member("of_the_peak", set.of_the_peak())
                        .member("with_all_block_steps_per_s", repeats_json(set.with_all))
                        .member("surface", surface_json(set.surface));
                }));
    return json.member(
        "structures", json_list(r.structures, [](const StructureSpeed& structure) {
            return Json::object().member("name", structure.name).member("surface", surface_json(structure.surface));
        }));
}

} // namespace stylobate
