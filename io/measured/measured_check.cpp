#include "io/measured/measured_check.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/measured/measured_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

namespace stylobate {

namespace {

class Checks {
public:
    explicit Checks(Campaign& campaign) : campaign_(campaign), specimen_(campaign.specimen) {}

    void run()
    {
        check_specimen(campaign_);
        check_laboratory(campaign_);
        check_tests(campaign_);
        for (const MeasuredRun& run : campaign_.runs) {
            check_samples(run);
            check_rest(run);
            check_collapse(run);
        }
        for (const MeasuredRun& run : campaign_.tests)
            check_samples(run);
        check_repeats();
    }

private:
    [[noreturn]] void refuse(const std::string& text) const { throw InputError(campaign_.source, 0, text); }
    void note(const std::string& place, const std::string& text)
    {
        campaign_.findings.push_back({Severity::note, place, text});
    }
    void warn(const std::string& place, const std::string& text)
    {
        campaign_.findings.push_back({Severity::warning, place, text});
    }
    static std::string at(const MeasuredRun& run, const char* what)
    {
        return fmt::format("run {}, {}", run.name, what);
    }

    // ---- one run

    void check_samples(const MeasuredRun& run)
    {
        check_numbers(run);
        check_clock(run);
        for (const SeriesName& name : series_names())
            check_series(run, name);
        check_base(run);
    }

    void check_numbers(const MeasuredRun& run) const
    {
        if (!(run.rate_hz >= 0 && run.rate_hz <= 1e6))
            refuse(fmt::format("run {}: rate_hz = {:g} is outside [0, 1e6].", run.name, run.rate_hz));
        for (const SeriesName& name : series_names())
            if (const auto noise = name.in(run).noise_sd; noise && !(*noise >= 0 && *noise < 1e6))
                refuse(fmt::format(
                    "run {}: {}: noise_sd = {:g} is not a valid deviation.\n  It is one standard deviation, in the "
                    "unit of the values.",
                    run.name, name.path, *noise));
    }

    void check_clock(const MeasuredRun& run)
    {
        const std::vector<double>& t = run.time_s;
        const std::string place = at(run, "time_s");
        std::vector<double> steps;
        for (std::size_t i = 0; i < t.size(); ++i) {
            if (!(std::abs(t[i]) < 1e7))
                refuse(fmt::format("run {}: time_s has {} at sample {}.\n  Times are seconds, and none is missing.",
                                   run.name, t[i], i));
            if (i == 0)
                continue;
            if (!(t[i] > t[i - 1]))
                refuse(fmt::format(
                    "run {}: time_s goes from {} s to {} s at sample {}.\n  A clock must increase; sort the rows.",
                    run.name, t[i - 1], t[i], i));
            steps.push_back(t[i] - t[i - 1]);
        }
        if (steps.empty())
            return;
        const double step = upper_median(steps);
        double jitter = 0;
        std::size_t gaps = 0, longest = 0;
        for (std::size_t i = 0; i < steps.size(); ++i)
            if (steps[i] > 1.5 * step) {
                ++gaps;
                if (steps[i] > steps[longest] || gaps == 1)
                    longest = i;
            } else {
                jitter = std::max(jitter, std::abs(steps[i] - step));
            }
        if (gaps > 0)
            warn(place,
                 fmt::format("the clock has {} gap{}, the longest from {:.6g} s to {:.6g} s where steps are {:g} s.",
                             gaps, gaps > 1 ? "s" : "", t[longest], t[longest + 1], step));
        constexpr double steady = 0.02; // of a step
        if (jitter > steady * step)
            note(place, fmt::format("the clock's steps differ by up to {:.0f} % from {:g} s: the base motion is "
                                    "resampled.",
                                    100 * jitter / step, step));
        if (run.rate_hz > 0 && std::abs(run.rate_hz * step - 1) > 0.02)
            warn(place, fmt::format("rate_hz is {:g} Hz and the clock has {:g} Hz: the clock is used.", run.rate_hz,
                                    1 / step));
        if (run.base_clock && run.base_clock != "cameras")
            note(at(run, "base"),
                 fmt::format("its clock (\"{}\") differs from that of the cameras: the two may have a time offset.",
                             *run.base_clock));
    }

    std::size_t columns(const SeriesName& name, const MeasuredRun& run) const
    {
        return name.per_block ? name.in(run).values.size() / std::max<std::size_t>(run.time_s.size(), 1) : 1;
    }

    void check_series(const MeasuredRun& run, const SeriesName& name)
    {
        const std::vector<double>& values = name.in(run).values;
        if (values.empty())
            return;
        const auto is_nan = [](double x) { return std::isnan(x); };
        if (std::all_of(values.begin(), values.end(), is_nan))
            refuse(fmt::format("run {}: {} is NaN everywhere.\n  Omit the data set where nothing was measured.",
                               run.name, name.path));
        const double largest = largest_of_series(name.dimension);
        for (const double value : values)
            if (std::abs(value) > largest)
                refuse(fmt::format("run {}: {} has the value {:g}, beyond {:g}.\n  Units are SI; another unit is given "
                                   "by the attribute unit. Did you mean {:.4g}?",
                                   run.name, name.path, value, largest, value / 1000));
        const std::size_t stride = columns(name, run), times = run.time_s.size();
        std::size_t end = times; // of what should be seen
        if (run.collapse_time_s > 0)
            end = static_cast<std::size_t>(std::lower_bound(run.time_s.begin(), run.time_s.end(), run.collapse_time_s) -
                                           run.time_s.begin());
        constexpr std::size_t blink = 3; // frames around a collapse
        if (end < times)
            end -= std::min(end, blink);
        for (std::size_t c = 0; c < stride; ++c) {
            if (name.per_block && !run.has(static_cast<int>(c)))
                continue;
            const std::string place =
                name.per_block ? fmt::format("run {}, {}, block {}", run.name, name.path, c) : at(run, name.path);
            std::size_t missing = 0, last = 0;
            for (std::size_t i = 0; i < times; ++i)
                if (std::isnan(values[i * stride + c]))
                    missing += i < end;
                else
                    last = i;
            if (last == 0 && std::isnan(values[c])) {
                warn(place, "it was never seen.");
                continue;
            }
            if (missing > 0)
                note(place, fmt::format("{} of {} values are missing (NaN){}.", missing, end,
                                        run.collapse_time_s > 0 ? " before the collapse" : ""));
            check_noise(run, name, c, stride, place);
        }
    }

    /// The declared noise against the samples'.
    void check_noise(const MeasuredRun& run, const SeriesName& name, std::size_t column, std::size_t stride,
                     const std::string& place)
    {
        const Series& series = name.in(run);
        if (!series.noise_sd)
            return;
        const double found = noise_of(std::span(series.values).subspan(column), stride);
        constexpr double factor = 1.5;
        if (found > factor * *series.noise_sd || (found > 0 && found < *series.noise_sd / factor))
            warn(place, fmt::format("noise_sd is {:.3g}, but the noise from sample to sample is {:.3g}{}.",
                                    *series.noise_sd, found, found < *series.noise_sd ? " (filtered before?)" : ""));
    }

    void check_base(const MeasuredRun& run)
    {
        if (run.base_source == BaseSource::command)
            note(at(run, "base"), "it is the command, not the measured motion of the table.");
        const Series& base = run.base_acceleration_m_s2;
        if (base.empty())
            return;
        check_saturation(run, base);
        if (!run.base_displacement_m.empty())
            check_displacement(run);
        if (!run.base_displacement_m.empty())
            return; // its offset was looked for there
        const std::size_t quiet = samples_at_rest(run);
        if (quiet == 0)
            return;
        double mean = 0;
        for (std::size_t i = 0; i < quiet; ++i)
            mean += base.values[i] / static_cast<double>(quiet);
        const double sd = base.noise_sd.value_or(noise_of(base.values)) / std::sqrt(static_cast<double>(quiet));
        if (std::abs(mean) > 5 * sd && std::abs(mean) > 0.01)
            warn(at(run, "base/acceleration_m_s2"),
                 fmt::format("before the motion its mean is {:.3g} m/s2, not 0 ({:.0f} deviations): an offset of the "
                             "sensor, or a table out of level by {:.2g} rad.",
                             mean, std::abs(mean) / sd, std::abs(mean) / specimen_.gravity_m_s2));
    }

    /// Flat tops: runs of one and the same extreme value.
    void check_saturation(const MeasuredRun& run, const Series& base)
    {
        const std::vector<double>& a = base.values;
        double top = 0;
        for (const double value : a)
            top = std::isfinite(value) ? std::max(top, std::abs(value)) : top;
        std::size_t flat = 0, first = 0, streak = 1;
        constexpr std::size_t shortest = 3;
        for (std::size_t i = 1; i < a.size(); ++i) {
            streak = a[i] == a[i - 1] && std::abs(a[i]) > 0.98 * top && top > 0 ? streak + 1 : 1;
            if (streak == shortest && flat == 0)
                first = i;
            flat += streak == shortest ? shortest : streak > shortest ? 1 : 0;
        }
        if (flat > 0)
            warn(at(run, "base/acceleration_m_s2"),
                 fmt::format("{} samples stay at the extreme value {:.4g} m/s2, first at {:.4g} s: the sensor is "
                             "saturated.",
                             flat, top, run.time_s[first]));
    }

    /// The doubly integrated acceleration against the displacement, both without a parabola (bias, start): their
    /// ratio, and what is left.
    void check_displacement(const MeasuredRun& run)
    {
        const std::vector<double>&t = run.time_s, &a = run.base_acceleration_m_s2.values,
              &u = run.base_displacement_m.values;
        if (std::any_of(a.begin(), a.end(), [](double x) { return std::isnan(x); }) ||
            std::any_of(u.begin(), u.end(), [](double x) { return std::isnan(x); }) || t.size() < 100)
            return;
        std::vector<double> twice(t.size());
        double speed = 0;
        for (std::size_t i = 1; i < t.size(); ++i) {
            const double d = t[i] - t[i - 1];
            twice[i] = twice[i - 1] + speed * d + d * d * (a[i - 1] / 3 + a[i] / 6);
            speed += d * (a[i - 1] + a[i]) / 2;
        }
        constexpr int degree = 3;
        check_offset(run, t, u, twice);
        const std::vector<double> p = without_polynomial(t, twice, degree), q = without_polynomial(t, u, degree);
        double pq = 0, qq = 0, pp = 0;
        for (std::size_t i = 0; i < t.size(); ++i) {
            pq += p[i] * q[i];
            qq += q[i] * q[i];
            pp += p[i] * p[i];
        }
        const double n = static_cast<double>(t.size()), size = std::sqrt(qq / n);
        const double noise = run.base_displacement_m.noise_sd.value_or(noise_of(u));
        // what white noise of the acceleration becomes in two integrations; without its best cubic a fiftieth is left
        const double span = t.back() - t.front();
        const double drift = run.base_acceleration_m_s2.noise_sd.value_or(noise_of(a)) *
                             std::sqrt(span / n * span * span * span / 3) / 50;
        if (size < 5 * (noise + drift))
            return; // too small a motion to compare
        const double ratio = pq / qq;
        const double left = std::sqrt(std::max(pp - 2 * ratio * pq + ratio * ratio * qq, 0.0) / n);
        if (std::abs(ratio - 1) > 0.02 + drift / size || left > 0.05 * size + 3 * (noise + drift))
            warn(at(run, "base"),
                 fmt::format("the acceleration integrated twice is {:.3f} of the displacement, with {} left over where "
                             "{} moved: units, gains or clocks of the two sensors differ.",
                             ratio, length_words(left), length_words(size)));
    }

    /// A constant offset of the acceleration is a parabola between its double integral and the displacement.
    void check_offset(const MeasuredRun& run, const std::vector<double>& t, const std::vector<double>& u,
                      const std::vector<double>& twice)
    {
        std::vector<double> apart(t.size()), parabola(t.size());
        for (std::size_t i = 0; i < t.size(); ++i) {
            apart[i] = twice[i] - u[i];
            parabola[i] = (t[i] - t.front()) * (t[i] - t.front()) / 2;
        }
        parabola = without_polynomial(t, parabola, 1);
        double along = 0, length = 0;
        for (std::size_t i = 0; i < t.size(); ++i) {
            along += apart[i] * parabola[i];
            length += parabola[i] * parabola[i];
        }
        const double offset = along / length;
        const double noise = run.base_acceleration_m_s2.noise_sd.value_or(noise_of(run.base_acceleration_m_s2.values));
        if (std::abs(offset) > 0.01 + 20 * noise / std::sqrt(static_cast<double>(t.size())))
            warn(at(run, "base/acceleration_m_s2"),
                 fmt::format("against the displacement it has a constant offset of {:.3g} m/s2: of the sensor, or of a "
                             "table out of level by {:.2g} rad.",
                             offset, std::abs(offset) / specimen_.gravity_m_s2));
    }

    /// What is left of values after the best polynomial in time, by Gram and Schmidt.
    static std::vector<double> without_polynomial(const std::vector<double>& t, std::vector<double> values, int degree)
    {
        std::vector<std::vector<double>> basis;
        for (int power = 0; power <= degree; ++power) {
            std::vector<double> next(t.size());
            const double middle = (t.front() + t.back()) / 2, half = (t.back() - t.front()) / 2;
            for (std::size_t i = 0; i < t.size(); ++i)
                next[i] = std::pow((t[i] - middle) / half, power);
            for (const auto& other : basis)
                project_out(next, other);
            basis.push_back(next);
            project_out(values, basis.back());
        }
        return values;
    }
    static void project_out(std::vector<double>& values, const std::vector<double>& direction)
    {
        double along = 0, length = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            along += values[i] * direction[i];
            length += direction[i] * direction[i];
        }
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] -= length > 0 ? along / length * direction[i] : 0;
    }

    /// Before the motion each block should be where it was planned: all off alike is the cameras' zero, one off among
    /// the others is a block put back badly, or a face that is not square.
    void check_rest(const MeasuredRun& run)
    {
        const std::size_t quiet = samples_at_rest(run), n = specimen_.half_width_m.size();
        if (quiet == 0 || n == 0)
            return;
        const struct {
            const Series& series;
            const std::vector<double>& planned;
            const char* name;
        } places[] = {{run.blocks.x_m, specimen_.rest_x_m, "blocks/x_m"},
                      {run.blocks.y_m, specimen_.rest_y_m, "blocks/y_m"}};
        for (const auto& [series, planned, name] : places) {
            if (series.empty() || planned.empty())
                continue;
            const bool horizontal = &series == &run.blocks.x_m;
            const double moved = horizontal && !run.base_displacement_m.empty()
                                     ? mean_seen(run.base_displacement_m.values, quiet, 0, 1)
                                     : 0;
            std::vector<double> off;
            for (std::size_t b = 0; b < n; ++b)
                off.push_back(mean_seen(series.values, quiet, b, n) - planned[b] - moved);
            if (std::any_of(off.begin(), off.end(), [](double x) { return std::isnan(x); }))
                continue;
            const double common = upper_median(off), noise = series.noise_sd.value_or(0);
            // neighbours wander from each other from the base up
            const double tolerance =
                5 * specimen_.placement_tolerance_m * std::sqrt(static_cast<double>(n)) + noise +
                (horizontal ? 0
                            : 0.01 * *std::max_element(specimen_.half_height_m.begin(), specimen_.half_height_m.end()));
            if (std::abs(common) > tolerance)
                note(at(run, name),
                     fmt::format("at rest all blocks have the same offset of {} from their nominal positions: the zero "
                                 "of the cameras{}.",
                                 length_words(common),
                                 horizontal
                                     ? " (or of the table's displacement), or the position of the specimen on the base"
                                     : ""));
            for (std::size_t b = 0; b < n; ++b)
                if (std::abs(off[b] - common) > tolerance)
                    warn(fmt::format("run {}, {}, block {}", run.name, name, b),
                         fmt::format("at rest it is {} from its nominal position relative to the others, beyond the "
                                     "tolerance of {}: inaccurate placement, a wedge under it, or its marker.",
                                     length_words(off[b] - common), length_words(tolerance)));
        }
        if (run.blocks.theta_rad.empty())
            return;
        for (std::size_t b = 0; b < n; ++b) {
            const double mean = mean_seen(run.blocks.theta_rad.values, quiet, b, n);
            constexpr double level_rad = 0.01;
            const double sd = run.blocks.theta_rad.noise_sd.value_or(0) / std::sqrt(static_cast<double>(quiet));
            if (std::abs(mean) > level_rad + 5 * sd)
                warn(fmt::format("run {}, blocks/theta_rad, block {}", run.name, b),
                     fmt::format("at rest it is rotated by {:.3g} rad: a wedge under it, or its camera marker.", mean));
        }
    }

    void check_collapse(const MeasuredRun& run)
    {
        const std::string place = at(run, "collapsed");
        if (run.collapsed.has_value() && !*run.collapsed && run.collapse_time_s >= 0)
            warn(place, fmt::format("the outcome is no collapse, but collapse_time_s = {:g}.", run.collapse_time_s));
        if (run.collapse_time_s >= 0 && !run.time_s.empty() &&
            (run.collapse_time_s < run.time_s.front() || run.collapse_time_s > run.time_s.back()))
            warn(place, fmt::format("collapse_time_s = {:g} is outside the clock, from {:g} s to {:g} s.",
                                    run.collapse_time_s, run.time_s.front(), run.time_s.back()));
        const std::size_t n = specimen_.half_width_m.size(), times = run.time_s.size();
        const std::vector<double>&theta = run.blocks.theta_rad.values, &y = run.blocks.y_m.values;
        if (!run.collapsed || n == 0 || (theta.empty() && y.empty()))
            return;
        // a block that lies on its side, or has come down by half its height; and whether all stay in sight
        bool fell = false, lost = false;
        std::size_t who = 0;
        for (std::size_t b = 0; b < n; ++b)
            for (std::size_t i = 0; i < times; ++i) {
                const double turned = theta.empty() ? 0 : std::abs(theta[i * n + b]);
                const double down = y.empty() || specimen_.rest_y_m.empty() || specimen_.half_height_m.empty()
                                        ? 0
                                        : specimen_.rest_y_m[b] - y[i * n + b] - specimen_.half_height_m[b];
                if (turned > std::numbers::pi / 4 || down > 0) {
                    who = fell ? who : b;
                    fell = true;
                }
                lost = lost || (i + 1 == times && (std::isnan(turned) || std::isnan(down)));
            }
        if (!*run.collapsed && fell)
            warn(place,
                 fmt::format("the outcome is no collapse, but block {} lies on its side or has come down.", who));
        if (*run.collapsed && !fell && !lost)
            warn(place, "the outcome is a collapse, but all blocks stay upright and visible to the end.");
    }

    // ---- among runs

    void check_repeats()
    {
        std::set<int> told;
        for (std::size_t i = 0; i < campaign_.runs.size(); ++i)
            for (std::size_t j = i + 1; j < campaign_.runs.size(); ++j) {
                const MeasuredRun &first = campaign_.runs[i], &second = campaign_.runs[j];
                if (first.motion_id != second.motion_id || told.contains(first.motion_id))
                    continue;
                if (first.repeat == second.repeat)
                    note(at(second, "repeat"), fmt::format("run {} has the same motion_id {} and repeat {}.",
                                                           first.name, first.motion_id, first.repeat));
                const std::vector<double>&a = first.base_acceleration_m_s2.values,
                      &b = second.base_acceleration_m_s2.values;
                if (a.empty() || a.size() != b.size())
                    continue;
                const double noise = std::hypot(first.base_acceleration_m_s2.noise_sd.value_or(noise_of(a)),
                                                second.base_acceleration_m_s2.noise_sd.value_or(noise_of(b)));
                double apart = 0, size = 0;
                int count = 0;
                for (std::size_t k = 0; k < a.size(); ++k)
                    if (!std::isnan(a[k]) && !std::isnan(b[k])) {
                        apart += (a[k] - b[k]) * (a[k] - b[k]);
                        size += a[k] * a[k];
                        ++count;
                    }
                apart = std::sqrt(apart / count);
                size = std::sqrt(size / count);
                constexpr double table_repeats = 0.1; // of the motion: what a shaking table does not do again
                if (apart > 3 * noise + table_repeats * size) {
                    told.insert(first.motion_id);
                    warn(at(second, "base/acceleration_m_s2"),
                         fmt::format("it repeats motion {} of run {}, but differs from it by {:.2g} m/s2 (root mean "
                                     "square) where the motion has {:.2g}: another motion, or shifted in time.",
                                     first.motion_id, first.name, apart, size));
                }
            }
    }

    Campaign& campaign_;
    const Specimen& specimen_;
};

} // namespace

void check_campaign(Campaign& campaign)
{
    Checks(campaign).run();
}

double noise_of(std::span<const double> values, std::size_t stride)
{
    constexpr int orders = 8;
    constexpr std::size_t fewest = 32;
    std::vector<double> difference;
    for (std::size_t i = 0; i < values.size(); i += stride)
        difference.push_back(values[i]);
    double least = 0, gain2 = 1; // (2p)! / (p!)2
    for (int p = 1; p <= orders; ++p) {
        gain2 *= 2.0 * (2 * p - 1) / p;
        for (std::size_t i = 0; i + 1 < difference.size(); ++i)
            difference[i] = difference[i + 1] - difference[i];
        if (!difference.empty())
            difference.pop_back();
        std::vector<double> size;
        for (const double d : difference)
            if (std::isfinite(d))
                size.push_back(std::abs(d));
        if (size.size() < fewest)
            break;
        constexpr double median_of_normal = 0.674490;
        const double sd = upper_median(std::move(size)) / median_of_normal / std::sqrt(gain2);
        least = p == 1 ? sd : std::min(least, sd);
    }
    return least;
}

double mean_seen(std::span<const double> values, std::size_t samples, std::size_t column, std::size_t stride)
{
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < samples; ++i)
        if (const double value = values[i * stride + column]; !std::isnan(value)) {
            sum += value;
            ++count;
        }
    return sum / count;
}

std::size_t samples_at_rest(const MeasuredRun& run)
{
    const Series& base = run.base_acceleration_m_s2;
    constexpr std::size_t block = 10, fewest = 20;
    if (base.empty())
        return 0;
    const double noise = base.noise_sd.value_or(noise_of(base.values));
    const double tolerance = 4 * noise * std::sqrt(2.0 / block) + 1e-9;
    std::size_t quiet = 0;
    double first = 0;
    for (; quiet + block <= base.values.size(); quiet += block) {
        double mean = 0;
        for (std::size_t i = quiet; i < quiet + block; ++i)
            mean += base.values[i] / block;
        first = quiet == 0 ? mean : first;
        if (!(std::abs(mean - first) < tolerance))
            break;
    }
    return quiet / 2 >= fewest ? quiet / 2 : 0;
}

std::vector<double> places_at_rest(const Specimen& specimen, const MeasuredRun& run, std::size_t samples)
{
    const std::size_t blocks = specimen.rest_x_m.size();
    const double shift = run.table.x_m.empty() ? 0 : mean_seen(run.table.x_m.values, samples, 0, 1);
    std::vector<double> out;
    for (std::size_t b = 0; b < blocks; ++b)
        out.push_back(mean_seen(run.blocks.x_m.values, samples, b, blocks) - specimen.rest_x_m[b] - shift);
    return out;
}

} // namespace stylobate
