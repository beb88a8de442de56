/// Impacts of an ellipse: closed forms against quadrature and by hand, the stepped contact law against rigid impacts,
/// the fit against known parameters.

#include "ensemble/model/input_error.hpp"
#include "studies/evidence/measured/planar_impact/planar_impact_model.hpp"
#include "studies/evidence/measured/planar_impact/planar_impact_study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

namespace {

using namespace stylobate;
using namespace stylobate::measured::impact;

const Body body;

/// Area, chord and centroid of the part of an ellipse below a line, by the midpoint rule on thin horizontal strips.
EllipseOverlap by_quadrature(double height, double theta)
{
    const double s = std::sin(theta), c = std::cos(theta);
    const double A = c * c / (body.a * body.a) + s * s / (body.b * body.b);
    const double B = 2 * s * c * (1 / (body.a * body.a) - 1 / (body.b * body.b));
    const double C = s * s / (body.a * body.a) + c * c / (body.b * body.b);
    // A x^2 + B x y + C y^2 = 1 about the centre
    const auto chord = [&](double y, double& middle) {
        middle = -B * y / (2 * A);
        const double d = B * B * y * y - 4 * A * (C * y * y - 1);
        return d > 0 ? std::sqrt(d) / A : 0;
    };
    const double lowest = -std::sqrt(4 * A / (4 * A * C - B * B));
    EllipseOverlap o;
    double moment_x = 0, moment_y = 0;
    // strips that are thin near the tip, where the chord has a vertical tangent
    constexpr int strips = 200000;
    for (int k = 0; k < strips; ++k) {
        const double t = (k + 0.5) / strips, y = lowest + (-height - lowest) * t * t;
        const double dy = (-height - lowest) * 2 * t / strips;
        double middle = 0;
        const double length = chord(y, middle);
        o.area += length * dy;
        moment_x += middle * length * dy;
        moment_y += y * length * dy;
    }
    double unused = 0;
    o.length = chord(-height, unused);
    o.centroid = {moment_x / o.area, -moment_y / o.area};
    return o;
}

Velocity speed_of_drop(double vx, double spin)
{
    return {vx, -2.5, spin};
}

ImpactLaw stiff(double mu)
{
    ImpactLaw law;
    law.K_N = 1e10;
    law.K_T = 3e10; // sliding begins and ends at once
    law.mu = mu;
    return law;
}

TEST(ImpactStudy, LengthsOfNormalVectors)
{
    // squares: the tabled quantiles of chi2 with 1 and 3 degrees of freedom
    EXPECT_NEAR(std::pow(length_quantile(1, 0.5), 2), 0.454936, 1e-6);
    EXPECT_NEAR(std::pow(length_quantile(1, 0.9), 2), 2.705543, 1e-6);
    EXPECT_NEAR(std::pow(length_quantile(3, 0.5), 2), 2.365974, 1e-6);
    EXPECT_NEAR(std::pow(length_quantile(3, 0.9), 2), 6.251389, 1e-6);
}

} // namespace

TEST(PlanarImpact, OverlapOfAnEllipseAgreesWithQuadrature)
{
    for (const double theta : {0.0, 0.3, 1.1, 1.5707963, -2.4})
        for (const double part : {0.999, 0.97, 0.6, -0.5}) {
            const double height = part * lowest_point(body, theta).t;
            const EllipseOverlap got = ellipse_overlap(body, height, theta), want = by_quadrature(height, theta);
            EXPECT_NEAR(got.area, want.area, 1e-8 * want.area) << theta << ' ' << part;
            EXPECT_NEAR(got.length, want.length, 1e-9);
            EXPECT_NEAR(got.centroid.n, want.centroid.n, 1e-9);
            EXPECT_NEAR(got.centroid.t, want.centroid.t, 1e-9);
        }
    EXPECT_EQ(ellipse_overlap(body, 0.036, 0.4).area, 0);
    // across the change to the series for shallow depths the area is smooth: it grows as depth^1.5
    const double h = lowest_point(body, 0.7).t;
    const double ratio =
        ellipse_overlap(body, h * (1 - 5.01e-7), 0.7).area / ellipse_overlap(body, h * (1 - 4.99e-7), 0.7).area;
    EXPECT_NEAR(ratio, std::pow(5.01 / 4.99, 1.5), 1e-7);
}

TEST(PlanarImpact, WithoutLossesTheEnergyIsKept)
{
    ImpactLaw law;
    law.K_T = 4e5;
    for (const double theta : {0.0, 0.4, -0.8, 1.4}) {
        const Velocity before = speed_of_drop(-0.5, 6);
        const double e0 = kinetic_energy(body, before);
        const SimulatedImpact smooth = simulate_impact(body, law, before, theta, 0.01);
        ASSERT_TRUE(smooth.separated);
        EXPECT_NEAR(kinetic_energy(body, smooth.after) / e0, 1, 1e-3) << theta;
        EXPECT_EQ(smooth.after.x, before.x);
        for (const double C : {3.0, 30.0}) {
            ImpactLaw lossy = law;
            lossy.C_N = C;
            lossy.mu = 0.2;
            lossy.C_T = C;
            EXPECT_LT(kinetic_energy(body, simulate_impact(body, lossy, before, theta).after), e0);
        }
    }
}

TEST(PlanarImpact, RigidImpactByHand)
{
    // A contact straight below the centre: r_n = 0, so that v_n knows nothing of friction, and m v_t changes by
    // (1 + r_t^2 / k^2) P_t.
    const Arms below{0, 0.025};
    const double c = 1 + 0.025 * 0.025 / (0.0192 * 0.0192), normal = 0.0364 * 2.5 * 1.6;
    for (const Restitution rule : {Restitution::total_impulse, Restitution::newton, Restitution::poisson}) {
        // sliding all the time
        Velocity v = rigid_impact(body, {3, -2.5, 0}, below, 0.2, 0.6, rule);
        EXPECT_NEAR(v.y, 1.5, 1e-12);
        EXPECT_NEAR(v.x, 3 - 0.2 * normal / 0.0364, 1e-12);
        EXPECT_NEAR(v.spin, -0.2 * normal * 0.025 / (0.0364 * 0.0192 * 0.0192), 1e-9);
        // sticking
        v = rigid_impact(body, {0.5, -2.5, 0}, below, 0.2, 0.6, rule);
        EXPECT_NEAR(at_contact(v, below).t, 0, 1e-12);
        EXPECT_NEAR(v.x, 0.5 - 0.5 / c, 1e-12);
    }
    // Reversal: sliding that ends while the normal impulse drives the contact on, harder than the cone can hold.
    const Arms aside{0.01, 0.03};
    const double k2 = 0.0192 * 0.0192, nn = 1 + 1e-4 / k2, nt = 3e-4 / k2, tt = 1 + 9e-4 / k2, mu = 0.1;
    ASSERT_GT(nt, mu * tt);
    const Velocity before{-0.6, -2.5, 0};
    const double total = 4;                                // normal impulse per mass
    const double end = 0.6 / (nt + mu * tt);               // where v_t is 0
    const double friction = mu * end - mu * (total - end); // against the sliding, then against the other
    const double v_t = (total - end) * (nt - mu * tt);
    const Impulse p = routh(body, before, aside, mu, total * body.mass);
    EXPECT_NEAR(p.t, friction * body.mass, 1e-12);
    const Velocity after = after_impulse(body, before, aside, p);
    EXPECT_NEAR(at_contact(after, aside).t, v_t, 1e-12);
    EXPECT_GT(v_t, 0);
    // restitution: Newton's ends at -e v_n, Poisson's at (1 + e) times the impulse of the compression
    EXPECT_NEAR(at_contact(rigid_impact(body, before, aside, mu, 0.6, Restitution::newton), aside).n, 1.5, 1e-12);
    const double compression = end + (2.5 - end * (nn + mu * nt)) / (nn - mu * nt);
    ASSERT_GT(compression, end);
    EXPECT_NEAR(rigid_impact(body, before, aside, mu, 0.6, Restitution::poisson).y, -2.5 + 1.6 * compression, 1e-12);
}

TEST(PlanarImpact, BestImpulseOfAnImpulseIsItself)
{
    const Arms arms{-0.006, 0.03};
    const Velocity before{-0.4, -2.4, 3};
    const Velocity after = after_impulse(body, before, arms, {0.14, 0.02});
    const Impulse p = nearest_impulse(body, after - before, arms);
    EXPECT_NEAR(p.n, 0.14, 1e-14);
    EXPECT_NEAR(p.t, 0.02, 1e-14);
    EXPECT_NEAR(lever_residual(body, after - before, arms), 0, 1e-14);
    // a couple besides: its moment over the normal change of momentum
    EXPECT_NEAR(lever_residual(body, {after.x - before.x, after.y - before.y, after.spin - before.spin + 2}, arms),
                body.inertia() * 2 / (body.mass * (after.y - before.y)), 1e-14);
}

TEST(PlanarImpact, StiffContactSlidesSticksAndReversesAsARigidOne)
{
    // The rigid oracle is given the normal impulse of the simulation; the path of the friction is its own.
    int slid = 0, stuck = 0, reversed = 0;
    for (const double theta : {0.0, 0.5, -0.5, 1.0, 2.3, -1.2})
        for (const double vx : {-2.5, -0.6, 0.4})
            for (const double mu : {0.08, 0.2}) {
                ImpactLaw law = stiff(mu);
                law.rate = 0.3;
                const Velocity before = speed_of_drop(vx, 2);
                const Arms arms = lowest_point(body, theta);
                const SimulatedImpact got = simulate_impact(body, law, before, theta, 0.01);
                ASSERT_TRUE(got.separated);
                const double normal = body.mass * (got.after.y - before.y);
                const Velocity want = after_impulse(body, before, arms, routh(body, before, arms, mu, normal));
                EXPECT_LT(relative_error(body, got.after, want), 0.02) << theta << ' ' << vx << ' ' << mu;
                const double t0 = at_contact(before, arms).t, t1 = at_contact(want, arms).t;
                (std::fabs(t1) < 1e-9 ? stuck : t0 * t1 > 0 ? slid : reversed) += 1;
            }
    EXPECT_GT(slid, 3);
    EXPECT_GT(stuck, 3);
    EXPECT_GT(reversed, 3);
}

TEST(PlanarImpact, NormalImpactAgreesWithItsOwnEquationSolvedFinely)
{
    // theta = 0, no friction: m y'' = K A (1 + lambda v) with the segment's area by the textbook formula, Runge-Kutta.
    ImpactLaw law;
    law.rate = 0.37;
    const double got = simulate_impact(body, law, {0, -2.5, 0}, 0, 0.005).after.y;
    const auto force = [&](double y, double v) {
        const double s = std::min(y / body.b, 1.0);
        const double area = body.a * body.b * (std::acos(s) - s * std::sqrt(1 - s * s));
        return std::max(law.K_N * area * (1 - law.rate * v), 0.0) / body.mass;
    };
    double y = body.b, v = -2.5;
    const double dt = 2e-8;
    do {
        const double a1 = force(y, v), v2 = v + dt / 2 * a1, a2 = force(y + dt / 2 * v, v2);
        const double v3 = v + dt / 2 * a2, a3 = force(y + dt / 2 * v2, v3), v4 = v + dt * a3,
                     a4 = force(y + dt * v3, v4);
        y += dt / 6 * (v + 2 * v2 + 2 * v3 + v4);
        v += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    } while (y < body.b);
    EXPECT_NEAR(got, v, 2e-3);
    EXPECT_LT(got, 0.65 * 2.5);
}

TEST(PlanarImpact, FitFindsTheParametersOfSyntheticImpacts)
{
    const Model model = Model{Loss::rate, {}}.with(Term::place);
    std::vector<double> truth = model.start(body);
    truth[0] = std::log(0.23);
    truth[3] = std::log(0.30);
    truth[4] = 0.4;
    truth[5] = 0.2;
    std::mt19937_64 random(1);
    const auto uniform = [&](double a, double b) {
        return a + (b - a) * (static_cast<double>(random() >> 11) * 0x1p-53);
    };
    std::vector<Impact> impacts(60);
    for (Impact& i : impacts) {
        i.x = uniform(0.25, 0.48);
        i.theta = uniform(-3, 3);
        i.before = {uniform(-1, 0), uniform(-2.9, -2.2), uniform(-10, 10)};
        i.after = simulate_impact(body, model.law(body, i, truth), i.before, i.theta).after;
    }
    const std::vector<double> p = fit(body, model, impacts);
    EXPECT_NEAR(std::exp(p[0]), 0.23, 0.002);
    EXPECT_NEAR(std::exp(p[3]), 0.30, 0.005);
    EXPECT_NEAR(p[4], 0.4, 0.02);
    EXPECT_NEAR(p[5], 0.2, 0.03);
    EXPECT_LT(misfit(errors(body, predict(body, model, p, impacts), impacts)), 0.003);
    // the orientation of the observer, by moments alone
    for (Impact& i : impacts)
        i.theta -= 0.03;
    double moment_before = 0, moment_after = 0;
    for (const Impact& i : impacts) {
        moment_before += std::fabs(lever_residual(body, i.after - i.before, lowest_point(body, i.theta)));
        moment_after += std::fabs(lever_residual(body, i.after - i.before, lowest_point(body, i.theta + 0.03)));
    }
    EXPECT_LT(moment_after, 0.5 * moment_before);
}

TEST(PlanarImpact, DependenceIsFoundAndItsNullHolds)
{
    std::mt19937_64 random(2);
    const auto normal = [&] { // sum of twelve uniforms
        double sum = -6;
        for (int k = 0; k < 12; ++k)
            sum += static_cast<double>(random() >> 11) * 0x1p-53;
        return sum;
    };
    const int n = 300;
    Eigen::MatrixXd cause(n, 1), companion(n, 1), stranger(n, 1);
    std::vector<double> residual;
    for (int k = 0; k < n; ++k) {
        cause(k, 0) = normal();
        companion(k, 0) = cause(k, 0) + 0.5 * normal();
        stranger(k, 0) = normal();
        residual.push_back(cause(k, 0) + normal());
    }
    const Eigen::MatrixXd none(n, 0);
    const Dependence on_cause = dependence(residual, cause, none, 499, 3);
    // one column alone: the square of Pearson's correlation
    double xy = 0, xx = 0, yy = 0, mean_x = cause.mean(), mean_y = 0;
    for (const double r : residual)
        mean_y += r / n;
    for (int k = 0; k < n; ++k) {
        const double dx = cause(k, 0) - mean_x, dy = residual[static_cast<std::size_t>(k)] - mean_y;
        xy += dx * dy;
        xx += dx * dx;
        yy += dy * dy;
    }
    EXPECT_NEAR(on_cause.share, xy * xy / (xx * yy), 1e-12);
    EXPECT_NEAR(on_cause.share, 0.5, 0.16); // four standard errors of the sample
    EXPECT_LT(on_cause.null_99, 0.05);
    EXPECT_LE(on_cause.p, 0.002);
    EXPECT_GT(dependence(residual, companion, none, 499, 4).share, 0.25); // only by the company it keeps
    EXPECT_GT(dependence(residual, companion, cause, 499, 5).p, 0.01);
    EXPECT_LE(dependence(residual, cause, companion, 499, 6).p, 0.002);
    EXPECT_GT(dependence(residual, stranger, none, 499, 7).p, 0.01);
}

TEST(PlanarImpact, SimplexFindsTheBottomOfACurvedValley)
{
    const auto valley = [](std::span<const double> p) {
        return 100 * std::pow(p[1] - p[0] * p[0], 2) + std::pow(1 - p[0], 2);
    };
    const std::vector<double> p = minimize(valley, {-1.2, 1}, 0.5, 3000);
    EXPECT_NEAR(p[0], 1, 1e-2);
    EXPECT_NEAR(p[1], 1, 2e-2);
}

TEST(PlanarImpact, BadTablesAreRefusedWithTheirPlace)
{
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "stylobate_planar_impact.csv";
    const auto message = [&](const char* text) -> std::string {
        std::ofstream(file) << text;
        try {
            read_impacts(file);
        } catch (const InputError& e) {
            return e.what();
        }
        return "";
    };
    const std::string head = "i,x_i,th_i,vx_i,vy_i,w_i,n_th,d_th\n";
    EXPECT_NE(message("i,x_i\n1,2\n").find("th_i"), std::string::npos);
    EXPECT_NE(message((head + "0,0.3,0,0.4,-2,1,0,x\n").c_str()).find(":2: d_th = 'x' is not a number"),
              std::string::npos);
    EXPECT_NE(message((head + "0,0.3,0,0.4\n").c_str()).find(":2: 4 cells"), std::string::npos);
    EXPECT_NE(message((head + "0,0.3,0,400,-2,1,0,0.03\n").c_str()).find(":2: vx_i = 400 is outside"),
              std::string::npos);
    EXPECT_NE(message(head.c_str()).find("there is no impact"), std::string::npos);
    EXPECT_EQ(message((head + "7,0.3,0.1,0.4,-2,1,0.001,0.03\n").c_str()), "");
    const std::vector<Impact> one = read_impacts(file);
    EXPECT_EQ(one[0].before.x, -0.4); // turned
    EXPECT_TRUE(std::isnan(one[0].after.x));
    write_predictions(file, one, {{"law", {{-0.25, 1.5, 3}}}});
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line, "i,law_vx_f,law_vy_f,law_w_f");
    std::getline(in, line);
    EXPECT_EQ(line, "7,0.25,1.5,3"); // turned back
    std::filesystem::remove(file);
}

TEST(PlanarImpact, MeasuredImpactsBalanceTheirMomentsOnlyWithTheirVxTurned)
{
    const std::filesystem::path table = std::filesystem::path(STYLOBATE_DATA_DIR) / "planar_impact" / "impacts.csv";
    if (!std::filesystem::exists(table))
        GTEST_SKIP() << "no measured data: " << table;
    const std::vector<Impact> impacts = read_impacts(table);
    EXPECT_EQ(impacts.size(), 1110u);
    std::vector<double> turned, stored, arms;
    for (const Impact& i : impacts) {
        const Arms published{i.arm_n, i.arm_t};
        const Velocity change = i.after - i.before;
        turned.push_back(std::fabs(lever_residual(body, change, published)));
        stored.push_back(std::fabs(lever_residual(body, {-change.x, change.y, change.spin}, published)));
        arms.push_back(std::fabs(lowest_point(body, i.theta).t - i.arm_t));
    }
    EXPECT_LT(quantile(turned, 0.5), 0.001);
    EXPECT_GT(quantile(stored, 0.5), 3 * quantile(turned, 0.5));
    EXPECT_LT(quantile(arms, 0.99), 0.001);
    // the published figures of the best constant pair, which are of all 1718
    std::vector<Arms> published;
    for (const Impact& i : impacts)
        published.push_back({i.arm_n, i.arm_t});
    const std::vector<double> e =
        errors(body, predict_rigid(body, Restitution::total_impulse, {0.20, 0.60}, impacts, published), impacts);
    EXPECT_NEAR(quantile(e, 0.5), 0.147, 0.005);
    EXPECT_NEAR(quantile(e, 0.9), 0.304, 0.02);
}
