#include "studies/measured/diagnosis/evidence/joint_sums.hpp"

#include <algorithm>
#include <cmath>

namespace stylobate {

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
