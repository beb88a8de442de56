/// `push` by moments about the corner, and by the vibration of the body on the rod's spring.

#include "tests/studies/measured/joint_tests/joint_sample.hpp"

namespace stylobate::joint_sample {
namespace {

struct PushedBody {
    double bond_n = 0;              ///< at the rod, more than what turns the body
    double centre_m = 0;            ///< of the body, to the right
    double left_m = 0, right_m = 0; ///< corners lost
    double offset_m = 0;            ///< of the body on what is below
    bool turns = true;
};

constexpr double body_weight = 3 * weight, rod_height = 0.9 * 6 * half_height, centre_height = 3 * half_height;
constexpr double damping_per_s = 15;

/// Distance of the centre of mass from the end of the bearing to which the body turns.
double arm_of(const PushedBody& body, double side)
{
    const double edge = half_width - std::max(0.0, side * body.offset_m); // the lower face ends there
    return edge - side * body.centre_m - (side > 0 ? body.right_m : body.left_m);
}

/// Force of the rod; what turns the body, then the free vibration that begins with the force that broke the joint.
double force_at(const PushedBody& body, double side, double way, double since_s, double stiffness)
{
    const double arm = arm_of(body, side), turning = body_weight * arm / rod_height;
    // moment of inertia about the corner, seen from the rod
    const double own = (half_width * half_width + 9 * half_height * half_height) / 3;
    const double inertia = 3 * mass * (own + arm * arm + centre_height * centre_height);
    const double w = std::sqrt(stiffness * rod_height * rod_height / inertia), first = turning + body.bond_n;
    const double broke = first / stiffness / push_speed_m_s; // when
    if (!body.turns || since_s < broke)
        return stiffness * std::min(push_speed_m_s * since_s, way);
    const double t = since_s - broke, turned = way / rod_height;
    const double still =
        body_weight * (arm - centre_height * std::tan(turned)) / (rod_height + 0.02 * std::tan(turned));
    const double swing = body.bond_n * std::cos(w * t) + push_speed_m_s * stiffness / w * std::sin(w * t);
    return still + swing * std::exp(-damping_per_s * t);
}

std::vector<MeasuredRun> pushed(const PushedBody& body, unsigned seed)
{
    std::vector<MeasuredRun> runs = plan(RunKind::push);
    for (MeasuredRun& run : runs) {
        ForceGauge& rod = run.forces.front();
        const double side = rod.speed_m_s > 0 ? 1 : -1;
        Path path;
        for (const double t : run.time_s) {
            const double since = std::max(0.0, t - test_start_s), way = std::min(push_reach_m, push_speed_m_s * since);
            const double force = since > 0 ? force_at(body, side, way, since, rod.stiffness_n_m) : 0;
            rod.value_n.values.push_back(side * force);
            const double turned = body.turns ? std::max(0.0, way - force / rod.stiffness_n_m) / rod_height : 0;
            path.theta.push_back(-side * turned);
            path.x.push_back(body.offset_m +
                             side * (half_height * std::sin(turned) + arm_of(body, side) * (1 - std::cos(turned))));
            path.y.push_back(half_width * std::sin(turned));
        }
        see(run, path, seed++);
        disturb(rod.value_n, gauge_n, seed++);
    }
    return runs;
}

/// The peak over the force that turns the body, from the closed form on a fine grid.
double bond_of(const PushedBody& body, double side)
{
    double peak = 0;
    for (double t = 0; t < 0.15; t += 1e-5)
        peak = std::max(peak, force_at(body, side, push_speed_m_s * t, t, 2e4));
    return std::log(peak / (body_weight * arm_of(body, side) / rod_height));
}

std::vector<Estimate> push_estimates(const PushedBody& body, unsigned seed)
{
    return estimates(column(), pushed(body, seed));
}

void expect_push(const PushedBody& body, unsigned seed, double width, double centre)
{
    const auto all = push_estimates(body, seed);
    expect_estimate(all, "push.bond", (bond_of(body, -1) + bond_of(body, 1)) / 2, 0.012, 0.02);
    expect_estimate(all, "push.width", width, 3e-4, 1e-4);
    expect_estimate(all, "push.centre", centre, 1.5e-4, 5e-5);
}

TEST(Push, GivesBearingAndCentreOfABody)
{
    for (const unsigned seed : {1U, 11U, 21U})
        expect_push({}, seed, 0, 0);
    PushedBody aside;
    aside.offset_m = 0.0006; // seen, and allowed for
    expect_push(aside, 31, 0, 0);
}

TEST(Push, TellsCornersFromCentres)
{
    PushedBody chipped;
    chipped.left_m = 0.002;
    expect_push(chipped, 41, -0.002, -0.001);
    PushedBody both;
    both.left_m = both.right_m = 0.0015;
    expect_push(both, 51, -0.003, 0);
    PushedBody heavy;
    heavy.centre_m = 0.001;
    expect_push(heavy, 61, 0, 0.001);
}

TEST(Push, TellsABondByThePeak)
{
    PushedBody bonded;
    bonded.bond_n = 1.5;
    expect_push(bonded, 71, 0, 0);
    EXPECT_GT(bond_of(bonded, 1), bond_of({}, 1) + 0.1);
}

TEST(Push, EstimatesNothingWhereTheBodyDoesNotTurn)
{
    PushedBody stuck;
    stuck.turns = false;
    EXPECT_TRUE(push_estimates(stuck, 81).empty());
    std::vector<MeasuredRun> slid = pushed({}, 91); // the body slides 5 mm and turns a little
    for (MeasuredRun& run : slid)
        for (std::size_t i = 0; i < run.time_s.size(); ++i)
            if (run.time_s[i] > 0.3)
                run.blocks.x_m.values[3 * i + 1] += 0.005 * std::min(1.0, run.time_s[i] - 0.3);
    EXPECT_TRUE(estimates(column(), slid).empty());
    std::vector<MeasuredRun> one = pushed({}, 95);
    one.pop_back();
    const auto half = estimates(column(), one);
    ASSERT_EQ(half.size(), 1U) << "one side says nothing of width and centre";
    EXPECT_EQ(half.front().name, "push.bond");
    std::vector<MeasuredRun> gaps = pushed({}, 97);
    for (MeasuredRun& run : gaps)
        for (std::size_t i = 300; i < 1200; ++i)
            run.blocks.theta_rad.values[3 * i + 1] = none;
    EXPECT_TRUE(estimates(column(), gaps).empty());
}

TEST(PushStatistics, ErrorsAreAsStated)
{
    expect_stated_errors([](unsigned seed) { return push_estimates({}, seed); });
}

} // namespace
} // namespace stylobate::joint_sample
