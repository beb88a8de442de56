/// `stylobate record`: what a ground motion is.

#include "io/records/record.hpp"
#include "ensemble/model/input_error.hpp"
#include "io/records/ground_motion.hpp"
#include "studies/cli/command.hpp"
#include "studies/report/json.hpp"
#include "studies/workflow/console.hpp"
#include "studies/workflow/file_kind.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

namespace stylobate {

namespace {

/// Header and samples state one peak, but for the digits with which each is printed.
constexpr double header_tolerance = 0.01;

/// How far the PGA of the samples is from the one that the file's own header states, in parts of the latter.
std::optional<double> header_difference(const Record& r, const IntensityMeasures& im)
{
    if (!r.header_pga_m_s2)
        return {};
    return (im.pga_m_s2 - *r.header_pga_m_s2) / *r.header_pga_m_s2;
}

/// Full width and height of a block [m].
struct BlockSize {
    double width = 0, height = 0;
};

/// @throws InputError if the text is no WIDTHxHEIGHT
BlockSize block_size(const std::string& text)
{
    BlockSize size;
    const std::size_t cross = text.find_first_of("xX");
    const auto length = [](std::string_view part, double& value) {
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        return error == std::errc() && end == part.data() + part.size() && value > 0 && value <= 100;
    };
    if (cross == std::string::npos || !length(std::string_view(text).substr(0, cross), size.width) ||
        !length(std::string_view(text).substr(cross + 1), size.height))
        throw InputError(fmt::format("--block {}: is not WIDTHxHEIGHT with lengths in (0, 100] m. Give the full width "
                                     "and height of a block in metres, such as --block 1x4.4",
                                     text));
    return size;
}

/// The report on a component.
struct Described {
    const Record& record;
    IntensityMeasures measures;
    BaselineReport baseline;
    std::vector<double> spectrum;
    std::optional<RockingMeasures> rocking;
};

constexpr double spectrum_periods_s[] = {0.1, 0.2, 0.3, 0.5, 1, 2, 3};

Json describe(const Described& d)
{
    const Record& r = d.record;
    const IntensityMeasures& im = d.measures;
    const std::vector<double>& spectrum = d.spectrum;
    Json sa = Json::list();
    for (std::size_t i = 0; i < spectrum.size(); ++i)
        sa.item(Json::object().member("period_s", spectrum_periods_s[i]).member("sa_m_s2", spectrum[i]));
    Json object = Json::object();
    object.member("file", r.file)
        .member("format", r.format)
        .member("station", r.station)
        .member("component", r.component)
        .member("orientation", r.orientation)
        .member("direction", to_string(r.direction))
        .member("title", r.title)
        .member("note", r.note.value_or(""))
        .member("unit", r.unit)
        .member("samples", r.acceleration_m_s2.size())
        .member("dt_s", r.dt_s)
        .member("duration_s", r.dt_s * static_cast<double>(r.acceleration_m_s2.size() - 1))
        .member("pga_m_s2", im.pga_m_s2);
    if (const std::optional<double> difference = header_difference(r, im))
        object.member("header_pga_m_s2", *r.header_pga_m_s2)
            .member("header_pga_difference", *difference)
            .member("header_pga_contradicts", std::fabs(*difference) > header_tolerance);
    object.member("pgv_m_s", im.pgv_m_s)
        .member("pgd_m", im.pgd_m)
        .member("pgv_per_pga_s", im.pgv_per_pga_s)
        .member("arias_m_s", im.arias_m_s)
        .member("cav_m_s", im.cav_m_s)
        .member("d5_95_s", im.d5_95_s)
        .member("predominant_frequency_hz", im.predominant_frequency_hz)
        .member("mean_frequency_hz", im.mean_frequency_hz)
        .member("sa", sa)
        .member("residual_velocity_m_s", d.baseline.residual_velocity_before_m_s)
        .member("residual_displacement_m", d.baseline.residual_displacement_before_m)
        .member("pga_change_by_correction", d.baseline.pga_change());
    if (d.rocking)
        object.member("rocking", Json::object()
                                     .member("tan_alpha", d.rocking->tan_alpha)
                                     .member("p_rad_s", d.rocking->p_rad_s)
                                     .member("pga_over_g_tan_alpha", d.rocking->pga_over_g_tan_alpha)
                                     .member("p_pgv_over_g_tan_alpha", d.rocking->p_pgv_over_g_tan_alpha)
                                     .member("omega_p_over_p", d.rocking->omega_p_over_p));
    return object;
}

void print(const Described& d)
{
    const Record& r = d.record;
    const IntensityMeasures& im = d.measures;
    const std::vector<double>& spectrum = d.spectrum;
    fmt::print("{}\n", r.file);
    fmt::print("  format       {}\n", r.format);
    if (!r.station.empty())
        fmt::print("  station      {}\n", r.station);
    fmt::print("  component    {}{}{}\n", r.component,
               r.orientation.empty() || r.orientation == r.component ? "" : ", ",
               r.orientation == r.component ? "" : r.orientation);
    fmt::print("  direction    {}\n", to_string(r.direction));
    if (!r.title.empty())
        fmt::print("  title        {}\n", r.title);
    fmt::print("  samples      {} at {} s, {:.2f} s in all, in {}\n", r.acceleration_m_s2.size(), r.dt_s,
               r.dt_s * static_cast<double>(r.acceleration_m_s2.size() - 1), r.unit);
    if (r.note)
        fmt::print("  note         {}\n", *r.note);
    fmt::print("  PGA          {:.4f} m/s2 ({:.4f} g)\n", im.pga_m_s2, im.pga_m_s2 / 9.80665);
    if (const std::optional<double> difference = header_difference(r, im)) {
        fmt::print("  its header   {:.4f} m/s2", *r.header_pga_m_s2);
        if (std::fabs(*difference) > header_tolerance)
            fmt::print(": CONTRADICTED by the samples, by {:+.4f} m/s2 ({:+.1f} %)", im.pga_m_s2 - *r.header_pga_m_s2,
                       100 * *difference);
        fmt::print("\n");
    }
    fmt::print("  PGV, PGD     {:.4f} m/s, {:.4f} m (after the baseline correction)\n", im.pgv_m_s, im.pgd_m);
    fmt::print("  PGV/PGA      {:.4f} s\n", im.pgv_per_pga_s);
    fmt::print("  baseline     {:+.4f} m/s and {:+.4f} m remain at the end of the uncorrected record; the correction "
               "changes the PGA by {:+.2f} %\n",
               d.baseline.residual_velocity_before_m_s, d.baseline.residual_displacement_before_m,
               100 * d.baseline.pga_change());
    fmt::print("  Arias        {:.4f} m/s, 5 to 95 % in {:.2f} s; CAV {:.3f} m/s\n", im.arias_m_s, im.d5_95_s,
               im.cav_m_s);
    fmt::print("  frequency    {:.3f} Hz predominant, {:.3f} Hz mean\n", im.predominant_frequency_hz,
               im.mean_frequency_hz);
    fmt::print("  Sa(T), 5 %  ");
    for (std::size_t i = 0; i < spectrum.size(); ++i)
        fmt::print(" {} s: {:.3f}{}", spectrum_periods_s[i], spectrum[i], i + 1 < spectrum.size() ? "," : " m/s2\n");
    if (d.rocking)
        fmt::print("  rocking      PGA/(g tan alpha) {:.3f}, p PGV/(g tan alpha) {:.3f}, omega_p/p {:.3f}; tan alpha "
                   "{:.4f}, p {:.4f} rad/s\n",
                   d.rocking->pga_over_g_tan_alpha, d.rocking->p_pgv_over_g_tan_alpha, d.rocking->omega_p_over_p,
                   d.rocking->tan_alpha, d.rocking->p_rad_s);
}

} // namespace

int record_command(const CommonOptions& options, const std::vector<std::string>& files,
                   const std::optional<std::string>& unit, const std::optional<std::string>& component,
                   const std::optional<std::string>& block)
{
    const BlockSize size = block ? block_size(*block) : BlockSize{};
    const std::vector<double> periods(std::begin(spectrum_periods_s), std::end(spectrum_periods_s));
    Json list = Json::list();
    int status = exit_done;
    std::size_t described = 0;
    for (const std::string& file : files) {
        try {
            check_kind(file, "record");
            const std::vector<Record> records =
                component ? std::vector<Record>{read_record(file, *component, unit)} : read_records(file, unit);
            // all of a file is computed before any of it is printed
            std::vector<Described> all;
            for (const Record& record : records) {
                all.push_back({record,
                               intensity_measures(record),
                               make_motion(record, true).baseline,
                               spectral_acceleration(record, periods),
                               {}});
                if (block)
                    all.back().rocking = rocking_measures(all.back().measures, size.width / 2, size.height / 2);
            }
            for (const Described& each : all) {
                if (options.json)
                    list.item(describe(each));
                else
                    print(each);
            }
            described += all.size();
        } catch (const InputError& error) { // the other files are reported all the same
            std::fflush(stdout);
            say_error(error.what());
            status = exit_bad_input;
        }
    }
    if (options.json && described > 0)
        fmt::print("{}\n", list.text());
    return status;
}

} // namespace stylobate
