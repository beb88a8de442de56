#pragma once
/// Measured campaigns made by formula, for the tests of their files, checks and motions.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/input_error.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace stylobate {

inline constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

/// A column of equal drums on a fixed one, small enough for a shaking table.
inline Specimen sample_specimen(int drums = 3)
{
    Specimen specimen;
    specimen.name = "sample \"A\"";
    specimen.friction_nominal = 0.68;
    specimen.placement_tolerance_m = 0.0002;
    specimen.base_block_half_width_m = 0.024;
    specimen.base_block_top_m = 0.029;
    for (int i = 0; i < drums; ++i) {
        specimen.half_width_m.push_back(0.024);
        specimen.half_height_m.push_back(0.0145);
        specimen.depth_m.push_back(0.048);
        specimen.mass_kg.push_back(0.1355);
        specimen.rest_x_m.push_back(0);
        specimen.rest_y_m.push_back(0.029 * (i + 1) + 0.0145);
        specimen.joints.emplace_back(i - 1, i);
    }
    return specimen;
}

/// A smooth motion, from rest to rest: u = A (1 - cos(2 pi f t)) sin2(pi t / T) of duration T after a quiet start.
struct SampleMotion {
    double amplitude_m = 0.005, frequency_hz = 2, start_s = 0.3, duration_s = 2.4;

    double displacement_m(double t) const
    {
        const double s = t - start_s;
        if (s <= 0 || s >= duration_s)
            return 0;
        const double window = std::pow(std::sin(std::numbers::pi * s / duration_s), 4);
        return amplitude_m * window * std::sin(2 * std::numbers::pi * frequency_hz * s);
    }
    /// By Richardson's central differences: to 1e-9 of the peak.
    double acceleration_m_s2(double t) const
    {
        const auto second = [&](double h) {
            return (displacement_m(t + h) - 2 * displacement_m(t) + displacement_m(t - h)) / (h * h);
        };
        return (4 * second(5e-4) - second(1e-3)) / 3;
    }
};

/// A run in which the blocks go with the table.
inline MeasuredRun sample_run(const Specimen& specimen, const std::string& name, unsigned seed,
                              const SampleMotion& motion = {}, double rate_hz = 500, double duration_s = 3)
{
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    MeasuredRun run;
    run.name = name;
    run.kind = "harmonic";
    run.rate_hz = rate_hz;
    run.collapsed = false;
    run.base_acceleration_m_s2.noise_sd = 0.02;
    run.base_displacement_m.noise_sd = 2e-5;
    run.blocks.x_m.noise_sd = run.blocks.y_m.noise_sd = 5e-5;
    run.blocks.theta_rad.noise_sd = 1e-3;
    const int samples = static_cast<int>(std::lround(duration_s * rate_hz)) + 1;
    for (int i = 0; i < samples; ++i) {
        const double t = i / rate_hz, u = motion.displacement_m(t);
        run.time_s.push_back(t);
        run.base_acceleration_m_s2.values.push_back(motion.acceleration_m_s2(t) + 0.02 * normal(random));
        run.base_displacement_m.values.push_back(u + 2e-5 * normal(random));
        for (int b = 0; b < specimen.blocks(); ++b) {
            const auto block = static_cast<std::size_t>(b);
            run.blocks.x_m.values.push_back(specimen.rest_x_m[block] + u + 5e-5 * normal(random));
            run.blocks.y_m.values.push_back(specimen.rest_y_m[block] + 5e-5 * normal(random));
            run.blocks.theta_rad.values.push_back(1e-3 * normal(random));
        }
    }
    return run;
}

inline Campaign sample_campaign(int drums = 3)
{
    Campaign campaign;
    campaign.specimen = sample_specimen(drums);
    campaign.runs = {sample_run(campaign.specimen, "000", 1), sample_run(campaign.specimen, "001", 2),
                     sample_run(campaign.specimen, "002", 3, {.amplitude_m = 0.003, .frequency_hz = 3})};
    campaign.runs[1].repeat = 1;
    campaign.runs[2].motion_id = 1;
    return campaign;
}

/// A test of every kind on the joint below block 1, of the shapes that files have; no physics. @pre two blocks or more
inline std::vector<MeasuredRun> sample_tests(const Specimen& specimen, int samples = 40)
{
    const auto n = static_cast<std::size_t>(specimen.blocks());
    std::vector<MeasuredRun> tests;
    for (const RunKind kind :
         {RunKind::board, RunKind::drop, RunKind::pull, RunKind::push, RunKind::rest, RunKind::slide, RunKind::tilt}) {
        MeasuredRun& run = tests.emplace_back();
        run.name = to_string(kind);
        run.test = kind;
        if (kind == RunKind::rest)
            continue;
        run.joint = 1;
        run.present = {0, 1};
        run.clamped = {0};
        run.rate_hz = 100;
        run.motion_id = static_cast<int>(tests.size());
        for (int i = 0; i < samples; ++i) {
            run.time_s.push_back(0.01 * i);
            for (std::size_t b = 0; b < n; ++b) {
                run.blocks.x_m.values.push_back(b < 2 ? specimen.rest_x_m[b] + 1e-5 * i : nan_value);
                run.blocks.y_m.values.push_back(b < 2 ? specimen.rest_y_m[b] : nan_value);
                run.blocks.theta_rad.values.push_back(b < 2 ? 1e-4 * i : nan_value);
            }
            if (kind == RunKind::board || kind == RunKind::tilt)
                run.base_tilt_rad.values.push_back(0.7 * i / samples);
            if (kind == RunKind::pull || kind == RunKind::slide)
                run.base_displacement_m.values.push_back(1e-4 * i);
        }
        if (kind == RunKind::tilt || kind == RunKind::push)
            run.dummies = {{1, 0.1355, 0.024, 0.0145, 0, 0.029}, {1, 0.1355, 0.024, 0.0145, 1e-4, 0.058}};
        if (kind == RunKind::drop)
            run.released_s = 0.2;
        if (kind == RunKind::board)
            run.base_tilt_rad.noise_sd = 5e-4;
        if (kind != RunKind::pull && kind != RunKind::push)
            continue;
        ForceGauge& gauge = run.forces.emplace_back();
        gauge.name = "Rod_A";
        gauge.block = 1;
        gauge.height_m = kind == RunKind::pull ? 0.00725 : 0.0783;
        gauge.to_laboratory = kind == RunKind::pull;
        gauge.speed_m_s = kind == RunKind::pull ? 0 : -0.02;
        gauge.stiffness_n_m = 2e4;
        gauge.gain_sd = 0.005;
        gauge.value_n.noise_sd = 0.02;
        for (int i = 0; i < samples; ++i)
            gauge.value_n.values.push_back(i == 3 ? nan_value : 0.013 * i);
    }
    return tests;
}

/// A folder of its own for each test.
class MeasuredFolder {
public:
    explicit MeasuredFolder(const std::string& name)
        : path_(std::filesystem::temp_directory_path() /
                ("stylobate_measured_" + name + "_" + std::to_string(std::random_device{}())))
    {
        std::filesystem::create_directories(path_);
    }
    ~MeasuredFolder() { std::filesystem::remove_all(path_); }
    MeasuredFolder(const MeasuredFolder&) = delete;
    MeasuredFolder& operator=(const MeasuredFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

inline std::string content_of(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

inline void write_content(const std::filesystem::path& path, const std::string& text)
{
    std::ofstream(path, std::ios::binary) << text;
}

/// The practice campaigns that are there, none where they are absent.
inline std::vector<std::filesystem::path> practice_campaigns()
{
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(STYLOBATE_DATA_DIR) / "practice_campaigns", error))
        if (entry.path().extension() == ".h5")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// The message of the refusal of `f`, empty if it does not refuse.
template <class F>
std::string refusal(F&& f)
{
    try {
        f();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace stylobate
