#include "studies/measured/diagnosis/evidence/joint_sums.hpp"

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

namespace {

// Faces that close open again, if they do, within this part of the time scale.
constexpr double opens_again = 0.5;
constexpr double near_impact = 0.1;
// Of a rigid block's alpha p: a fast closure; of alpha: a high excursion.
constexpr double fast = 0.3, high = 0.15;
// Hops are higher than this part of the half width, and than their noise.
constexpr double hop_part = 2e-3, hop_noise = 4;
constexpr double range_noise = 4;
// Standard deviation of the size of an increment that is noise alone, over that of the noise.
constexpr double path_noise = 1.2;

/// Stretch of open bins of one sign, or of usable ones.
struct Stretch {
    std::size_t begin = 0, end = 0; ///< [begin, end)
    int sign = 0;
    std::size_t length() const { return end - begin; }
};

class Summing {
public:
    Summing(const JointFaces& faces, const JointSeries& series, const CoarseRun& run, const RigidRocking& rigid,
            double open_rad, double time_s)
        : series_(series), run_(run), rigid_(rigid), open_rad_(open_rad), time_s_(time_s),
          half_width_(std::min(faces.narrower_m(), faces.upper_half_width_m)), near_closure_(run.bins, 0)
    {
    }

    JointSums sums()
    {
        std::size_t usable = 0;
        for (const char u : run_.usable)
            usable += u != 0;
        sums_.runs = 1;
        sums_.seen_s = run_.spacing_s * static_cast<double>(usable);
        sums_.rotation_variance = series_.rotation_noise_rad * series_.rotation_noise_rad;
        find_open();
        sum_closures();
        sum_excursions();
        sum_contact();
        sum_paths(usable);
        return sums_;
    }

private:
    void find_open()
    {
        for (std::size_t i = 0; i < run_.bins; ++i) {
            const double r = series_.rotation_rad[i];
            const int sign = !run_.usable[i] || std::fabs(r) <= open_rad_ ? 0 : r > 0 ? 1 : -1;
            if (sign == 0)
                continue;
            sums_.open_s[sign > 0 ? 0 : 1] += run_.spacing_s;
            if (!open_.empty() && open_.back().end == i && open_.back().sign == sign)
                ++open_.back().end;
            else
                open_.push_back({i, i + 1, sign});
        }
    }

    /// What the square of the speed of a rigid block gains from an angle down to the closure, to the order of Housner.
    double gained(double angle) const
    {
        const double t = std::fabs(angle);
        return rigid_.p_rad_s * rigid_.p_rad_s * (2 * rigid_.alpha_rad - t) * t;
    }

    /// Speeds are read where the joint is open beyond the threshold, and carried to the closure.
    void sum_closures()
    {
        const double h = run_.spacing_s, noise = 2 * sums_.rotation_variance / (4 * h * h);
        const auto wait = static_cast<std::size_t>(opens_again * time_s_ / h);
        const auto around = static_cast<std::size_t>(std::lround(near_impact * time_s_ / h));
        const auto& r = series_.rotation_rad;
        for (std::size_t k = 0; k < open_.size(); ++k) {
            const Stretch& a = open_[k];
            if (a.length() < 3 || a.end >= run_.bins || !run_.usable[a.end])
                continue;
            for (std::size_t i = a.end - std::min(around, a.end); i < std::min(a.end + around, run_.bins); ++i)
                near_closure_[i] = 1;
            const double falling = (r[a.end - 1] - r[a.end - 3]) / (2 * h);
            if (falling * a.sign >= 0)
                continue; // it did not come down
            const double before = falling * falling - noise + gained(r[a.end - 2]);
            double after = 0;
            if (k + 1 < open_.size()) {
                const Stretch& b = open_[k + 1];
                if (b.length() >= 3 && b.begin <= a.end + wait)
                    after = std::pow((r[b.begin + 2] - r[b.begin]) / (2 * h), 2) - noise + gained(r[b.begin + 1]);
            }
            const std::size_t kind = before > std::pow(fast * rigid_.alpha_rad * rigid_.p_rad_s, 2) ? 1 : 0;
            sums_.closures[kind] += 1;
            sums_.before[kind] += before;
            sums_.after[kind] += after;
        }
    }

    void sum_excursions()
    {
        for (const Stretch& e : open_) {
            if (e.length() < 3 || e.begin == 0 || e.end >= run_.bins || !run_.usable[e.begin - 1] ||
                !run_.usable[e.end])
                continue;
            double most = 0;
            for (std::size_t i = e.begin; i < e.end; ++i)
                most = std::max(most, std::fabs(series_.rotation_rad[i]));
            if (most < 2 * open_rad_ || most > 0.95 * rigid_.alpha_rad)
                continue;
            const std::size_t kind = most > high * rigid_.alpha_rad ? 1 : 0;
            // crossings of the threshold lie half a bin outside, on average
            const double lasted = run_.spacing_s * static_cast<double>(e.length());
            sums_.excursions[kind] += 1;
            sums_.log_duration[kind] += std::log(lasted / rigid_.excursion_s(open_rad_, most));
        }
    }

    /// Lift of the corner on which the block turns: where that corner really lies, and hops.
    void sum_contact()
    {
        for (const Stretch& e : open_)
            for (std::size_t i = e.begin; i < e.end; ++i) {
                const double r = std::fabs(series_.rotation_rad[i]), z = series_.lift_m[i];
                std::array<double, 5>& t = sums_.turning[e.sign > 0 ? 0 : 1];
                t[0] += 1;
                t[1] += r;
                t[2] += z;
                t[3] += r * r;
                t[4] += r * z;
            }
        // heights are planned ones: the lift counts from where it is while the joint is closed
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < run_.bins; ++i)
            if (run_.usable[i] && std::fabs(series_.rotation_rad[i]) <= open_rad_) {
                sum += series_.lift_m[i];
                count += 1;
            }
        const double rest = count > 0 ? sum / count : 0;
        const double enough = std::max(hop_part * half_width_, hop_noise * series_.lift_noise_m);
        for (std::size_t i = 0; i < run_.bins; ++i)
            if (run_.usable[i] && series_.lift_m[i] - rest > enough)
                sums_.hop_s += run_.spacing_s;
    }

    /// Increments between means of two bins, of which noise has the same standard deviation as one bin.
    void sum_paths(std::size_t usable)
    {
        const double slip_sd = series_.slip_noise_m, turn_sd = series_.rotation_noise_rad;
        std::size_t passed = 0;
        double slip = 0, turned = 0, least = 0, most = 0, first = 0, count = 0;
        bool before = false, any = false;
        for (std::size_t i = 0; i + 1 < run_.bins; i += 2) {
            if (!run_.usable[i] || !run_.usable[i + 1]) {
                before = false;
                passed += (run_.usable[i] != 0) + (run_.usable[i + 1] != 0);
                continue;
            }
            passed += 2;
            const double s = (series_.slip_m[i] + series_.slip_m[i + 1]) / 2;
            const double t = (series_.rotation_rad[i] + series_.rotation_rad[i + 1]) / 2;
            sums_.rotation_square += 2 * run_.spacing_s * (t * t - turn_sd * turn_sd / 2);
            if (!any)
                least = most = first = s;
            any = true;
            least = std::min(least, s);
            most = std::max(most, s);
            if (before) {
                const double path = noiseless_size(s - slip, slip_sd);
                sums_.slip_path_m += path;
                (2 * passed <= usable ? sums_.first_path_m : sums_.second_path_m) += path;
                if (near_closure_[i] || near_closure_[i + 1])
                    sums_.impact_path_m += path;
                sums_.rotation_path_rad += noiseless_size(t - turned, turn_sd);
                count += 1;
            }
            slip = s;
            turned = t;
            before = true;
        }
        sums_.net_slip_m = any ? slip - first : 0;
        sums_.slip_range_m = std::max(0.0, most - least - range_noise * slip_sd / std::sqrt(2.0));
        sums_.path_noise_m = path_noise * slip_sd * std::sqrt(count);
        sums_.rotation_path_noise_rad = path_noise * turn_sd * std::sqrt(count);
    }

    const JointSeries& series_;
    const CoarseRun& run_;
    const RigidRocking& rigid_;
    double open_rad_, time_s_, half_width_;
    std::vector<char> near_closure_;
    std::vector<Stretch> open_;
    JointSums sums_;
};

} // namespace

double noiseless_size(double x, double sd)
{
    // E exp(-(d + e)^2 / (2 s^2 sd^2)) = s / sqrt(1 + s^2) exp(-d^2 / (2 (1 + s^2) sd^2)), with s = 1/2
    constexpr double at_rest = 1.7841241161527712; // sqrt(2 / pi) sqrt(1 + s^2) / s
    const double u = std::fabs(x);
    if (!(u < 4 * sd))
        return u;
    return u - at_rest * sd * std::exp(-2 * u * u / (sd * sd));
}

double RigidRocking::excursion_s(double from_rad, double most_rad) const
{
    return 2 / p_rad_s * std::acosh((1 - from_rad / alpha_rad) / (1 - most_rad / alpha_rad));
}

RigidRocking rigid_rocking(const Specimen& s, std::size_t joint, const std::vector<int>& above)
{
    const JointFaces faces = joint_faces(s, joint);
    const auto upper = static_cast<std::size_t>(faces.upper);
    const double y0 = s.rest_y_m[upper] - s.half_height_m[upper], x0 = s.rest_x_m[upper];
    const double b = std::min(faces.narrower_m(), faces.upper_half_width_m);
    double mass = 0, moment = 0, inertia = 0;
    for (const int block : above) {
        const auto k = static_cast<std::size_t>(block);
        const double y = s.rest_y_m[k] - y0, x = s.rest_x_m[k] - x0 + b, m = s.mass_kg[k];
        mass += m;
        moment += m * y;
        inertia +=
            m * (x * x + y * y + (s.half_width_m[k] * s.half_width_m[k] + s.half_height_m[k] * s.half_height_m[k]) / 3);
    }
    const double centre = moment / mass;
    return {std::atan2(b, centre), std::sqrt(mass * s.gravity_m_s2 * std::hypot(b, centre) / inertia)};
}

JointSums& JointSums::operator+=(const JointSums& o)
{
    const double both = runs + o.runs;
    rotation_variance = both > 0 ? (runs * rotation_variance + o.runs * o.rotation_variance) / both : 0;
    path_noise_m = std::hypot(path_noise_m, o.path_noise_m);
    rotation_path_noise_rad = std::hypot(rotation_path_noise_rad, o.rotation_path_noise_rad);
    for (const auto member :
         {&JointSums::runs, &JointSums::seen_s, &JointSums::slip_path_m, &JointSums::first_path_m,
          &JointSums::second_path_m, &JointSums::impact_path_m, &JointSums::net_slip_m, &JointSums::slip_range_m,
          &JointSums::rotation_square, &JointSums::rotation_path_rad, &JointSums::hop_s})
        this->*member += o.*member;
    for (const auto member : {&JointSums::closures, &JointSums::before, &JointSums::after, &JointSums::excursions,
                              &JointSums::log_duration, &JointSums::open_s})
        for (std::size_t k = 0; k < 2; ++k)
            (this->*member)[k] += (o.*member)[k];
    for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t k = 0; k < turning[side].size(); ++k)
            turning[side][k] += o.turning[side][k];
    for (std::size_t k = 0; k < slip_classes; ++k) {
        slipped[k] += o.slipped[k];
        tangential[k] += o.tangential[k];
        normal[k] += o.normal[k];
    }
    return *this;
}

void JointSums::scale(double factor)
{
    for (const auto member : {&JointSums::seen_s, &JointSums::slip_path_m, &JointSums::first_path_m,
                              &JointSums::second_path_m, &JointSums::impact_path_m, &JointSums::path_noise_m,
                              &JointSums::net_slip_m, &JointSums::slip_range_m, &JointSums::rotation_square,
                              &JointSums::rotation_path_rad, &JointSums::rotation_path_noise_rad, &JointSums::hop_s})
        this->*member *= factor;
    for (const auto member : {&JointSums::closures, &JointSums::before, &JointSums::after, &JointSums::excursions,
                              &JointSums::log_duration, &JointSums::open_s})
        for (double& value : this->*member)
            value *= factor;
    for (auto& side : turning)
        for (double& value : side)
            value *= factor;
    for (const auto member : {&JointSums::slipped, &JointSums::tangential, &JointSums::normal})
        for (double& value : this->*member)
            value *= factor;
}

JointSums joint_sums(const JointFaces& faces, const JointSeries& series, const CoarseRun& run,
                     const RigidRocking& rigid, double open_rad, double time_s)
{
    return Summing(faces, series, run, rigid, open_rad, time_s).sums();
}

} // namespace stylobate
