/// The reference of rigid blocks: its points of contact, its laws of impact, its motion, and where the rigid form of
/// the kernels comes to it.

#include "bench/rigid_reference/column.hpp"
#include "bench/rocking_cells.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/sampling/sampler.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace stylobate;
using namespace stylobate::reference;

namespace {

constexpr double b = 0.024, h = 0.087, mass = 0.813;
constexpr double alpha = 0.269167493, housner = 0.893922652, p = 9.029056345; // of this block

Body block(double half_width, double half_height, double m, double mu)
{
    return {half_width, half_height, 1 / m, 3 / (m * (half_width * half_width + half_height * half_height)), mu};
}

/// Blocks of one size on a wider base, each a little off the one below, so that no corner lies on another one.
struct Stack {
    Bodies bodies;
    Twists places;
    Stack(int blocks, double half_height, double mu)
    {
        bodies.push_back({2 * b, 0.01, 0, 0, 0});
        places.push_back({0, -0.01, 0});
        for (int i = 0; i < blocks; ++i) {
            bodies.push_back(block(b, half_height, mass, mu));
            places.push_back({(i % 2 == 0 ? 1 : -1) * 1e-4, half_height * (2 * i + 1), 0});
        }
    }
    /// All turn as one about the left lower corner of the lowest.
    Twists turning(double rate) const
    {
        Twists v(bodies.size());
        const double x = places[1].x - b;
        for (std::size_t i = 1; i < v.size(); ++i)
            v[i] = {-rate * places[i].y, rate * (places[i].x - x), rate};
        return v;
    }
};

constexpr ImpactLaw plastic_laws[]{ImpactLaw::together, ImpactLaw::sequential, ImpactLaw::viscous};

Twists after(const Stack& stack, const Impacts& impacts, const Twists& before)
{
    Column column(stack.bodies, stack.places, impacts);
    Contacts contacts = column.touching();
    Twists v = before;
    const bool ended = strike(stack.bodies, impacts, contacts, v);
    EXPECT_TRUE(ended || impacts.law == ImpactLaw::compliant) << "springs with strong dashpots take long to let go";
    for (const Contact& c : contacts)
        EXPECT_GE(normal_rate(c, v), -1e-6);
    return v;
}

double distance(const Bodies& bodies, const Twists& v, const Twists& w)
{
    Twists d;
    for (std::size_t i = 0; i < v.size(); ++i)
        d.push_back(v[i] + -1.0 * w[i]);
    return kinetic_energy(bodies, d);
}

/// Of all sets of points that keep their gaps, without friction: the least change that leaves none closing.
Twists nearest_that_closes_nothing(const Stack& stack, const Contacts& contacts, const Twists& before)
{
    const auto row = [&](const Contact& c) {
        Eigen::VectorXd r = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * stack.bodies.size()));
        const auto put = [&](int body, const Twist& q) { r.segment<3>(3 * body) << q.x, q.y, q.theta; };
        put(c.lower, c.rows.normal_lower);
        put(c.upper(), c.rows.normal_upper);
        return r;
    };
    Eigen::VectorXd weight(3 * stack.bodies.size()), v0(weight.size());
    for (std::size_t i = 0; i < stack.bodies.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(3 * i);
        weight.segment<3>(at) << stack.bodies[i].per_mass, stack.bodies[i].per_mass, stack.bodies[i].per_inertia;
        v0.segment<3>(at) << before[i].x, before[i].y, before[i].theta;
    }
    double least = std::numeric_limits<double>::infinity();
    Eigen::VectorXd best = v0;
    for (unsigned set = 0; set < (1U << contacts.size()); ++set) {
        Eigen::MatrixXd J(weight.size(), 0);
        for (std::size_t i = 0; i < contacts.size(); ++i)
            if (set >> i & 1U) {
                J.conservativeResize(Eigen::NoChange, J.cols() + 1);
                J.col(J.cols() - 1) = row(contacts[i]);
            }
        Eigen::VectorXd v = v0;
        if (J.cols() > 0)
            v -= weight.asDiagonal() * J *
                 (J.transpose() * weight.asDiagonal() * J).completeOrthogonalDecomposition().solve(J.transpose() * v0);
        const bool open =
            std::all_of(contacts.begin(), contacts.end(), [&](const Contact& c) { return row(c).dot(v) > -1e-10; });
        double change = 0;
        for (Eigen::Index i = 0; i < v.size(); ++i)
            if (weight[i] > 0)
                change += (v[i] - v0[i]) * (v[i] - v0[i]) / weight[i];
        if (open && change < least) {
            least = change;
            best = v;
        }
    }
    Twists out;
    for (Eigen::Index i = 0; i < best.size(); i += 3)
        out.push_back({best[i], best[i + 1], best[i + 2]});
    return out;
}

} // namespace

TEST(RigidReference, RatesAreThoseOfTheGaps)
{
    const Body lower = block(0.024, 0.015, 1, 1), upper = block(0.023, 0.014, 1, 1);
    const Twist at_lower{0.01, 0.02, 0.3}, at_upper{0.003, 0.049, 0.22};
    const Twist v_lower{0.3, -0.2, 0.7}, v_upper{-0.1, 0.4, -1.1};
    const double dt = 1e-6;
    for (int k = 0; k < corners_of_bed; ++k) {
        const auto corner = static_cast<Corner>(k);
        const auto at = [&](double t) {
            return meeting(lower, upper, at_lower + t * v_lower, at_upper + t * v_upper, corner);
        };
        const ContactRows r = rows(lower, upper, at_lower, at_upper, corner);
        EXPECT_NEAR(dot(r.normal_lower, v_lower) + dot(r.normal_upper, v_upper), (at(dt).gap - at(-dt).gap) / (2 * dt),
                    1e-9);
        EXPECT_NEAR(dot(r.along_lower, v_lower) + dot(r.along_upper, v_upper),
                    (at(dt).along - at(-dt).along) / (2 * dt), 1e-9);
    }
}

TEST(RigidReference, OneBlockLosesWhatHousnerSays)
{
    const Stack stack(1, h, 5);
    for (const ImpactLaw law : plastic_laws) {
        const Twists v = after(stack, {.law = law}, stack.turning(-1));
        EXPECT_NEAR(-v[1].theta, housner, 5e-3) << "the block is 1e-4 m off its middle";
    }
}

TEST(RigidReference, ImpactsKeepMomentumAndGainNoEnergy)
{
    Stack stack(4, 0.0145, 0.3);
    stack.bodies[0] = block(2 * b, 0.01, 2, 0);
    Twists before = stack.turning(-2);
    before[3].x += 0.1;
    const auto momentum = [&](const Twists& v) {
        Twist sum;
        for (std::size_t i = 0; i < v.size(); ++i) {
            const double m = 1 / stack.bodies[i].per_mass;
            sum += {m * v[i].x, m * v[i].y,
                    v[i].theta / stack.bodies[i].per_inertia +
                        m * (stack.places[i].x * v[i].y - stack.places[i].y * v[i].x)};
        }
        return sum;
    };
    for (const ImpactLaw law : plastic_laws) {
        const Twists v = after(stack, {.law = law}, before);
        const Twist p0 = momentum(before), p1 = momentum(v);
        EXPECT_NEAR(p1.x, p0.x, 1e-12);
        EXPECT_NEAR(p1.y, p0.y, 1e-12);
        EXPECT_NEAR(p1.theta, p0.theta, 1e-12);
        EXPECT_LT(kinetic_energy(stack.bodies, v), 0.99 * kinetic_energy(stack.bodies, before));
    }
}

TEST(RigidReference, TogetherIsTheNearestMotionThatClosesNothing)
{
    for (const int blocks : {1, 2, 4}) {
        const Stack stack(blocks, 0.0145, 0);
        Twists before = stack.turning(-1);
        before.back().theta += 2;
        const Twists v = after(stack, {.law = ImpactLaw::together}, before);
        const Twists best =
            nearest_that_closes_nothing(stack, Column(stack.bodies, stack.places, {}).touching(), before);
        EXPECT_NEAR(distance(stack.bodies, v, best), 0, 1e-14) << blocks;
        EXPECT_GT(distance(stack.bodies, v, before), 1e-6);
    }
}

TEST(RigidReference, DashpotsWithoutSpringsAreTheLimitOfHighDampingRatios)
{
    const Stack stack(3, 0.0145, 0.68);
    Twists before = stack.turning(-1);
    before.back().theta += 2; // the uppermost lands the other way
    const Twists viscous = after(stack, {.law = ImpactLaw::viscous, .fineness = 0.02}, before);
    double last = std::numeric_limits<double>::infinity();
    for (const double ratio : {1.0, 4.0, 16.0, 64.0}) {
        const double off =
            std::sqrt(distance(stack.bodies,
                               after(stack, {.law = ImpactLaw::compliant, .damping_ratio = ratio}, before), viscous) /
                      kinetic_energy(stack.bodies, before));
        EXPECT_LT(off, last) << ratio;
        last = off;
    }
    EXPECT_LT(last, 0.01);
    const auto off_by = [&](ImpactLaw law) {
        return std::sqrt(distance(stack.bodies, after(stack, {.law = law}, before), viscous) /
                         kinetic_energy(stack.bodies, before));
    };
    EXPECT_GT(off_by(ImpactLaw::together), 0.01);
    EXPECT_GT(off_by(ImpactLaw::sequential), 0.01);
}

TEST(RigidReference, QuarterPeriodIsThatOfTheIntegral)
{
    Stack stack(1, h, 5);
    const double lean = 0.5 * alpha, x = stack.places[1].x - b, c = std::cos(lean), s = std::sin(lean);
    stack.places[1] = {x + c * b - s * h, s * b + c * h, lean};
    Column column(stack.bodies, stack.places, {});
    const double dt = 1e-4;
    double time = 0, before = lean;
    while (column.counts().impacts == 0 && time < 1) {
        before = column.places()[1].theta;
        column.step(dt, 0, -9.81);
        time += dt;
    }
    EXPECT_NEAR(time - dt + before / -column.velocities()[1].theta * housner, 0.146168, 2e-5);
    EXPECT_LT(std::fabs(column.places()[1].theta), 1e-4);
    EXPECT_NEAR(p * p * 4 * std::hypot(b, h) / 3, 9.81, 1e-6);
}

namespace {

/// The largest difference of a rotation from that of the rigid form at the time.
struct Apart {
    double rotation = 0, difference = 0;
    std::uint64_t impacts = 0;
};
Apart apart(const Cell& cell, std::uint64_t index, double reference_step_s, int finer, double until_s)
{
    const Study study = cell_study(cell, {.step_s = reference_step_s / finer}, index + 1);
    const Realization r = Sampler(study, nullptr).realization(index);
    Draw draw(study, r, {}, reference_step_s);
    LaneSet set(study, nullptr, kernels(Isa::scalar), r);
    set.load(0, r);
    for (int n = 0; draw.time_s() < until_s;) {
        draw.step();
        for (int k = 0; k < finer; ++k, ++n)
            set.advance(n % chunk_steps, n % chunk_steps + 1);
    }
    const Snapshot now = set.snapshot(0);
    Apart out;
    out.impacts = draw.column().counts().impacts;
    for (std::size_t i = 0; i < now.theta_rad.size(); ++i) {
        out.rotation = std::max(out.rotation, std::fabs(draw.moved()[i].theta_rad));
        out.difference = std::max(out.difference, std::fabs(draw.moved()[i].theta_rad - now.theta_rad[i]));
    }
    return out;
}

const Cell& six_drums_a()
{
    static const std::vector<Cell> cells = rocking_cells();
    return *std::find_if(cells.begin(), cells.end(), [](const Cell& c) { return c.name == "six_drums_a"; });
}

} // namespace

TEST(RigidReference, AgreesWithTheRigidFormUpToTheSecondImpact)
{
    const Apart found = apart(six_drums_a(), 0, 1.0 / 15360, 1, 0.598);
    EXPECT_EQ(found.impacts, 1U);
    EXPECT_GT(found.rotation, 0.01);
    EXPECT_LT(found.difference, 1e-6);
}

TEST(RigidReference, RigidFormComesToItWhereImpactsAreLessThanAStepApart)
{
    // between the third and the seventh impact lie 1e-4 s
    const Apart coarse = apart(six_drums_a(), 0, 1.0 / 15360, 1, 0.60475);
    const Apart fine = apart(six_drums_a(), 0, 1.0 / 15360, 16, 0.60475);
    EXPECT_EQ(coarse.impacts, 4U);
    EXPECT_GT(coarse.difference, 2e-5);
    EXPECT_LT(fine.difference, 5e-6);
}
