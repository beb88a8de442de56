#include "studies/measured/diagnosis/evidence/joint_forces.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"
#include "studies/measured/diagnosis/evidence/law_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stylobate {

namespace {

constexpr double moved_noise = 3;
// Residuals beyond so many of their scales count as so large.
constexpr double most_residual = 2.5;
constexpr std::size_t fewest = 10;

/// Of two bins: place, and velocity and acceleration from the pairs beside it.
struct Motion {
    double x = 0, y = 0, sine = 0, cosine = 1;
    double vx = 0, vy = 0, spin = 0;
    double ax = 0, ay = 0, turn = 0;
};

/// @param i first bin of the middle pair
Motion motion_at(const CoarseRun& run, std::size_t i, std::size_t block)
{
    const auto pair = [&](std::size_t k, auto member) {
        return (run.pose(k, block).*member + run.pose(k + 1, block).*member) / 2;
    };
    const double h = 2 * run.spacing_s;
    Motion m;
    m.x = pair(i, &CoarsePose::x_m);
    m.y = pair(i, &CoarsePose::y_m);
    m.sine = pair(i, &CoarsePose::sine);
    m.cosine = pair(i, &CoarsePose::cosine);
    const auto rates = [&](auto member, double& rate, double& acceleration) {
        const double a = pair(i - 2, member), b = pair(i, member), c = pair(i + 2, member);
        rate = (c - a) / (2 * h);
        acceleration = (c - 2 * b + a) / (h * h);
    };
    rates(&CoarsePose::x_m, m.vx, m.ax);
    rates(&CoarsePose::y_m, m.vy, m.ay);
    rates(&CoarsePose::theta_rad, m.spin, m.turn);
    return m;
}

double weighted(const std::vector<double>& a, const std::vector<double>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

/// Residuals of a joint's samples beside its turning point, limited to what their scale allows, in units of it.
std::vector<double> limited_residuals(const std::vector<RockingSample>& samples)
{
    std::vector<double> normal, r(samples.size());
    for (const RockingSample& s : samples)
        normal.push_back(s.normal);
    const double square = weighted(normal, normal);
    double turning = 0, scale = 1;
    for (std::size_t i = 0; i < samples.size(); ++i)
        turning += samples[i].normal * samples[i].value / square;
    for (int pass = 0; pass < 4; ++pass) {
        std::vector<double> size;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            r[i] = samples[i].value - turning * samples[i].normal;
            size.push_back(std::fabs(r[i]));
        }
        scale = std::max(1.4826 * upper_median(std::move(size)), 1e-12);
        for (double& residual : r)
            residual = std::clamp(residual, -most_residual * scale, most_residual * scale);
        if (pass < 3)
            turning += weighted(normal, r) / square;
    }
    for (double& residual : r)
        residual /= scale;
    return r;
}

/// Least slip speeds of the classes [m/s]: 0.01, 0.03 and 0.1 of sqrt(g x height).
std::array<double, slip_classes> slip_class_speeds(const Specimen& s)
{
    double top = 0, bottom = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < s.rest_y_m.size(); ++b) {
        top = std::max(top, s.rest_y_m[b] + s.half_height_m[b]);
        bottom = std::min(bottom, s.rest_y_m[b] - s.half_height_m[b]);
    }
    const double speed = std::sqrt(s.gravity_m_s2 * (top - bottom));
    return {0.01 * speed, 0.03 * speed, 0.1 * speed};
}

} // namespace

std::vector<std::vector<int>> carried_blocks(const Specimen& s)
{
    std::vector<std::vector<int>> above(s.joints.size());
    std::vector<int> stands(s.half_width_m.size(), 0);
    for (const auto& [lower, upper] : s.joints)
        ++stands[static_cast<std::size_t>(upper)];
    if (std::any_of(stands.begin(), stands.end(), [](int n) { return n != 1; }))
        return {};
    for (std::size_t j = 0; j < s.joints.size(); ++j) {
        above[j].push_back(s.joints[j].second);
        for (std::size_t k = 0; k < above[j].size(); ++k)
            for (const auto& [lower, upper] : s.joints)
                if (lower == above[j][k])
                    above[j].push_back(upper);
    }
    return above;
}

JointForces::JointForces(const Specimen& specimen)
    : specimen_(specimen), above_(carried_blocks(specimen)), weight_n_(rest_weights(specimen)),
      samples_(specimen.joints.size())
{
}

void JointForces::add(std::size_t joint, const JointFaces& faces, const JointSeries& series, const CoarseRun& run,
                      double open_rad, JointSums& sums)
{
    const std::array<double, slip_classes> speeds = slip_class_speeds(specimen_);
    const double h = 2 * run.spacing_s, weight = weight_n_[joint], g = specimen_.gravity_m_s2;
    const double half_width = std::min(faces.narrower_m(), faces.upper_half_width_m);
    const double least = moved_noise * series.slip_noise_m;
    const auto slip = [&](std::size_t i) { return (series.slip_m[i] + series.slip_m[i + 1]) / 2; };
    for (std::size_t i = 2; i + 3 < run.bins; i += 2) {
        const bool usable =
            std::all_of(run.usable.begin() + static_cast<std::ptrdiff_t>(i - 2),
                        run.usable.begin() + static_cast<std::ptrdiff_t>(i + 4), [](char u) { return u; });
        if (!usable)
            continue;
        const double moved = slip(i + 2) - slip(i - 2); // in 2 h
        const bool slides = series.has_slip && std::fabs(moved) > least;
        int open = 0;
        for (std::size_t k = i - 2; k < i + 4; ++k)
            open += series.rotation_rad[k] > open_rad ? 1 : series.rotation_rad[k] < -open_rad ? -1 : 0;
        const bool rocks = std::abs(open) == 6;
        if (!slides && !rocks)
            continue;
        const JointPose a = joint_pose(faces, run, i), b = joint_pose(faces, run, i + 1);
        const double corner_x = (a.corner_x_m + b.corner_x_m) / 2, corner_y = (a.corner_y_m + b.corner_y_m) / 2;
        const double sign = open > 0 ? 1 : -1;
        double force_x = 0, force_y = 0, moment = 0;
        RockingSample sample;
        for (const int block : above_[joint]) {
            const auto k = static_cast<std::size_t>(block);
            const Motion m = motion_at(run, i, k);
            const double mass = specimen_.mass_kg[k], arm_x = m.x - corner_x, arm_y = m.y - corner_y;
            const double bk = specimen_.half_width_m[k], hk = specimen_.half_height_m[k];
            force_x += mass * m.ax;
            force_y += mass * (m.ay + g);
            if (!rocks)
                continue;
            moment += mass * (arm_x * (m.ay + g) - arm_y * m.ax) + mass * (bk * bk + hk * hk) / 3 * m.turn;
            // the force of the air, and the moment of a centre of mass that lies half a width beside the middle
            const double per = sign / (weight * half_width), speed = std::hypot(m.vx, m.vy);
            sample.drag += -per * speed * (arm_x * m.vy - arm_y * m.vx);
            const double shift_ax = -m.turn * m.sine - m.spin * m.spin * m.cosine;
            const double shift_ay = m.turn * m.cosine - m.spin * m.spin * m.sine;
            sample.eccentricity +=
                -per * bk * mass * (m.cosine * (m.ay + g) - m.sine * m.ax + arm_x * shift_ay - arm_y * shift_ax);
        }
        // the face that is touched: of the lower block, or the upper one's
        const int owner = a.on_upper ? faces.lower : faces.upper;
        const Motion face = owner < 0 ? Motion{} : motion_at(run, i, static_cast<std::size_t>(owner));
        const double normal = (force_y * face.cosine - force_x * face.sine) / weight;
        const double tangential = (force_x * face.cosine + force_y * face.sine) / weight;
        if (slides) {
            const double speed = std::fabs(moved) / (2 * h);
            const std::size_t kind = speed < speeds[1] ? 0 : speed < speeds[2] ? 1 : 2;
            sums.slipped[kind] += std::fabs(moved) / 2;
            sums.tangential[kind] -= moved / 2 * tangential;
            sums.normal[kind] += std::fabs(moved) / 2 * normal;
        }
        if (rocks && normal >= least_normal) {
            sample.value = sign * moment / (weight * half_width);
            sample.normal = normal;
            samples_[joint].push_back(sample);
        }
    }
}

std::vector<double> JointForces::scores() const
{
    const std::size_t joints = samples_.size();
    std::vector<double> scores(2 * joints, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t j = 0; j < joints; ++j) {
        const std::vector<RockingSample>& samples = samples_[j];
        if (samples.size() < fewest)
            continue;
        const std::vector<double> r = limited_residuals(samples);
        for (const auto& [column, k] :
             {std::pair{&RockingSample::drag, j}, {&RockingSample::eccentricity, joints + j}}) {
            double normal = 0, along = 0; // what the turning point takes of the column
            for (const RockingSample& s : samples) {
                normal += s.normal * s.normal;
                along += s.*column * s.normal;
            }
            double sum = 0, square = 0;
            for (std::size_t i = 0; i < samples.size(); ++i) {
                const double c = samples[i].*column - along / normal * samples[i].normal;
                sum += c * r[i];
                square += c * c;
            }
            if (square > 0)
                scores[k] = sum / std::sqrt(square);
        }
    }
    return scores;
}

} // namespace stylobate
