#include "studies/measured/diagnosis/direct/friction_judgement.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/suggest.hpp"
#include "studies/measured/diagnosis/direct/direct_tests.hpp"
#include "studies/measured/diagnosis/evidence/balance_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace stylobate {

namespace {

// A slide counts from this part of the velocity at which the diagnosis takes a joint to slide: what it takes for the
// slip of one instant asks for four deviations of the noise, a window full of samples of one sign for fewer.
constexpr double slow_part = 0.5;
// The nominal friction has next to no weight.
constexpr double nominal_deviation = 1;
// Half an interval over the standard deviation: that of normal errors. Campaigns of the kernel's own contact laws ask
// for less, those of other laws for as much (docs/calibration.md).
constexpr double deviations = 1.96;
// Fewer windows or slides than these do not show how they err.
constexpr std::size_t least_windows = 3;
constexpr std::size_t least_slides = 2;
// A friction that is known to no better than this factor to either side is not determined.
constexpr double widest_factor = 1.25;

bool slides(const LawSample& s)
{
    return std::any_of(s.terms.begin(), s.terms.end(), [](const LawTerm& t) { return t.law == Law::sliding; });
}

/// Where a combination of laws holds a joint that rocks too, what is wrong of its turning point is taken for friction.
bool mixed(const LawSample& s)
{
    return slides(s) &&
           std::any_of(s.terms.begin(), s.terms.end(), [](const LawTerm& t) { return t.law == Law::rocking; });
}

/// Number of the slide that each sample lies in, from 0; -1 of those that do not slide. Windows of one run less than a
/// time scale apart are of one slide.
std::vector<int> slides_of(const std::vector<LawSample>& samples, double apart_s)
{
    std::vector<int> slide;
    int last = -1, run = -1;
    double time_s = 0;
    for (const LawSample& s : samples) {
        if (!slides(s)) {
            slide.push_back(-1);
            continue;
        }
        if (s.run != run || s.time_s - time_s > apart_s)
            ++last;
        run = s.run;
        time_s = s.time_s;
        slide.push_back(last);
    }
    return slide;
}

/// The rule: from an estimate and its errors to an interval, or to none.
void decide(FrictionJudgement& j)
{
    const std::string seen =
        fmt::format("{} of {} in {}", counted(j.windows, "window"), counted(j.slides, "slide"), counted(j.runs, "run"));
    if (j.windows < least_windows || j.slides < least_slides) {
        j.note = fmt::format("joints slide in no more than {}, too few to estimate their error", seen);
        return;
    }
    const double factor = std::exp(deviations * std::hypot(j.fit, j.leaving_out));
    if (!(j.value > 0) || !(factor <= widest_factor)) {
        j.note =
            fmt::format("{} determine it only between {:.3g} and {:.3g}", seen, j.value / factor, j.value * factor);
        return;
    }
    j.determined = true;
    j.low = j.value / factor;
    j.high = j.value * factor;
    j.note = fmt::format("by the balance of forces, for any contact law: {}", seen);
}

} // namespace

FrictionJudgement judge_friction(const Specimen& specimen, const CampaignScales& scales,
                                 const std::vector<LawSample>& samples, double friction, int runs)
{
    FrictionJudgement j;
    const std::vector<int> slide = slides_of(samples, scales.time_s);
    std::set<int> in_runs;
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (slide[i] >= 0) {
            ++j.windows;
            j.slides = static_cast<std::size_t>(slide[i]) + 1;
            in_runs.insert(samples[i].run);
        }
    j.runs = in_runs.size();
    if (j.windows == 0) {
        j.note = "no joint slides long enough for the balance of forces to determine its friction";
        return j;
    }
    Scatter scatter;
    scatter.common_friction = nominal_deviation;
    const auto without = [&](int left_out) {
        std::vector<LawSample> used;
        for (std::size_t i = 0; i < samples.size(); ++i)
            if (slide[i] < 0 || slide[i] != left_out)
                used.push_back(samples[i]);
        return BalanceFit(specimen, std::move(used), friction, runs, scatter);
    };
    const BalanceFit all = without(-2);
    const double ratio = all.friction_ratio();
    j.value = friction * ratio;
    j.fit = all.friction_ratio_sd() / ratio;
    const double n = static_cast<double>(j.slides);
    if (j.slides > 1) {
        double square = 0;
        for (int left = 0; left < static_cast<int>(j.slides); ++left)
            square += std::pow(without(left).friction_ratio() - ratio, 2);
        j.leaving_out = std::sqrt(square * (n - 1) / n) / ratio;
    }
    decide(j);
    return j;
}

FrictionJudgement judge_friction(const Campaign& campaign, const CampaignScales& scales,
                                 const std::vector<std::vector<double>>& base_m)
{
    CampaignScales slow = scales;
    slow.slip_m_s *= slow_part;
    const auto judged_with = [&](double friction) {
        std::vector<LawSample> all;
        for (const std::vector<LawSample>& found : law_samples(campaign, slow, base_m, friction))
            std::copy_if(found.begin(), found.end(), std::back_inserter(all),
                         [](const LawSample& s) { return !mixed(s); });
        return judge_friction(campaign.specimen, slow, all, friction, static_cast<int>(campaign.runs.size()));
    };
    // twice: what joints differ by is a part of the friction that they have, not of the nominal one
    const FrictionJudgement first = judged_with(nominal_friction(campaign.specimen));
    return first.value > 0 ? judged_with(first.value) : first;
}

FrictionJudgement judge_friction(const Campaign& campaign)
{
    FrictionJudgement unknown;
    try {
        const CampaignScales scales = campaign_scales(campaign);
        return judge_friction(campaign, scales, direct_tests(campaign, scales).base_m);
    } catch (const InputError& error) {
        unknown.note = error.what();
    }
    return unknown;
}

} // namespace stylobate
