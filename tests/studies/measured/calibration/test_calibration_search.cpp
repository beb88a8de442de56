/// The search of a calibration on scores by formula: intervals, ties of two parameters and held-out motions by hand.

#include "io/study/study_file.hpp"
#include "studies/measured/calibration/calibration_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

namespace stylobate {
namespace {

const std::string friction = "contact.friction", damping = "contact.normal_damping_ratio";

Study a_column()
{
    return parse_study("[study]\nkind = \"single\"\n[structure]\nblocks = 2\ndrum_width_m = 1\ndrum_height_m = 1\n"
                       "depth_m = 1\ndensity_kg_m3 = 2700\n[contact]\nnormal_stiffness_n_m2 = 3e9\nfriction = 0.9\n"
                       "normal_damping_ratio = 0.5\n[excitation]\nkind = \"harmonic\"\nfrequency_hz = 1\n"
                       "pga_m_s2 = 1\n",
                       "column.toml");
}

/// Scores of units 0, 1, ..., each of which is a run: a formula of two numbers of the study.
class FormulaEvidence : public CalibrationEvidence {
public:
    using Formula = std::function<double(std::size_t unit, double friction, double damping)>;
    FormulaEvidence(std::size_t units, Formula score) : score_(std::move(score)), runs_(units)
    {
        std::iota(runs_.begin(), runs_.end(), std::size_t{0});
    }

    const std::vector<std::size_t>& runs() const override { return runs_; }
    std::size_t candidates() const override { return at.size(); }
    std::optional<Predictions> predict(const std::vector<Study>& studies, const RunOptions&, Observer&) override
    {
        Predictions all;
        for (const Study& study : studies)
            all.push_back({number_in(study, friction), number_in(study, damping)});
        return all;
    }
    std::vector<double> own_scores(std::size_t candidate, const std::vector<std::size_t>& used) const override
    {
        if (!used.empty())
            scaled_by.emplace_back(candidate, std::set<std::size_t>(used.begin(), used.end()));
        return scores(candidate, candidate);
    }
    std::vector<double> scores(std::size_t candidate, std::size_t) const override
    {
        std::vector<double> all;
        for (const std::size_t unit : runs_)
            all.push_back(score_(unit, at[candidate][0], at[candidate][1]));
        return all;
    }
    SimulationCount cost() const override { return {}; }
    bool take(const Predictions& predictions) override
    {
        at.insert(at.end(), predictions.begin(), predictions.end());
        return true;
    }

    std::vector<std::vector<double>> at; ///< (candidates) friction and damping
    /// Candidates whose scales were fitted to some of the runs, and these.
    mutable std::vector<std::pair<std::size_t, std::set<std::size_t>>> scaled_by;

private:
    Formula score_;
    std::vector<std::size_t> runs_;
};

class Unheard : public SearchProgress {
public:
    void stage(const std::string&) override {}
    void advance(std::size_t) override {}
    void spare(std::size_t) override {}
};

FitKey linear(const std::string& key)
{
    return {.key = key, .from = 0.1, .to = 1.1, .logarithmic = false, .method_deviation = 0};
}

FormCalibration searched(FormulaEvidence& evidence, const std::vector<FitKey>& keys,
                         const std::vector<std::size_t>& fold = {}, std::size_t folds = 0)
{
    CalibrationOptions options;
    options.scan = 16;
    options.refine = 8;
    options.surface = 24;
    options.profile = 4; // at 0, 1/3, 2/3 and 1 of the range, where no other point lies
    options.held_out = folds > 1;
    Observer observer;
    Unheard progress;
    CalibrationSearch search(a_column(), a_column(), keys, options, evidence, {}, observer, progress);
    const auto found = search.run(fold, folds);
    EXPECT_TRUE(found);
    return found.value_or(FormCalibration{});
}

/// Eight units whose scores are -h (x - a)^2 / 2: the best point of all is the mean of the a, 0.5. The sum of their
/// scatter S makes its variance J / (n h)^2, J = h^2 S n / (n - 1); that of the curvature alone is 1 / (n h). With
/// h = 1250 and S = 4 (n - 1) / h the one is 4 times the other, and the deviation is sqrt(4 / 1e4) = 0.02.
constexpr double curvature = 1250, deviation = 0.02;
const std::vector<double> offsets = [] {
    std::vector<double> a = {-1.4, -0.8, -0.6, -0.2, 0.2, 0.6, 0.8, 1.4}; // of a sum of squares of 6
    for (double& each : a)
        each = 0.5 + each * std::sqrt(4 * 7 / curvature / 6);
    return a;
}();

double parabola(std::size_t unit, double x)
{
    return -curvature / 2 * std::pow(x - offsets[unit], 2);
}

/// Two thirds of the range of the keys: a point of the profile.
const double shoulder = 0.1 + 2.0 / 3;

/// The parabolas, but at that point, where the sum of all is so far below its largest value.
FormulaEvidence::Formula with_a_shoulder(double below, double roughness = 0)
{
    return [=](std::size_t unit, double x, double) {
        const double largest = parabola(unit, 0.5);
        // common to all units, so that no slope scatters more by it: + or - by the last digits of the point
        const double rough = roughness / 8 * (static_cast<int>(std::floor(x * 1e5)) % 2 == 0 ? 1 : -1);
        return std::fabs(x - shoulder) < 1e-9 ? largest - below / 8 : parabola(unit, x) + rough;
    };
}

TEST(CalibrationSearch, AnIntervalIs196Deviations)
{
    FormulaEvidence evidence(8, with_a_shoulder(100));
    const FittedParameter p = searched(evidence, {linear(friction)}).parameters.front();
    // the prior of deviation 0.2887 has 1.2e-3 of the information
    EXPECT_NEAR(p.value, 0.5, 1e-3);
    EXPECT_NEAR(p.high - p.value, 1.96 * deviation, 0.003 * deviation);
    EXPECT_NEAR(p.value - p.low, 1.96 * deviation, 0.003 * deviation);
    EXPECT_TRUE(p.determined);
    // an error of the method of 10 % of the value adds to the variance
    FitKey followed = linear(friction);
    followed.method_deviation = 0.1;
    FormulaEvidence again(8, with_a_shoulder(100));
    const FittedParameter wider = searched(again, {followed}).parameters.front();
    EXPECT_NEAR(wider.high - wider.value, 1.96 * std::hypot(deviation, 0.05), 0.003 * deviation);
    // of a logarithmic key it is that of the logarithm
    followed.logarithmic = true;
    FormulaEvidence third(8, with_a_shoulder(100));
    const FittedParameter ratio = searched(third, {followed}).parameters.front();
    EXPECT_NEAR(std::log(ratio.high / ratio.value), 1.96 * std::hypot(deviation / 0.5, 0.1), 0.03 * deviation);
}

/// Of a profile all values belong to the interval at which the score has not dropped by 1.92 (half of chi2's 3.84)
/// times the overdispersion, and 1.96 roughnesses more.
TEST(CalibrationSearch, AnIntervalHasWhereverTheProfileHasNotDropped)
{
    const auto high = [](double below, double rough, double* roughness = nullptr) {
        FormulaEvidence evidence(8, with_a_shoulder(below, rough));
        const FormCalibration found = searched(evidence, {linear(friction)});
        if (roughness)
            *roughness = found.roughness;
        return found.parameters.front().high;
    };
    // 4 x 1.92 = 7.68; the prior takes 0.01 off
    EXPECT_NEAR(high(7.6, 0), shoulder, 1e-9);
    EXPECT_NEAR(high(7.76, 0), 0.5 + 1.96 * deviation, 1e-3);
    double roughness = 0;
    EXPECT_NEAR(high(9.0, 1, &roughness), shoulder, 1e-9) << "7.68 + 1.96 x 1";
    EXPECT_NEAR(roughness, 1, 0.15) << "the fit takes 3 of some 40 degrees of freedom";
    EXPECT_NEAR(high(10.8, 1), 0.5 + 1.96 * deviation, 0.3 * deviation);
}

/// Two numbers of which the data know the sum: of their difference each unit says something else, by +-`apart`.
TEST(CalibrationSearch, TwoThatAreKnownTogetherOnlyAreNotDetermined)
{
    const auto found = [](double weight, double apart) {
        FormulaEvidence evidence(8, [=](std::size_t unit, double x, double y) {
            const double sum = x + y - 1 - (offsets[unit] - 0.5) / 10;
            const double difference = x - y - (unit % 4 == 0 || unit % 4 == 3 ? apart : -apart);
            return -curvature / 2 * sum * sum - weight / 2 * difference * difference;
        });
        return searched(evidence, {linear(friction), linear(damping)});
    };
    // deviations of x and y of 0.11, and of a tenth of it: 1.96 of them to either side are 0.42 and 0.05 of the range
    const FormCalibration tied = found(3.75, 0.64), narrow = found(375, 0.064);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_FALSE(tied.parameters[i].determined) << i;
        EXPECT_EQ(tied.parameters[i].note,
                  "not determined by these data alone: only together with " + tied.parameters[1 - i].key);
        EXPECT_TRUE(narrow.parameters[i].determined) << i << ": narrow all the same";
    }
    EXPECT_LT(tied.correlation[1], -0.95);
    EXPECT_LT(narrow.correlation[1], -0.95);
}

/// The parameters by which a motion is predicted, and the scales by which it is scored, are those of the other motions.
TEST(CalibrationSearch, AHeldOutFoldNeverEntersItsFit)
{
    FormulaEvidence evidence(8, [](std::size_t unit, double x, double) { return parabola(unit, x); });
    const std::vector<std::size_t> fold = {0, 1, 2, 3, 0, 1, 2, 3};
    const FormCalibration found = searched(evidence, {linear(friction)}, fold, 4);
    ASSERT_GT(evidence.at.size(), 4U);
    const std::size_t first = evidence.at.size() - 4;
    double gain = 0;
    std::vector<double> gains(4);
    for (std::size_t f = 0; f < 4; ++f) {
        const double x = evidence.at[first + f][0];
        double others = 0;
        std::set<std::size_t> used;
        for (std::size_t u = 0; u < 8; ++u)
            if (fold[u] != f) {
                others += offsets[u] / 6;
                used.insert(u);
            }
        EXPECT_NEAR(x, others, 5e-4) << "the mean of the six others, 0.01 from the next; the prior pulls a little";
        for (const std::size_t candidate : {first + f, std::size_t{0}}) // and the study as it was given
            EXPECT_EQ(std::count(evidence.scaled_by.begin(), evidence.scaled_by.end(), std::pair(candidate, used)), 1)
                << f;
        for (const std::size_t u : {f, f + 4})
            gains[f] += parabola(u, x) - parabola(u, 0.9);
        gain += gains[f];
    }
    EXPECT_EQ(evidence.scaled_by.size(), 8U);
    EXPECT_NEAR(found.held_out.total, gain, 1e-9 * gain);
    EXPECT_EQ(found.held_out.groups, 4U);
    // Student's interval of four sums: t(0.975, 3) = 3.182446
    double squares = 0;
    for (const double g : gains)
        squares += std::pow(g - gain / 4, 2);
    EXPECT_NEAR(found.held_out.high - gain, 3.182446 * std::sqrt(4 * squares / 3), 1e-4 * squares);
    ASSERT_EQ(found.runs.size(), 8U);
    EXPECT_NEAR(found.runs[5].nominal, parabola(5, 0.9), 1e-9);
    EXPECT_NEAR(found.runs[5].calibrated, parabola(5, evidence.at[first + 1][0]), 1e-9);
}

} // namespace
} // namespace stylobate
