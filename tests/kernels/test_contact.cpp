// The contact law: Eqs. 1 to 3 with their limits, by hand and over random sweeps.

#include "kernels/planar/contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace stylobate {
namespace {

/// The laboratory specimen's joint with one dashpot of each kind, both per contact.
JointLaw<double> law()
{
    return {1e8, 4.8e6, 3e5, 2e5, 0, 0, 0.68};
}

/// Moves a joint and keeps its history.
struct Bed {
    JointLaw<double> joint;
    double spring = 0;
    ContactForce<double> force{};

    double move(double area, double sliding)
    {
        force = contact_force(joint, area, 0.048, 0.0, sliding, spring);
        spring = force.spring;
        return force.tangential;
    }
};

TEST(Contact, NormalForceByHand)
{
    // 1e8 N/m2 x 2e-8 m2 = 2 N, and 3e5 N/m x 1e-6 m = 0.3 N while closing
    EXPECT_DOUBLE_EQ(contact_force(law(), 2e-8, 0.048, 0.0, 0.0, 0.0).normal, 2.0);
    EXPECT_DOUBLE_EQ(contact_force(law(), 2e-8, 0.048, 1e-6, 0.0, 0.0).normal, 2.3);
    EXPECT_DOUBLE_EQ(contact_force(law(), 2e-8, 0.048, -1e-6, 0.0, 0.0).normal, 1.7);
    // opening so fast that the dashpot would pull: nothing
    EXPECT_EQ(contact_force(law(), 2e-8, 0.048, -1e-5, 0.0, 0.0).normal, 0);
}

TEST(Contact, TangentialForceByHand)
{
    // the normal force is 2 N, the cone 1.36 N; spring 4.8e6 N/m x 1e-7 m = 0.48 N, dashpot 2e5 N/m x 1e-7 m = 0.02 N
    ContactForce<double> f = contact_force(law(), 2e-8, 0.048, 0.0, 1e-7, 0.0);
    EXPECT_DOUBLE_EQ(f.spring, 0.48);
    EXPECT_DOUBLE_EQ(f.tangential, 0.50);
    EXPECT_EQ(f.excess, 0);
    // from 1.2 N the trial is 1.68 N: the spring keeps 1.36 N, and 0.32 N / K_T was slip
    f = contact_force(law(), 2e-8, 0.048, 0.0, 1e-7, 1.2);
    EXPECT_DOUBLE_EQ(f.spring, 1.36);
    EXPECT_DOUBLE_EQ(f.tangential, 1.36);
    EXPECT_NEAR(f.excess, 0.32, 1e-15);
    // from 1.35 N back by 1e-8 m: elastic, both parts turned
    f = contact_force(law(), 2e-8, 0.048, 0.0, -1e-8, 1.35);
    EXPECT_DOUBLE_EQ(f.spring, 1.35 - 0.048);
    EXPECT_DOUBLE_EQ(f.tangential, 1.35 - 0.048 - 0.002);
    // the dashpot may fill the cone but not leave it, and takes nothing from the spring
    f = contact_force({1e8, 4.8e6, 3e5, 2e8, 0, 0, 0.68}, 2e-8, 0.048, 0.0, 1e-7, 0.0);
    EXPECT_DOUBLE_EQ(f.spring, 0.48);
    EXPECT_DOUBLE_EQ(f.tangential, 1.36);
    EXPECT_EQ(f.excess, 0);
}

TEST(Contact, NothingWhereTheBlocksAreApart)
{
    for (double spring : {0.0, 1.3, -1e6}) {
        const ContactForce<double> f = contact_force(law(), 0.0, 0.0, 0.0, 0.0, spring);
        EXPECT_EQ(f.normal, 0);
        EXPECT_EQ(f.tangential, 0);
        EXPECT_EQ(f.spring, 0);
        EXPECT_EQ(f.excess, std::fabs(spring)); // the history is let go
    }
}

TEST(Contact, DashpotPerContactOrPerLength)
{
    const double closing = 1e-6, sliding = 1e-9;
    const JointLaw<double> contact{1e8, 4.8e6, 3e5, 2e5, 0, 0, 0.68};
    const JointLaw<double> chord{1e8, 4.8e6, 0, 0, 3e5 / 0.048, 2e5 / 0.048, 0.68};
    const auto dashpots = [&](const JointLaw<double>& joint, double length) {
        const ContactForce<double> f = contact_force(joint, 1e-6, length, closing, sliding, 0.0);
        return std::pair{f.normal - 100, f.tangential - f.spring};
    };
    for (double length : {0.048, 0.024, 1e-6}) {
        const auto [n, t] = dashpots(contact, length);
        EXPECT_NEAR(n, 0.3, 1e-12); // the same at any length
        EXPECT_NEAR(t, 2e-4, 1e-15);
        const auto [cn, ct] = dashpots(chord, length);
        EXPECT_NEAR(cn, 0.3 * length / 0.048, 1e-12); // no jump when a sliver of contact appears
        EXPECT_NEAR(ct, 2e-4 * length / 0.048, 1e-15);
    }
}

TEST(Contact, LimitsHoldForAnything)
{
    std::mt19937_64 engine(1);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); };
    const auto magnitude = [&](double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); };
    const auto either = [&](double a, double b) { return (uniform(-1, 1) < 0 ? -1 : 1) * magnitude(a, b); };
    int slipping = 0, sticking = 0, pulled = 0;
    for (int i = 0; i < 200000; ++i) {
        const JointLaw<double> joint{magnitude(1e5, 1e11),          magnitude(1e4, 1e10),
                                     i % 2 ? magnitude(1, 1e7) : 0, i % 3 ? magnitude(1, 1e7) : 0,
                                     i % 2 ? 0 : magnitude(1, 1e9), i % 3 ? 0 : magnitude(1, 1e9),
                                     i % 7 ? uniform(0, 1.5) : 0};
        const double area = magnitude(1e-15, 1e-3), length = magnitude(1e-9, 1);
        const double closing = either(1e-12, 1e-3), sliding = either(1e-12, 1e-3), spring = either(1e-6, 1e4);
        const ContactForce<double> f = contact_force(joint, area, length, closing, sliding, spring);
        ASSERT_GE(f.normal, 0);
        ASSERT_LE(std::fabs(f.tangential), joint.mu * f.normal);
        ASSERT_LE(std::fabs(f.spring), joint.mu * f.normal);
        ASSERT_GE(f.excess, 0);
        const double stiff = joint.K_n * area;
        if (closing > 0) {
            ASSERT_GE(f.normal, stiff);
        } else {
            ASSERT_LE(f.normal, stiff);
        }
        pulled += f.normal == 0;
        const double trial = std::fma(joint.K_t, sliding, spring);
        if (f.excess > 0) {
            ++slipping;
            // on the cone, on the side of the trial, and nothing lost
            ASSERT_EQ(std::fabs(f.spring), joint.mu * f.normal);
            ASSERT_GE(f.spring * trial, 0);
            ASSERT_NEAR(f.excess + std::fabs(f.spring), std::fabs(trial), 1e-12 * std::fabs(trial));
        } else {
            ++sticking;
            ASSERT_EQ(f.spring, trial);
        }
        // the dashpot never works against its own sense
        ASSERT_GE((f.tangential - f.spring) * sliding, 0);
        // mirror image
        const ContactForce<double> m = contact_force(joint, area, length, closing, -sliding, -spring);
        ASSERT_EQ(m.normal, f.normal);
        ASSERT_EQ(m.tangential, -f.tangential);
        ASSERT_EQ(m.spring, -f.spring);
        ASSERT_EQ(m.excess, f.excess);
    }
    EXPECT_GT(slipping, 10000);
    EXPECT_GT(sticking, 10000);
    EXPECT_GT(pulled, 1000);
}

TEST(Contact, WithoutFrictionNothingIsHeld)
{
    JointLaw<double> joint = law();
    joint.mu = 0;
    const ContactForce<double> f = contact_force(joint, 2e-8, 0.048, 0.0, 1e-6, 0.5);
    EXPECT_EQ(f.tangential, 0);
    EXPECT_EQ(f.spring, 0);
}

TEST(Contact, ElasticLoopGivesItsWorkBack)
{
    JointLaw<double> joint = law();
    joint.C_t_per_dt = 0;
    Bed bed{joint};
    const double step = 1e-10; // up to 1e-7 m: 0.48 N of 1.36
    double work = 0, before = 0;
    for (int i = 0; i < 4000; ++i) {
        const double ds = (i / 1000 == 0 || i / 1000 == 3) ? step : -step;
        const double now = bed.move(2e-8, ds);
        work += 0.5 * (before + now) * ds;
        before = now;
    }
    EXPECT_NEAR(work, 0, 1e-15);
    EXPECT_NEAR(bed.spring, 0, 1e-12);
}

TEST(Contact, SlipLoopLosesFrictionTimesPath)
{
    // to and fro between -X and X: a parallelogram of 4 mu F_N (X - mu F_N / K_T)
    JointLaw<double> joint = law();
    joint.C_t_per_dt = 0;
    Bed bed{joint};
    const double X = 1e-5, step = 1e-9, limit = 0.68 * 2, stretch = limit / joint.K_t;
    const int quarter = 10000;
    double work = 0, slip = 0, before = 0;
    const auto leg = [&](int count, double ds, bool counted) {
        for (int i = 0; i < count; ++i) {
            const double now = bed.move(2e-8, ds);
            if (counted) {
                work += 0.5 * (before + now) * ds;
                slip += bed.force.excess / joint.K_t;
            }
            before = now;
        }
    };
    leg(quarter, step, false); // the virgin curve
    leg(2 * quarter, -step, true);
    leg(2 * quarter, step, true);
    const double closed = 4 * limit * (X - stretch);
    EXPECT_NEAR(work / closed, 1, 1e-6);
    EXPECT_NEAR(slip, 4 * (X - stretch), 1e-6 * X);
    EXPECT_NEAR(bed.spring, limit, 1e-12);
}

TEST(Contact, LessPressureLetsTheSpringSlip)
{
    Bed bed{law()};
    bed.move(2e-8, 2.5e-7);
    EXPECT_DOUBLE_EQ(bed.spring, 1.2);
    bed.move(1e-8, 0); // 1 N presses: the cone is 0.68 N
    EXPECT_DOUBLE_EQ(bed.spring, 0.68);
    bed.move(2e-8, 0); // pressing harder again does not bring it back
    EXPECT_DOUBLE_EQ(bed.spring, 0.68);
}

} // namespace
} // namespace stylobate
