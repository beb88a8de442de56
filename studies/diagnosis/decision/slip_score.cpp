#include "studies/diagnosis/decision/slip_score.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace stylobate {

namespace {

// A slip that is predicted to within this part of itself is predicted.
constexpr double slip_part = 0.3;
// Of a residual that is no number.
constexpr double lost = 1e3;

} // namespace

SlipScore::SlipScore(const Campaign& campaign, const SpecimenStructure& built, const WindowComparison& comparison,
                     const TrackScales& scales)
    : windows_(comparison.windows().size()), joints_(campaign.specimen.joints.size())
{
    const Specimen& s = campaign.specimen;
    std::map<std::pair<std::size_t, std::size_t>, double> before; // run, joint: slip at the end of the last window
    for (std::size_t w = 0; w < windows_; ++w) {
        const std::vector<SeenValue>& seen = comparison.seen(w);
        std::map<std::tuple<std::size_t, std::size_t, int>, std::size_t> at; // time, block, coordinate
        std::size_t times = 0;
        for (std::size_t k = 0; k < seen.size(); ++k) {
            at[{seen[k].time, seen[k].block, static_cast<int>(seen[k].coordinate)}] = k;
            times = std::max(times, seen[k].time + 1);
        }
        for (std::size_t j = 0; j < joints_; ++j) {
            const auto [lower, upper] = s.joints[j];
            const std::size_t run = comparison.windows()[w].run;
            double start = 0;
            const auto known = before.find({run, j});
            const bool has_start = known != before.end();
            if (has_start)
                start = known->second;
            for (std::size_t t = 0; t < times; ++t) {
                Slip slip{w, j, {}, 0};
                double value = 0;
                bool there = true;
                const auto part = [&](int block, BlockCoordinate coordinate, double by) {
                    const auto found =
                        at.find({t, static_cast<std::size_t>(built.block[static_cast<std::size_t>(block)]),
                                 static_cast<int>(coordinate)});
                    if (found == at.end()) {
                        there = false;
                        return;
                    }
                    slip.parts.push_back({found->second, by * seen[found->second].scale});
                    value += by * seen[found->second].value;
                };
                part(upper, BlockCoordinate::x, 1);
                part(upper, BlockCoordinate::theta, s.half_height_m[static_cast<std::size_t>(upper)]);
                if (lower >= 0) {
                    part(lower, BlockCoordinate::x, -1);
                    part(lower, BlockCoordinate::theta, s.half_height_m[static_cast<std::size_t>(lower)]);
                }
                if (!there)
                    continue;
                slip.scale = 2 * scales.noise_m + slip_part * (has_start ? std::fabs(value - start) : 0);
                slips_.push_back(slip);
                if (t + 1 == times)
                    before[{run, j}] = value;
            }
        }
    }
}

std::vector<double> SlipScore::operator()(const WindowResiduals& residuals) const
{
    std::vector<double> z;
    std::vector<std::vector<double>> by_joint(joints_);
    for (const Slip& slip : slips_) {
        double r = 0;
        for (const Slip::Part& part : slip.parts)
            r += part.factor * residuals[slip.window][part.at];
        z.push_back(std::isfinite(r) ? std::clamp(r / slip.scale, -lost, lost) : lost);
        by_joint[slip.joint].push_back(z.back());
    }
    std::vector<double> k;
    for (const std::vector<double>& joint : by_joint)
        k.push_back(joint.empty() ? 1 : std::max(student_scale(joint, student_degrees), 0.1));
    std::vector<double> score(windows_, 0);
    for (std::size_t i = 0; i < slips_.size(); ++i) {
        const Slip& slip = slips_[i];
        score[slip.window] += log_student(z[i] / k[slip.joint], student_degrees) - std::log(k[slip.joint] * slip.scale);
    }
    return score;
}

} // namespace stylobate
