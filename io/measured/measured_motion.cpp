#include "io/measured/measured_motion.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/kalman_smoother.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/files/suggest.hpp"
#include "io/measured/measured_check.hpp"
#include "io/measured/measured_file.hpp"
#include "io/measured/measured_layout.hpp"
#include "io/records/ground_motion.hpp"
#include "io/records/record_parser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace stylobate {

namespace {

using namespace kalman;

enum Sensor { accelerometer, displacement, cameras, rest, sensors };

double spacing(const MeasuredRun& run)
{
    const std::vector<double>& t = run.time_s;
    constexpr std::size_t fewest = 8;
    if (t.size() < fewest)
        throw InputError(fmt::format("run {}: {} samples are too few for a base motion; {} are needed.", run.name,
                                     t.size(), fewest));
    std::vector<double> steps;
    for (std::size_t i = 1; i < t.size(); ++i) {
        if (!(t[i] > t[i - 1]))
            throw InputError(fmt::format("run {}: the clock goes from {} s to {} s at sample {}: it must increase.",
                                         run.name, t[i - 1], t[i], i));
        steps.push_back(t[i] - t[i - 1]);
    }
    const double step = upper_median(std::move(steps));
    const double span = t.back() - t.front();
    const double intervals = std::max(std::round(span / step), 1.0);
    constexpr double most_intervals = 1e7;
    if (intervals > most_intervals)
        throw InputError(
            fmt::format("run {}: the clock spans {} s at steps of {} s: its gap is too large.", run.name, span, step));
    return span / intervals;
}

double largest_size(const std::vector<double>& values)
{
    double largest = 0;
    for (const double value : values)
        if (std::isfinite(value))
            largest = std::max(largest, std::abs(value));
    return largest;
}

bool measured(const Series& series, std::size_t times)
{
    return series.values.size() == times &&
           std::any_of(series.values.begin(), series.values.end(), [](double x) { return std::isfinite(x); });
}

/// So many samples at the beginning (or the end) in which nothing but noise is seen: blocks whose mean is that of the
/// first one, and of these only the nearer half: a motion that swells hides in the noise at first.
std::size_t quiet_samples(const std::vector<double>& values, double noise, bool at_end)
{
    constexpr std::size_t block = 20;
    constexpr double far = 4; // deviations of the difference of two means
    const double tolerance = far * noise * std::sqrt(2.0 / block);
    const auto mean = [&](std::size_t b) {
        double sum = 0;
        for (std::size_t i = b * block; i < (b + 1) * block; ++i)
            sum += values[at_end ? values.size() - 1 - i : i];
        return sum / block;
    };
    const std::size_t blocks = values.size() / block;
    std::size_t quiet = 0;
    while (quiet < blocks && std::abs(mean(quiet) - mean(0)) < tolerance) // false where a value is missing
        ++quiet;
    return quiet * block / 2;
}

/// The largest change (order 1) or bend (order 2) of samples over a hundredth of the run, per time to that power.
double largest_rate(const std::vector<double>& values, double dt_s, int order)
{
    const std::size_t stride = std::max<std::size_t>(values.size() / 100, 1);
    double largest = 0;
    for (std::size_t i = 2 * stride; i < values.size(); ++i) {
        const double change =
            order == 1 ? values[i] - values[i - stride] : values[i] - 2 * values[i - stride] + values[i - 2 * stride];
        if (std::isfinite(change))
            largest = std::max(largest, std::abs(change));
    }
    return largest / std::pow(static_cast<double>(stride) * dt_s, order);
}

double first_value(const std::vector<double>& values)
{
    const auto at = std::find_if(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
    return at == values.end() ? 0 : *at;
}

class Setup {
public:
    Setup(const MeasuredRun& run, MeasuredMotion& result) : run_(run), result_(result)
    {
        problem.dt_s = spacing(run);
        const double span = run.time_s.back() - run.time_s.front();
        problem.at.resize(static_cast<std::size_t>(std::lround(span / problem.dt_s)) + 1);
        const std::size_t times = run.time_s.size();
        const bool seen = measured(run.table.x_m, times);
        const bool displaced = measured(run.base_displacement_m, times);
        const bool accelerated = measured(run.base_acceleration_m_s2, times);
        if (!seen && !displaced && !accelerated)
            throw InputError(fmt::format("run {}: nothing of the base was measured: neither acceleration nor "
                                         "displacement nor the cameras' view of the table.",
                                         run.name));
        start(seen, displaced, accelerated);
        if (accelerated)
            add(accelerometer, run.base_acceleration_m_s2, result.accelerometer);
        if (displaced)
            add(displacement, run.base_displacement_m, result.displacement);
        if (seen)
            add(cameras, run.table.x_m, result.cameras);
        if (!seen && !displaced)
            add_rest();
    }

    Problem problem;

private:
    /// What is known before: next to nothing, but in numbers of the size of the motion, lest rounding eat the rest.
    void start(bool seen, bool displaced, bool accelerated)
    {
        const auto square = [](double x) { return x * x; };
        constexpr double wide = 10, largest_bias_m_s2 = 1;
        const Series& place = displaced ? run_.base_displacement_m : run_.table.x_m;
        const double dt = problem.dt_s;
        Vector& variance = problem.start_variance;
        double acceleration = largest_size(run_.base_acceleration_m_s2.values);
        if (seen || displaced) {
            const double reach = wide * noise(place) + largest_rate(place.values, dt, 1) * dt;
            problem.start_mean[u] = first_value(place.values);
            variance[u] = square(wide * reach);
            variance[v] = square(wide * (largest_rate(place.values, dt, 1) + noise(place)));
            acceleration = std::max(acceleration, largest_rate(place.values, dt, 2));
        } else {
            result_.assumed_at_rest = true;
        }
        acceleration += noise(run_.base_acceleration_m_s2);
        variance[a] = square(wide * acceleration);
        variance[j] = square(wide * acceleration / (10 * dt));
        if (accelerated)
            variance[bias] = square(largest_bias_m_s2);
        if (seen && displaced) {
            problem.start_mean[zero] = first_value(run_.table.x_m.values) - problem.start_mean[u];
            variance[zero] = square(
                wide * (wide * (noise(place) + noise(run_.table.x_m)) + largest_rate(place.values, dt, 1) * wide * dt));
        }
    }

    /// As declared, else from the samples; a sensor without any noise is none: its last digit is left.
    static double noise(const Series& series)
    {
        const double least = 1e-7 * std::max(largest_size(series.values), 1e-6);
        const bool declared = series.noise_sd && *series.noise_sd > 0;
        return std::max(declared ? *series.noise_sd : noise_of(series.values), least);
    }

    void add(Sensor sensor, const Series& series, SensorFit& fit)
    {
        fit.noise_sd = noise(series);
        for (std::size_t i = 0; i < series.values.size(); ++i) {
            if (!std::isfinite(series.values[i]))
                continue;
            ++fit.samples;
            const double position = (run_.time_s[i] - run_.time_s.front()) / problem.dt_s;
            constexpr double rounding = 1e-6; // of a clock: a sample at a grid step is not in the interval before it
            const double k = std::clamp(std::floor(position + rounding), 0.0, static_cast<double>(problem.steps() - 1));
            const double s = std::max(position - k, 0.0) * problem.dt_s;
            Vector row{};
            if (sensor == accelerometer)
                row = {0, 0, 1, s, 1, 0};
            else
                row = {1, s, s * s / 2, s * s * s / 6, 0, sensor == cameras ? 1.0 : 0.0};
            if (sensor == cameras && result_.displacement.samples == 0)
                row[zero] = 0;
            problem.at[static_cast<std::size_t>(k)].push_back(
                {sensor, row, series.values[i], fit.noise_sd * fit.noise_sd});
        }
    }

    /// Where only the acceleration is known the table rests before and after it.
    void add_rest()
    {
        constexpr double at_rest_m_s = 1e-4;
        const Measurement still{rest, {0, 1, 0, 0, 0, 0}, 0, at_rest_m_s * at_rest_m_s};
        const std::vector<double>& values = run_.base_acceleration_m_s2.values;
        const std::size_t n = problem.steps();
        const std::size_t head = quiet_samples(values, result_.accelerometer.noise_sd, false);
        const std::size_t tail = quiet_samples(values, result_.accelerometer.noise_sd, true);
        for (std::size_t k = 0; k < std::min(head, n); ++k)
            problem.at[k].push_back(still);
        for (std::size_t k = 0; k < std::min(tail, n - std::min(head, n)); ++k)
            problem.at[n - 1 - k].push_back(still);
    }

    const MeasuredRun& run_;
    MeasuredMotion& result_;
};

void measure_misfit(const Problem& problem, const Smoothed& smoothed, Sensor sensor, SensorFit& fit)
{
    double squares = 0;
    for (std::size_t k = 0; k < problem.steps(); ++k)
        for (const Measurement& m : problem.at[k])
            if (m.source == sensor) {
                const double misfit = m.value - dot(m.row, smoothed.mean[k]);
                squares += misfit * misfit;
            }
    if (fit.samples > 0)
        fit.misfit_sd = std::sqrt(squares / fit.samples);
}

/// Velocity and displacement anew from the acceleration, by the rule of `Motion`, to the last bit.
void integrate(Motion& motion, double u0, double v0)
{
    const double d = motion.dt_s;
    double v1 = v0, u1 = u0;
    for (std::size_t i = 0; i < motion.acceleration_m_s2.size(); ++i) {
        if (i > 0) {
            const double a0 = motion.acceleration_m_s2[i - 1], a1 = motion.acceleration_m_s2[i];
            u1 += v1 * d + d * d * (a0 / 3 + a1 / 6);
            v1 += d * (a0 + a1) / 2;
        }
        motion.velocity_m_s.push_back(v1);
        motion.displacement_m.push_back(u1);
    }
}

} // namespace

MeasuredMotion smoothed_base_motion(const MeasuredRun& run)
{
    MeasuredMotion result;
    const Problem problem = Setup(run, result).problem;
    double white = 0, walk = 0;
    const Process rough = likeliest(problem, false, white), even = likeliest(problem, true, walk);
    const Process process = walk > white ? even : rough;

    const Smoothed smoothed = kalman::smoothed(problem, process);
    Motion& motion = result.motion;
    motion.dt_s = problem.dt_s;
    for (std::size_t k = 0; k < problem.steps(); ++k) {
        motion.acceleration_m_s2.push_back(smoothed.mean[k][a]);
        result.displacement_sd_m.push_back(std::sqrt(smoothed.variance[k][u]));
        result.acceleration_sd_m_s2.push_back(std::sqrt(smoothed.variance[k][a]));
    }
    integrate(motion, smoothed.mean[0][u], smoothed.mean[0][v]);
    motion.pga_m_s2 = largest_size(motion.acceleration_m_s2);
    motion.predominant_frequency_hz = predominant_frequency(motion.acceleration_m_s2, motion.dt_s);
    motion.corrected = true;
    motion.baseline.pga_before_m_s2 = largest_size(run.base_acceleration_m_s2.values);
    motion.baseline.pga_m_s2 = motion.pga_m_s2;
    motion.baseline.pgv_m_s = largest_size(motion.velocity_m_s);
    motion.baseline.pgd_m = largest_size(motion.displacement_m);
    motion.source = "run " + run.name;

    measure_misfit(problem, smoothed, accelerometer, result.accelerometer);
    measure_misfit(problem, smoothed, displacement, result.displacement);
    measure_misfit(problem, smoothed, cameras, result.cameras);
    if (result.accelerometer.samples > 0) {
        result.accelerometer.offset = smoothed.mean[0][bias];
        result.accelerometer.offset_sd = std::sqrt(smoothed.variance[0][bias]);
    }
    if (result.cameras.samples > 0 && result.displacement.samples > 0) {
        result.cameras.offset = smoothed.mean[0][zero];
        result.cameras.offset_sd = std::sqrt(smoothed.variance[0][zero]);
    }
    return result;
}

Motion base_motion_of(const MeasuredRun& run)
{
    return smoothed_base_motion(run).motion;
}

namespace {

constexpr const char* time_name = "time_s";
constexpr const char* acceleration_name = "acceleration_m_s2";
constexpr const char* displacement_name = "displacement_m";

/// Whether the first column is "time_s" or in another unit of time, which the reader of columns converts.
bool is_time(const ColumnTable& table)
{
    const std::string name = lower_case(table.names.front());
    return name == time_name || name == "time_ms" || name == "time_us";
}

/// A quantity that is read, and how its column begins.
struct Quantity {
    const char* stem;
    Dimension dimension;
};
constexpr Quantity acceleration_of_base = {"acceleration", Dimension::acceleration};
constexpr Quantity displacement_of_base = {"displacement", Dimension::length};

/// SI in the unit of a column "displacement_mm"; none if it is not of this quantity, or its unit is not known.
std::optional<double> unit_of(std::string_view name, const Quantity& quantity)
{
    const std::string lower = lower_case(name);
    const std::string stem = std::string(quantity.stem) + "_";
    return lower.starts_with(stem) ? unit_in_si(std::string_view(lower).substr(stem.size()), quantity.dimension)
                                   : std::nullopt;
}

/// The column of a quantity, in SI; empty if there is none.
std::vector<double> column(const RecordText& text, const ColumnTable& table, const Quantity& quantity)
{
    std::vector<double> values;
    for (std::size_t c = 1; c < table.columns.size(); ++c) {
        const std::optional<double> unit = unit_of(table.names[c], quantity);
        if (!unit)
            continue;
        if (!values.empty())
            text.refuse(fmt::format("has two columns of the {}.", quantity.stem));
        values = table.columns[c];
        for (double& value : values)
            value *= *unit;
    }
    return values;
}

/// A name that is nearly one of those that are read is a slip.
void check_names(const RecordText& text, const ColumnTable& table)
{
    const std::vector<std::string> known = {time_name, acceleration_name, displacement_name};
    const auto is_read = [](const std::string& name) {
        return unit_of(name, acceleration_of_base) || unit_of(name, displacement_of_base);
    };
    for (const std::string& name : table.names) {
        const auto meant = meant_key(lower_case(name), known);
        const bool there = std::any_of(table.names.begin(), table.names.end(),
                                       [&](const std::string& other) { return lower_case(other) == meant; });
        if (!meant || is_read(name) || there || (meant == time_name && is_time(table)))
            continue;
        // with the unit of the file: with another one its values would be others by a factor
        for (std::size_t line = name.find('_'); line != std::string::npos; line = name.find('_', line + 1))
            if (const std::string same_unit = std::string(without_unit(*meant)) + name.substr(line); is_read(same_unit))
                text.refuse(fmt::format("has a column \"{}\". Did you mean {}? The unit is part of the name.", name,
                                        same_unit));
        text.refuse(fmt::format("has a column \"{}\". Did you mean {}? The unit is part of the name: times are in {}, "
                                "accelerations in {}, displacements in {}.",
                                name, *meant, known_units(Dimension::time), known_units(Dimension::acceleration),
                                known_units(Dimension::length)));
    }
    const char* todo = "Give a line of names above the rows: time_s first, then acceleration_m_s2 or displacement_m.";
    if (!is_time(table))
        text.refuse(fmt::format("begins with the column \"{}\", not with time_s. {}", table.names.front(), todo));
    if (std::none_of(table.names.begin(), table.names.end(), is_read))
        text.refuse(fmt::format("has no motion: its columns are {}. {}", fmt::join(table.names, ", "), todo));
}

void check_peak(const Motion& motion, const std::filesystem::path& file)
{
    if (!(motion.pga_m_s2 <= largest_pga_m_s2))
        throw InputError(
            file.string(), 0,
            fmt::format("the motion has a peak acceleration of {:.4g} m/s2, more than {}: a unit is "
                        "wrong, or displacements have too few digits.\n  If it is right: study.allow = [\"pga\"].",
                        motion.pga_m_s2, largest_pga_m_s2));
}

Motion of_campaign(const std::filesystem::path& file, const std::string& run)
{
    const Campaign campaign = read_campaign(file);
    std::vector<std::string> names;
    for (const MeasuredRun& measured : campaign.runs) {
        if (measured.name == run)
            return base_motion_of(measured);
        names.push_back(measured.name);
    }
    for (const MeasuredRun& test : campaign.tests)
        if (test.name == run)
            throw InputError(
                file.string(), 0,
                fmt::format("run \"{}\" is {}, not the shaking of a free specimen.\n  Name a shake run: {}.", run,
                            test_words(test), fmt::join(names, ", ")));
    throw InputError(file.string(), 0, fmt::format("has no run \"{}\". It has: {}.", run, fmt::join(names, ", ")));
}

Motion of_columns(const std::filesystem::path& file, PgaRange pga)
{
    const std::string content = content_of(file, "a table of the base motion");
    const RecordText text = lines_of(file.string(), content);
    refuse_decimal_commas(text);
    const ColumnTable table = read_columns(text);
    check_names(text, table);
    const std::vector<double> accelerations = column(text, table, acceleration_of_base);
    const std::vector<double> displacements = column(text, table, displacement_of_base);
    const std::vector<double>* acceleration = accelerations.empty() ? nullptr : &accelerations;
    const std::vector<double>* displacement = displacements.empty() ? nullptr : &displacements;
    for (const auto& [values, name, dimension] : {std::tuple{acceleration, acceleration_name, Dimension::acceleration},
                                                  {displacement, displacement_name, Dimension::length}}) {
        if (values == nullptr)
            continue;
        if (values->size() < fewest_samples)
            text.refuse(fmt::format("has {} samples; at least {} are required.", values->size(), fewest_samples));
        const auto [least, most] = std::minmax_element(values->begin(), values->end());
        if (*least == *most && (values == displacement || *least == 0))
            text.refuse(fmt::format("its {} is {} at all times: there is no motion.", name, *least));
        const double reached = std::max(-*least, *most), largest = largest_of_series(dimension);
        if (reached > largest)
            text.refuse(fmt::format("its {} reaches {:.4g}, more than {}: a unit is wrong.", name, reached, largest));
    }
    if (acceleration && displacement) {
        MeasuredRun run;
        run.name = file.string();
        run.time_s = table.columns.front();
        run.base_acceleration_m_s2.values = *acceleration;
        run.base_displacement_m.values = *displacement;
        Motion motion = base_motion_of(run);
        if (pga == PgaRange::usual)
            check_peak(motion, file);
        return motion;
    }
    Motion motion =
        motion_of(acceleration ? *acceleration : acceleration_through(*displacement, table.dt_s), table.dt_s);
    if (!acceleration && pga == PgaRange::usual) // a base that is hit is faster than any ground
        check_peak(motion, file);
    return motion;
}

} // namespace

Motion read_base_table(const std::filesystem::path& file, const std::optional<std::string>& run, PgaRange pga)
{
    Motion motion = run ? of_campaign(file, *run) : of_columns(file, pga);
    if (run && pga == PgaRange::usual)
        check_peak(motion, file);
    if (!(motion.predominant_frequency_hz > 0))
        motion.predominant_frequency_hz = predominant_frequency(motion.acceleration_m_s2, motion.dt_s);
    motion.source = run ? fmt::format("{}, run {}", file.string(), *run) : file.string();
    return motion;
}

} // namespace stylobate
