#include "studies/measured/diagnosis/evidence/coarse_run.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr double bin_part = 0.04;    // of sqrt(height / g)
constexpr double series_up_to = 0.3; // rad

/// Sine and cosine: by their series, to 3e-8, as long as a block has not fallen.
void turn(CoarsePose& pose)
{
    const double t = pose.theta_rad;
    if (std::fabs(t) > series_up_to) {
        pose.sine = std::sin(t);
        pose.cosine = std::cos(t);
        return;
    }
    const double q = t * t;
    pose.sine = t * (1 - q / 6 * (1 - q / 20));
    pose.cosine = 1 - q / 2 * (1 - q / 12 * (1 - q / 30));
}

} // namespace

CoarseRun coarse_run(const Specimen& specimen, const MeasuredRun& run, const CampaignScales& scales,
                     const std::vector<double>& base_m)
{
    CoarseRun out;
    out.blocks = specimen.half_width_m.size();
    if (!run.has_blocks())
        return out;
    const std::size_t n = run.time_s.size(), columns = out.blocks;
    const double spacing = (run.time_s.back() - run.time_s.front()) / static_cast<double>(n - 1);
    const auto m = static_cast<std::size_t>(std::max(1.0, std::round(bin_part * scales.time_s / spacing)));
    out.spacing_s = spacing * static_cast<double>(m);
    out.bins = n / m;
    out.noise_m = scales.noise_m / std::sqrt(static_cast<double>(m));
    out.noise_rad = scales.noise_rad / std::sqrt(static_cast<double>(m));
    out.poses.resize(out.bins * columns);
    out.usable.assign(out.bins, 1);
    if (!base_m.empty())
        out.base_m.resize(out.bins);
    const double per = 1 / static_cast<double>(m);
    const auto fell_s = run.fell_at_s();
    const double end = fell_s ? *fell_s - falls_before * scales.time_s : run.time_s.back() + spacing;
    for (std::size_t i = 0; i < out.bins; ++i) {
        CoarsePose* poses = &out.poses[i * columns];
        double check = 0;
        for (std::size_t k = i * m; k < (i + 1) * m; ++k)
            for (std::size_t b = 0; b < columns; ++b) {
                poses[b].x_m += run.blocks.x_m.values[k * columns + b];
                poses[b].y_m += run.blocks.y_m.values[k * columns + b];
                poses[b].theta_rad += run.blocks.theta_rad.values[k * columns + b];
            }
        for (std::size_t b = 0; b < columns; ++b) {
            poses[b].x_m *= per;
            poses[b].y_m *= per;
            poses[b].theta_rad *= per;
            turn(poses[b]);
            check += poses[b].x_m + poses[b].y_m + poses[b].theta_rad;
        }
        if (!base_m.empty()) {
            double sum = 0;
            for (std::size_t k = i * m; k < (i + 1) * m; ++k)
                sum += base_m[k];
            out.base_m[i] = per * sum;
            check += out.base_m[i];
        }
        // a clock that leaps is a gap
        const double lasted = run.time_s[(i + 1) * m - 1] - run.time_s[i * m];
        const bool even = std::fabs(lasted - spacing * static_cast<double>(m - 1)) < 0.5 * spacing;
        out.usable[i] = std::isfinite(check) && even && run.time_s[(i + 1) * m - 1] < end;
    }
    return out;
}

double JointFaces::narrower_m() const
{
    return std::min(lower_half_width_m, upper_half_width_m);
}

JointFaces joint_faces(const Specimen& specimen, std::size_t joint)
{
    const auto [lower, upper] = specimen.joints[joint];
    JointFaces f;
    f.lower = lower;
    f.upper = upper;
    const auto u = static_cast<std::size_t>(upper);
    f.upper_half_width_m = specimen.half_width_m[u];
    f.upper_half_height_m = specimen.half_height_m[u];
    if (lower >= 0) {
        f.lower_half_width_m = specimen.half_width_m[static_cast<std::size_t>(lower)];
        f.lower_half_height_m = specimen.half_height_m[static_cast<std::size_t>(lower)];
    } else {
        f.lower_half_width_m = specimen.base_block_half_width_m.value_or(endless_m);
        f.lower_half_height_m = 1;
        f.base_y_m = specimen.base_block_top_m - 1;
    }
    return f;
}

JointPose joint_pose(const JointFaces& f, const CoarseRun& run, std::size_t bin)
{
    const CoarsePose& u = run.pose(bin, static_cast<std::size_t>(f.upper));
    CoarsePose l;
    double lower_half_width = f.lower_half_width_m;
    if (f.lower >= 0)
        l = run.pose(bin, static_cast<std::size_t>(f.lower));
    else {
        l.x_m = run.base_m.empty() ? 0 : run.base_m[bin];
        l.y_m = f.base_y_m;
        if (run.base_m.empty()) // its corners are not known
            lower_half_width = endless_m;
    }
    const double bu = f.upper_half_width_m, hu = f.upper_half_height_m, hl = f.lower_half_height_m;
    const double dx = u.x_m - l.x_m, dy = u.y_m - l.y_m;
    // the upper block's centre and rotation in the frame of the lower one
    const double x = dx * l.cosine + dy * l.sine, y = dy * l.cosine - dx * l.sine;
    const double s = u.sine * l.cosine - u.cosine * l.sine, c = u.cosine * l.cosine + u.sine * l.sine;
    JointPose pose;
    pose.rotation_rad = u.theta_rad - l.theta_rad;
    const double side = pose.rotation_rad >= 0 ? -1 : 1; // of the corner on which the upper block turns
    const double corner = x + side * bu * c + hu * s;
    if (std::fabs(corner) <= lower_half_width) {
        pose.slip_m = x + hu * s + side * bu * (c - 1);
        pose.lift_m = y + side * bu * s - hu * c - hl;
        pose.corner_x_m = u.x_m + side * bu * u.cosine + hu * u.sine;
        pose.corner_y_m = u.y_m + side * bu * u.sine - hu * u.cosine;
    } else { // the lower block's corner lies on the upper one's face
        const double end = corner > 0 ? lower_half_width : -lower_half_width;
        const double ex = (end - x) * c + (hl - y) * s, ey = (hl - y) * c - (end - x) * s;
        pose.slip_m = end - ex;
        pose.lift_m = -hu - ey;
        pose.corner_x_m = l.x_m + end * l.cosine - hl * l.sine;
        pose.corner_y_m = l.y_m + end * l.sine + hl * l.cosine;
        pose.on_upper = false;
    }
    return pose;
}

JointSeries joint_series(const JointFaces& f, const CoarseRun& run)
{
    JointSeries out;
    out.has_slip = f.lower >= 0 || !run.base_m.empty();
    out.slip_m.assign(run.bins, 0);
    out.rotation_rad.assign(run.bins, 0);
    out.lift_m.assign(run.bins, 0);
    for (std::size_t i = 0; i < run.bins; ++i) {
        if (!run.usable[i])
            continue;
        const JointPose pose = joint_pose(f, run, i);
        out.slip_m[i] = pose.slip_m;
        out.rotation_rad[i] = pose.rotation_rad;
        out.lift_m[i] = pose.lift_m;
    }
    // slip is x_u - x_l + h_u theta_u + h_l theta_l, lift y_u - y_l - b |theta_u - theta_l|, to the first order
    const double bodies = f.lower >= 0 ? 2 : 1, lever = f.lower >= 0 ? f.lower_half_height_m : 0;
    out.rotation_noise_rad = std::sqrt(bodies) * run.noise_rad;
    out.slip_noise_m =
        std::sqrt(bodies * run.noise_m * run.noise_m +
                  (f.upper_half_height_m * f.upper_half_height_m + lever * lever) * run.noise_rad * run.noise_rad);
    out.lift_noise_m =
        std::sqrt(bodies) * std::hypot(run.noise_m, std::min(f.narrower_m(), f.upper_half_width_m) * run.noise_rad);
    return out;
}

} // namespace stylobate
