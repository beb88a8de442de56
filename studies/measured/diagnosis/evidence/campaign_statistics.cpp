#include "studies/measured/diagnosis/evidence/campaign_statistics.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"
#include "studies/measured/diagnosis/evidence/joint_forces.hpp"
#include "studies/measured/diagnosis/evidence/joint_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

namespace stylobate {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
// A path below this part of its unit, and below its noise, counts as that: logarithms stay finite.
constexpr double least_path = 1e-3;
// A closure that leaves less of the square of the speed counts as having left so much.
constexpr double least_left = 1e-3;
constexpr double fewest_closures = 2, fewest_bins = 20, fewest_excursions = 2;
// Slip path over the half width, and mean normal force over the weight, below which there is no friction to be seen.
constexpr double least_slipped = 0.01, least_pressed = 0.1;

/// Of one joint; what it is over: half width and slenderness.
struct JointView {
    const JointSums& sums; ///< mean over the repeats
    double half_width_m;
    double alpha_rad;
    bool has_slip;
    double floor_m() const { return least_path * half_width_m + sums.path_noise_m; }
    double log_path() const { return std::log((std::max(sums.slip_path_m, 0.0) + floor_m()) / half_width_m); }
};

double log_speed_ratio(double before, double after)
{
    return 0.5 * std::log(std::max(after / before, least_left));
}

/// Minus the slope of the lift of the nominal corner against |rotation|; noise of the rotation is in both.
double turning_offset(const JointView& v, std::size_t side)
{
    const auto& [n, r, z, rr, rz] = v.sums.turning[side];
    if (n < fewest_bins)
        return missing;
    const double noise = v.sums.rotation_variance;
    const double variance = rr / n - r / n * (r / n) - noise;
    if (variance < 20 * noise || variance <= 0)
        return missing;
    return -(rz / n - r / n * (z / n) + v.half_width_m * noise) / variance / v.half_width_m;
}

/// Work of friction over that of the normal force along the same slips, of the classes from `first` to before `end`.
double friction(const JointView& v, std::size_t first, std::size_t end)
{
    double tangential = 0, normal = 0, slipped = 0;
    for (std::size_t k = first; k < end; ++k) {
        tangential += v.sums.tangential[k];
        normal += v.sums.normal[k];
        slipped += v.sums.slipped[k];
    }
    return v.has_slip && slipped >= least_slipped * v.half_width_m && normal > least_pressed * slipped
               ? tangential / normal
               : missing;
}

struct Kind {
    const char* name;
    int side;
    bool column; ///< needs forces
    bool slip;   ///< needs slip
    double (*value)(const JointView&);
};

/// In the order in which they keep their motions apart.
constexpr std::array kinds = {
    Kind{"slip_path", 0, false, true, [](const JointView& v) { return v.log_path(); }},
    Kind{"rotation_path", 0, false, false,
         [](const JointView& v) {
             return std::log((std::max(v.sums.rotation_path_rad, 0.0) + v.sums.rotation_path_noise_rad) / v.alpha_rad +
                             least_path);
         }},
    Kind{"half_ratio", 0, false, true,
         [](const JointView& v) {
             return std::log((std::max(v.sums.second_path_m, 0.0) + v.floor_m()) /
                             (std::max(v.sums.first_path_m, 0.0) + v.floor_m()));
         }},
    Kind{"rotation_rms", 0, false, false,
         [](const JointView& v) {
             const double square = std::max(v.sums.rotation_square, 0.0) / v.sums.seen_s;
             return 0.5 * std::log(square / (v.alpha_rad * v.alpha_rad) + least_path * least_path);
         }},
    Kind{"net_slip", 0, false, true, [](const JointView& v) { return v.sums.net_slip_m / v.half_width_m; }},
    Kind{"closure_speed", 0, false, false,
         [](const JointView& v) {
             const auto& s = v.sums;
             return s.closures[0] + s.closures[1] >= fewest_closures
                        ? log_speed_ratio(s.before[0] + s.before[1], s.after[0] + s.after[1])
                        : missing;
         }},
    Kind{"range_over_path", 0, false, true,
         [](const JointView& v) { return v.sums.slip_range_m / (std::max(v.sums.slip_path_m, 0.0) + v.floor_m()); }},
    Kind{"open_time", -1, false, false, [](const JointView& v) { return v.sums.open_s[0] / v.sums.seen_s; }},
    Kind{"open_time", 1, false, false, [](const JointView& v) { return v.sums.open_s[1] / v.sums.seen_s; }},
    Kind{"turning_offset", -1, false, false, [](const JointView& v) { return turning_offset(v, 0); }},
    Kind{"turning_offset", 1, false, false, [](const JointView& v) { return turning_offset(v, 1); }},
    Kind{"friction", 0, true, true, [](const JointView& v) { return friction(v, 0, slip_classes); }},
    Kind{"friction_slow", 0, true, true, [](const JointView& v) { return friction(v, 0, 1); }},
    Kind{"friction_medium", 0, true, true, [](const JointView& v) { return friction(v, 1, 2); }},
    Kind{"friction_fast", 0, true, true, [](const JointView& v) { return friction(v, 2, 3); }},
};

/// What is computed of a campaign: a function of its plan.
struct Plan {
    std::vector<int> motions;
    std::vector<Kind> kept;
    std::size_t apart = 0; ///< so many of the kinds kept, the first ones, are of single motions
    bool column = false;
    bool scores = false; ///< of drag and eccentricity
    std::size_t joints = 0;

    std::size_t size() const
    {
        const std::size_t per_joint = 1 + apart * motions.size() + kept.size() - apart; // with order_slope
        return joints * per_joint + (scores ? 2 * joints : 0);
    }
};

Plan plan_of(const Campaign& campaign)
{
    Plan plan;
    for (const MeasuredRun& run : campaign.runs)
        if (run.has_blocks())
            plan.motions.push_back(run.motion_id);
    std::sort(plan.motions.begin(), plan.motions.end());
    plan.motions.erase(std::unique(plan.motions.begin(), plan.motions.end()), plan.motions.end());
    plan.joints = campaign.specimen.joints.size();
    plan.column = plan.scores = !carried_blocks(campaign.specimen).empty();
    for (const Kind& kind : kinds)
        if (plan.column || !kind.column)
            plan.kept.push_back(kind);
    plan.apart = plan.motions.size() > 1 ? plan.kept.size() : 0;
    while (plan.size() > most_statistics && plan.apart > 0)
        --plan.apart;
    plan.scores = plan.scores && plan.size() <= most_statistics;
    while (plan.size() > most_statistics && plan.kept.size() > 1)
        plan.kept.pop_back();
    return plan;
}

/// All that the statistics are made of.
struct Sums {
    std::vector<JointFaces> faces;               ///< (joints)
    std::vector<RigidRocking> rigid;             ///< (joints)
    std::vector<std::vector<JointSums>> runs;    ///< (runs)(joints); empty: not seen
    std::vector<std::vector<JointSums>> motions; ///< (motions)(joints), mean over the repeats
    std::vector<JointSums> all;                  ///< (joints) of all motions
    std::vector<char> has_slip;                  ///< (joints)
    std::vector<double> scores;

    JointView view(const JointSums& sums, std::size_t joint) const
    {
        return {sums, std::min(faces[joint].narrower_m(), faces[joint].upper_half_width_m), rigid[joint].alpha_rad,
                has_slip[joint] != 0};
    }
};

Sums sums_of(const Campaign& campaign, const CampaignScales& scales, const std::vector<std::vector<double>>& base_m,
             const Plan& plan)
{
    const Specimen& s = campaign.specimen;
    Sums out;
    const std::vector<std::vector<int>> above = carried_blocks(s);
    for (std::size_t j = 0; j < plan.joints; ++j) {
        out.faces.push_back(joint_faces(s, j));
        out.rigid.push_back(rigid_rocking(s, j, plan.column ? above[j] : std::vector<int>{s.joints[j].second}));
    }
    out.has_slip.assign(plan.joints, 1);
    std::optional<JointForces> forces;
    if (plan.column)
        forces.emplace(s);
    for (std::size_t r = 0; r < campaign.runs.size(); ++r) {
        out.runs.emplace_back();
        const CoarseRun run = coarse_run(s, campaign.runs[r], scales, base_m[r]);
        if (std::none_of(run.usable.begin(), run.usable.end(), [](char u) { return u != 0; }))
            continue;
        for (std::size_t j = 0; j < plan.joints; ++j) {
            const JointSeries series = joint_series(out.faces[j], run);
            JointSums sums = joint_sums(out.faces[j], series, run, out.rigid[j], scales.rotation_rad, scales.time_s);
            if (forces)
                forces->add(j, out.faces[j], series, run, scales.rotation_rad, sums);
            if (!series.has_slip)
                out.has_slip[j] = 0;
            out.runs.back().push_back(sums);
        }
    }
    out.all.resize(plan.joints);
    for (const int motion : plan.motions) {
        std::vector<JointSums> mean(plan.joints);
        for (std::size_t r = 0; r < campaign.runs.size(); ++r)
            if (campaign.runs[r].motion_id == motion && !out.runs[r].empty())
                for (std::size_t j = 0; j < plan.joints; ++j)
                    mean[j] += out.runs[r][j];
        for (std::size_t j = 0; j < plan.joints; ++j) {
            if (mean[j].runs > 0)
                mean[j].scale(1 / mean[j].runs);
            out.all[j] += mean[j];
        }
        out.motions.push_back(std::move(mean));
    }
    if (forces)
        out.scores = forces->scores();
    return out;
}

/// Logarithms of the slip paths of a joint about the mean of each motion, with the order of the runs likewise.
struct Repeats {
    double order_path = 0, order_square = 0, path_square = 0;
    double freedom = 0; ///< repeats beyond the first of each motion
};

Repeats repeats_of(const Campaign& campaign, const Plan& plan, const Sums& sums, std::size_t joint)
{
    Repeats out;
    for (const int motion : plan.motions) {
        std::vector<double> path, order;
        for (std::size_t r = 0; r < campaign.runs.size(); ++r)
            if (campaign.runs[r].motion_id == motion && !sums.runs[r].empty()) {
                path.push_back(sums.view(sums.runs[r][joint], joint).log_path());
                order.push_back(campaign.runs[r].run_order.value_or(static_cast<int>(r)));
            }
        const auto n = static_cast<double>(path.size());
        double mean_path = 0, mean_order = 0;
        for (std::size_t k = 0; k < path.size(); ++k) {
            mean_path += path[k] / n;
            mean_order += order[k] / n;
        }
        for (std::size_t k = 0; k < path.size(); ++k) {
            out.order_path += (path[k] - mean_path) * (order[k] - mean_order);
            out.order_square += (order[k] - mean_order) * (order[k] - mean_order);
            out.path_square += (path[k] - mean_path) * (path[k] - mean_path);
        }
        out.freedom += std::max(n - 1, 0.0);
    }
    return out;
}

/// Mean over those that are there.
class Mean {
public:
    void add(double value)
    {
        if (std::isfinite(value)) {
            sum_ += value;
            ++count_;
        }
    }
    double value() const { return count_ > 0 ? sum_ / count_ : missing; }

private:
    double sum_ = 0;
    int count_ = 0;
};

constexpr std::array descriptor_names = {
    "common_slip_path",      // mean of slip_path over joints and motions
    "common_rotation_path",  // likewise
    "common_half_ratio",     // likewise
    "common_turning_offset", // over joints and sides
    "common_friction",       // work of friction over that of the normal force, of all joints together
    "decay_slow",            // ln of the rotation speed after a closure over that before, slow closures of all joints
    "decay_fast",            // fast ones
    "period_low",            // mean ln of the duration of an excursion over the rigid block's, low ones
    "period_high",           // high ones
    "hop_share",             // ln of the part of the time in which both corners are above the face
    "open_share",            // ln of the part of the time in which a joint is open
    "impact_share",          // part of the slip path near closures
    "repeat_spread",         // standard deviation of slip_path among repeats
};

std::vector<double> descriptors_of(const Campaign& campaign, const Plan& plan, const Sums& sums)
{
    std::map<std::string_view, Mean> common;
    for (std::size_t j = 0; j < plan.joints; ++j)
        for (std::size_t m = 0; m < plan.motions.size(); ++m) {
            const JointSums& of = sums.motions[m][j];
            if (of.runs == 0)
                continue;
            const JointView view = sums.view(of, j);
            for (const Kind& kind : kinds)
                if (view.has_slip || !kind.slip)
                    common[kind.name].add(kind.value(view));
        }
    JointSums total;
    Mean turning;
    double spread = 0, freedom = 0, path = 0, impacts = 0;
    for (std::size_t j = 0; j < plan.joints; ++j) {
        total += sums.all[j];
        const JointView view = sums.view(sums.all[j], j);
        turning.add(turning_offset(view, 0));
        turning.add(turning_offset(view, 1));
        if (!view.has_slip)
            continue;
        path += std::max(sums.all[j].slip_path_m, 0.0) + view.floor_m();
        impacts += sums.all[j].impact_path_m;
        const Repeats repeats = repeats_of(campaign, plan, sums, j);
        spread += repeats.path_square;
        freedom += repeats.freedom;
    }
    double tangential = 0, normal = 0;
    for (std::size_t k = 0; k < slip_classes; ++k) {
        tangential += total.tangential[k];
        normal += total.normal[k];
    }
    const auto decay = [&](std::size_t k) {
        return total.closures[k] >= fewest_closures ? log_speed_ratio(total.before[k], total.after[k]) : missing;
    };
    const auto period = [&](std::size_t k) {
        return total.excursions[k] >= fewest_excursions ? total.log_duration[k] / total.excursions[k] : missing;
    };
    const double seen = total.seen_s;
    return {common["slip_path"].value(),
            common["rotation_path"].value(),
            common["half_ratio"].value(),
            turning.value(),
            normal > 0 ? tangential / normal : missing,
            decay(0),
            decay(1),
            period(0),
            period(1),
            std::log(total.hop_s / seen + least_path),
            std::log((total.open_s[0] + total.open_s[1]) / seen + least_path),
            path > 0 ? impacts / path : missing,
            freedom > 0 ? std::sqrt(spread / freedom) : missing};
}

} // namespace

std::vector<StatisticLabel> statistic_labels(const Campaign& campaign)
{
    const Plan plan = plan_of(campaign);
    std::vector<StatisticLabel> labels;
    for (std::size_t k = 0; k < plan.kept.size(); ++k)
        for (std::size_t j = 0; j < plan.joints; ++j) {
            const Kind& kind = plan.kept[k];
            const int joint = static_cast<int>(j);
            if (k >= plan.apart)
                labels.push_back({kind.name, joint, -1, -1, kind.side});
            else
                for (const int motion : plan.motions)
                    labels.push_back({kind.name, joint, -1, motion, kind.side});
        }
    for (std::size_t j = 0; j < plan.joints; ++j)
        labels.push_back({"order_slope", static_cast<int>(j), -1, -1, 0});
    if (plan.scores)
        for (const char* name : {"drag_score", "eccentricity_score"})
            for (std::size_t j = 0; j < plan.joints; ++j)
                labels.push_back({name, static_cast<int>(j), campaign.specimen.joints[j].second, -1, 0});
    return labels;
}

std::vector<StatisticLabel> descriptor_labels(const Campaign&)
{
    std::vector<StatisticLabel> labels;
    for (const char* name : descriptor_names)
        labels.push_back({name, -1, -1, -1, 0});
    return labels;
}

CampaignStatistics statistics_of(const Campaign& campaign, const CampaignScales& scales,
                                 const std::vector<std::vector<double>>& base_m)
{
    const Plan plan = plan_of(campaign);
    const Sums sums = sums_of(campaign, scales, base_m, plan);
    CampaignStatistics out;
    const auto value = [&](const Kind& kind, const JointSums& of, std::size_t joint) {
        const JointView view = sums.view(of, joint);
        return of.seen_s > 0 && (view.has_slip || !kind.slip) ? kind.value(view) : missing;
    };
    for (std::size_t k = 0; k < plan.kept.size(); ++k)
        for (std::size_t j = 0; j < plan.joints; ++j) {
            const Kind& kind = plan.kept[k];
            if (k >= plan.apart)
                out.values.push_back(value(kind, sums.all[j], j));
            else
                for (const std::vector<JointSums>& motion : sums.motions)
                    out.values.push_back(value(kind, motion[j], j));
        }
    for (std::size_t j = 0; j < plan.joints; ++j) {
        const Repeats repeats = repeats_of(campaign, plan, sums, j);
        out.values.push_back(repeats.order_square > 0 && sums.has_slip[j] ? repeats.order_path / repeats.order_square
                                                                          : missing);
    }
    if (plan.scores)
        out.values.insert(out.values.end(), sums.scores.begin(), sums.scores.end());
    out.descriptors = descriptors_of(campaign, plan, sums);
    return out;
}

namespace {

/// @param reduce label -> what is left of it
template <class Reduce>
Summary summary_of(const std::vector<StatisticLabel>& statistics, Reduce&& reduce)
{
    Summary out;
    for (std::size_t i = 0; i < statistics.size(); ++i) {
        const StatisticLabel label = reduce(statistics[i]);
        const auto at = std::find(out.labels.begin(), out.labels.end(), label);
        const auto place = static_cast<std::size_t>(at - out.labels.begin());
        if (at == out.labels.end()) {
            out.labels.push_back(label);
            out.groups.emplace_back();
        }
        out.groups[place].push_back(i);
    }
    return out;
}

template <class Value>
std::vector<double> of_groups(const Summary& summary, const std::vector<double>& values, Value&& value)
{
    std::vector<double> out;
    for (const std::vector<std::size_t>& group : summary.groups) {
        std::vector<double> known;
        for (const std::size_t i : group)
            if (std::isfinite(values[i]))
                known.push_back(values[i]);
        out.push_back(known.empty() ? std::numeric_limits<double>::quiet_NaN() : value(std::move(known)));
    }
    return out;
}

} // namespace

Summary over_motions(const std::vector<StatisticLabel>& statistics)
{
    return summary_of(statistics, [](StatisticLabel label) {
        label.motion = -1;
        return label;
    });
}

Summary over_joints(const std::vector<StatisticLabel>& statistics)
{
    return summary_of(statistics, [](StatisticLabel label) {
        label.joint = label.block = -1;
        return label;
    });
}

std::vector<double> means(const Summary& summary, const std::vector<double>& values)
{
    return of_groups(summary, values, [](const std::vector<double>& known) {
        double sum = 0;
        for (const double value : known)
            sum += value;
        return sum / static_cast<double>(known.size());
    });
}

std::vector<double> medians(const Summary& summary, const std::vector<double>& values)
{
    return of_groups(summary, values, [](std::vector<double> known) { return upper_median(std::move(known)); });
}

} // namespace stylobate
