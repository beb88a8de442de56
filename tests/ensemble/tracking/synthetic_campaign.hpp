#pragma once
/// Campaigns that the engine itself has "measured": a column with known parameters, seen by cameras with noise.

#include "ensemble/model/campaign.hpp"
#include "ensemble/numerics/random.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "ensemble/tracking/tracking.hpp"

#include <cmath>
#include <numbers>
#include <string>

namespace stylobate {

/// What the specimen really is, and how it was shaken.
struct SyntheticCampaign {
    std::uint64_t seed = 1;
    int runs = 6;
    int drums = 3; ///< free ones, on a fixed one
    double normal_stiffness_n_m2 = 1e7;
    double tangential_stiffness_n_m = 4.8e5;
    double normal_damping_ratio = 0.2;
    double tangential_damping_ratio = 0.1;
    double friction = 0.5;
    double pga_m_s2 = 6;
    double strong_s = 1.2;
    double camera_noise_m = 5e-5;
    double camera_noise_rad = 1e-3;
    double placement_m = 0; ///< 1 sigma

    static constexpr double rate_hz = 500;
};

/// A normally distributed number (Box and Muller). @param run, element say which
inline double normal_draw(const SyntheticCampaign& c, std::uint64_t run, std::uint64_t element)
{
    const double u = uniform01(c.seed + 1000, run, Stream::base_noise, 2 * element);
    const double v = uniform01(c.seed + 1000, run, Stream::base_noise, 2 * element + 1);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

inline Study truth_of(const SyntheticCampaign& c)
{
    Study study;
    study.seed = c.seed;
    study.realizations = static_cast<std::uint64_t>(c.runs);
    study.structure = equal_column(c.drums + 1, 1, 0.048, 0.029, 0.048, 0.1355);
    study.contact.normal_stiffness_n_m2 = c.normal_stiffness_n_m2;
    study.contact.tangential_stiffness_n_m = c.tangential_stiffness_n_m;
    study.contact.normal_damping_ratio = c.normal_damping_ratio;
    study.contact.tangential_damping_ratio = c.tangential_damping_ratio;
    study.contact.friction = c.friction;
    study.excitation.kind = ExcitationKind::noise;
    study.excitation.frequency_hz = 3;
    study.excitation.pga_m_s2 = c.pga_m_s2;
    study.excitation.rise_s = 0.3;
    study.excitation.strong_s = c.strong_s;
    study.excitation.decay_s = 0.1;
    return study;
}

/// The base motion is known without error, sampled at the cameras' rate: so it is what drives the truth too.
inline Campaign measure(const SyntheticCampaign& c)
{
    const Study truth = truth_of(c);
    const Sampler sampler(truth, nullptr);
    Campaign campaign;
    campaign.source = "synthetic";
    Specimen& s = campaign.specimen;
    s.name = "synthetic";
    s.friction_nominal = 0.6;
    s.base_block_half_width_m = 0.024;
    s.base_block_top_m = 0.029;
    for (int i = 0; i < c.drums; ++i) {
        s.half_width_m.push_back(0.024);
        s.half_height_m.push_back(0.0145);
        s.depth_m.push_back(0.048);
        s.mass_kg.push_back(0.1355);
        s.rest_x_m.push_back(0);
        s.rest_y_m.push_back(0.0435 + 0.029 * i);
        s.joints.emplace_back(i - 1, i);
    }
    std::vector<TrackingJob> jobs;
    for (int r = 0; r < c.runs; ++r) {
        const auto run = static_cast<std::uint64_t>(r);
        TrackingJob job;
        job.realization = sampler.realization(run);
        Realization& realization = job.realization;
        const Motion& drawn = *realization.motion;
        auto motion = std::make_shared<Motion>();
        motion->dt_s = 1 / SyntheticCampaign::rate_hz;
        const auto n = static_cast<std::size_t>((drawn.duration_s() + 0.3) / motion->dt_s);
        double v = 0, u = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double at = static_cast<double>(i) * motion->dt_s / drawn.dt_s;
            const auto k = static_cast<std::size_t>(at);
            const double part = at - static_cast<double>(k);
            const double a = k + 1 < drawn.acceleration_m_s2.size()
                                 ? (1 - part) * drawn.acceleration_m_s2[k] + part * drawn.acceleration_m_s2[k + 1]
                                 : 0;
            if (i > 0) {
                const double before = motion->acceleration_m_s2.back(), d = motion->dt_s;
                u += v * d + d * d * (before / 3 + a / 6);
                v += d * (before + a) / 2;
            }
            motion->acceleration_m_s2.push_back(a);
            motion->velocity_m_s.push_back(v);
            motion->displacement_m.push_back(u);
            motion->pga_m_s2 = std::max(motion->pga_m_s2, std::fabs(a));
        }
        realization.motion = motion;
        for (std::size_t i = 1; i < realization.blocks.size(); ++i)
            realization.blocks[i].x_m += c.placement_m * normal_draw(c, run, i);
        auto times = std::make_shared<std::vector<double>>();
        for (std::size_t i = 0; i < n; ++i)
            times->push_back(static_cast<double>(i) * motion->dt_s);
        job.watched_s = times;
        jobs.push_back(std::move(job));
    }
    Observer observer;
    const TrackingReport report = track(jobs, {best_isa(), 1}, observer);
    for (int r = 0; r < c.runs; ++r) {
        const auto run = static_cast<std::uint64_t>(r);
        const TrackingJob& job = jobs[static_cast<std::size_t>(r)];
        const Readings& seen = report.results[static_cast<std::size_t>(r)].watched;
        const Motion& base = *job.realization.motion;
        MeasuredRun m;
        m.name = std::to_string(r);
        m.motion_id = r;
        m.rate_hz = SyntheticCampaign::rate_hz;
        m.time_s = *job.watched_s;
        m.base_acceleration_m_s2 = {base.acceleration_m_s2, 0.0};
        m.base_displacement_m = {base.displacement_m, 0.0};
        m.blocks.x_m.noise_sd = m.blocks.y_m.noise_sd = c.camera_noise_m;
        m.blocks.theta_rad.noise_sd = c.camera_noise_rad;
        std::uint64_t element = 100;
        for (std::size_t k = 0; k < m.time_s.size(); ++k)
            for (std::size_t i = 1; i < job.realization.blocks.size(); ++i) {
                const std::size_t at = k * job.realization.blocks.size() + i;
                const Block& block = job.realization.blocks[i];
                m.blocks.x_m.values.push_back(block.x_m + seen.x_m[at] + base.displacement_m[k] +
                                              c.camera_noise_m * normal_draw(c, run, ++element));
                m.blocks.y_m.values.push_back(block.y_m + seen.y_m[at] +
                                              c.camera_noise_m * normal_draw(c, run, ++element));
                m.blocks.theta_rad.values.push_back(seen.theta_rad[at] +
                                                    c.camera_noise_rad * normal_draw(c, run, ++element));
            }
        campaign.runs.push_back(std::move(m));
    }
    return campaign;
}

} // namespace stylobate
