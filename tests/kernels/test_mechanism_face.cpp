/// Mechanisms of the faces and contact forms, each against its closed form, through the real kernel.

#include "ensemble/planar/structure/static_state.hpp"
#include "ensemble/planar/structure/step_bound.hpp"
#include "kernels/planar/mechanisms/corner_wear.hpp"
#include "studies/evidence/verification/trials.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

using namespace stylobate;
using namespace stylobate::model;

namespace {

/// The monolith on a base of its own width.
Realization mono(double K_n, double xi = 0)
{
    const double rate = std::sqrt(K_n * mono_stone.width / mono_stone.mass);
    Realization r = single(mono_stone, {K_n, xi, 5}, 0.1 / rate);
    return r;
}

/// Frequency [Hz] of what `value` does from the second half of the first period on, by its upward crossings.
double frequency(const Realization& r, const std::vector<double>& history)
{
    double mean = 0;
    for (const double v : history)
        mean += v / static_cast<double>(history.size());
    std::vector<double> times;
    for (std::size_t i = 1; i < history.size(); ++i)
        if (history[i - 1] < mean && history[i] >= mean)
            times.push_back((static_cast<double>(i) - (history[i] - mean) / (history[i] - history[i - 1])) * r.step_s);
    return static_cast<double>(times.size() - 1) / (times.back() - times.front());
}

/// The same near a guess, where other modes are in it: the peak of its spectrum under a Hann window.
double frequency_near(const Realization& r, const std::vector<double>& history, double guess)
{
    double mean = 0;
    for (const double v : history)
        mean += v / static_cast<double>(history.size());
    const double pi2 = 2 * std::numbers::pi;
    double best = 0, found = 0;
    for (double f = 0.95 * guess; f < 1.05 * guess; f += 5e-4 * guess) {
        double re = 0, im = 0;
        for (std::size_t i = 0; i < history.size(); i += 4) {
            const double t = static_cast<double>(i), size = static_cast<double>(history.size());
            const double value = (history[i] - mean) * (1 - std::cos(pi2 * t / size));
            re += value * std::cos(pi2 * f * t * r.step_s);
            im += value * std::sin(pi2 * f * t * r.step_s);
        }
        if (re * re + im * im > best) {
            best = re * re + im * im;
            found = f;
        }
    }
    return found;
}

enum class Way { x, y };

/// Free vibration after a small pull for one chunk: the top block's displacement, step by step.
std::vector<double> vibration(Realization r, Way along, double pull_m_s2, int chunks)
{
    const Study study = still(10);
    r.with_mechanisms = true; // to be pulled
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    const int top = static_cast<int>(r.blocks.size()) - 1;
    nudge(set, 0, top, along == Way::x ? pull_m_s2 : 0, along == Way::y ? pull_m_s2 : 0, 0);
    set.advance();
    nudge(set, 0, top, 0, 0, 0);
    std::vector<double> history;
    for (int chunk = 0; chunk < chunks; ++chunk)
        for (int k = 0; k < chunk_steps; ++k) {
            set.advance(k, k + 1);
            const Snapshot s = set.snapshot(0);
            history.push_back(along == Way::x ? s.x_m.back() : s.y_m.back());
        }
    return history;
}

/// First frequency [Hz] of a block on a bed with these stiffnesses, rocking and shearing: two degrees of freedom.
double first_frequency(const Stone& s, double k_t, double k_theta)
{
    const double h = s.height / 2, m = s.mass, I = m * (s.width * s.width + s.height * s.height) / 12;
    // bottom of the block moves by x + h theta (x to the right, theta counter-clockwise)
    const double a = k_t / m, b = k_t * h / std::sqrt(m * I), d = (k_t * h * h + k_theta - m * gravity * h) / I;
    const double w2 = 0.5 * (a + d) - std::sqrt(0.25 * (a - d) * (a - d) + b * b);
    return std::sqrt(w2) / (2 * std::numbers::pi);
}

/// Whether a block on this slope (tan) topples, from its static rest.
bool topples(Realization r, double slope)
{
    r.base_tilt_rad = std::atan(slope);
    return run_one(still(4), r).state == State::collapsed;
}

/// The slope at which it begins to topple, to 1e-3 of itself.
double toppling_slope(const Realization& r, double sign, double low, double high)
{
    EXPECT_FALSE(topples(r, sign * low));
    EXPECT_TRUE(topples(r, sign * high));
    while (high - low > 1e-3 * high) {
        const double middle = 0.5 * (low + high);
        (topples(r, sign * middle) ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

/// b/h - 3 t*, t* = (sqrt(2 W / K) / (6 h))^(2/3): the compliant monolith with half its face left on that side.
double static_capacity(double half_face, double K_n)
{
    const double h = mono_stone.height / 2, W = mono_stone.mass * gravity;
    return half_face / h - 3 * std::pow(std::sqrt(2 * W / K_n) / (6 * h), 2.0 / 3);
}

} // namespace

TEST(Hertz, RestsAndVibratesAsItsExponentSays)
{
    const double q = 1.5, reference = 2e-8;
    Realization r = mono(1e8);
    r.joints[0].mechanisms.force_exponent = q;
    r.joints[0].mechanisms.reference_overlap_m2 = reference;
    const double W = mono_stone.mass * gravity, B = mono_stone.width;
    const double area = reference * std::pow(W / (1e8 * reference), 1 / q);
    EXPECT_NEAR(static_state(r).y_m[1], -area / B, 1e-12 * B);
    const double k = q * W / area * B; // tangent
    const std::vector<double> y = vibration(r, Way::y, 0.01, 20);
    EXPECT_NEAR(frequency(r, y), std::sqrt(k / mono_stone.mass) / (2 * std::numbers::pi),
                1e-3 * frequency(r, y)); // the scheme at w dt .14: 8e-4
    EXPECT_NEAR(*std::max_element(y.begin(), y.end()) + *std::min_element(y.begin(), y.end()),
                2 * (mono_stone.height / 2 - area / B), 1e-8);
}

TEST(RateDamping, AnImpactLosesWhatTheEquationSays)
{
    // flown up and down again; m d'' = m g - K B d (1 + lambda d') by Runge and Kutta from the velocity of landing
    const double lambda = 2.0, K_n = 1e7;
    const Stone cube{0.1, 0.1, 2};
    Realization r = single(cube, {K_n, 0, 0.5}, 2e-6);
    r.joints[0].mechanisms.rate_s_m = lambda;
    const Study study = still(10);
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    nudge(set, 0, 1, 0, 30, 0);
    for (int chunk = 0; chunk < 80; ++chunk)
        set.advance();
    nudge(set, 0, 1, 0, 0, 0);
    double before = set.snapshot(0).y_m[1] - 0.05, landing = 0, leaving = 0;
    ASSERT_GT(before, 0);
    bool down = false;
    for (int chunk = 0; chunk < 2000 && leaving == 0; ++chunk)
        for (int k = 0; k < chunk_steps; ++k) {
            set.advance(k, k + 1);
            const double y = set.snapshot(0).y_m[1] - 0.05;
            if (!down && y < 0) {
                landing = (before - y) / r.step_s;
                down = true;
            }
            if (down && before < 0 && y > 0 && leaving == 0)
                leaving = (y - before) / r.step_s;
            before = y;
        }
    ASSERT_GT(landing, 0.1);
    double d = 0, v = landing;
    const double h = 1e-7, k = K_n * cube.width;
    const auto rate = [&](double depth, double speed) {
        return gravity - std::max(0.0, k * depth * (1 + lambda * speed)) / cube.mass;
    };
    while (d >= 0) {
        const double v2 = v + 0.5 * h * rate(d, v), d2 = d + 0.5 * h * v;
        d += h * v2;
        v += h * rate(d2, v2);
    }
    EXPECT_NEAR(leaving / landing, -v / landing, 2e-3);
    EXPECT_LT(-v / landing, 0.9); // it does lose something
}

/// The monolith on its bed with dashpots at the ends of the contact, as an ordinary differential equation: the part s
/// of the face that lies in the base is pressed by K s (2 d_i + d_j) / 6 + C s / (2 B) v_i at each of its ends, with
/// the depths d and the closing speeds v there, and never pulled. Runge and Kutta's method, steps of 2e-6 s.
class RockerOnItsBed {
public:
    RockerOnItsBed(double K, double z, double lean) : K_(K), C_(2 * z * std::sqrt(K * B * m))
    {
        // on its corner, pressed in by its weight: K d2 / sin 2 lean
        const double depth = std::sqrt(m * 9.81 * std::sin(2 * lean) / K);
        state_ = {0, 0.5 * (B * std::sin(lean) + H * std::cos(lean)) - depth, lean, 0, 0, 0, 0};
    }

    double angle() const { return state_[2]; }

    void step(double dt)
    {
        const State a = rate(state_), b = rate(sum(state_, a, dt / 2)), c = rate(sum(state_, b, dt / 2)),
                    d = rate(sum(state_, c, dt));
        for (std::size_t i = 0; i < a.size(); ++i)
            state_[i] += dt / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    }

private:
    static constexpr double B = 0.048, H = 0.174, m = 0.813, I = m * (B * B + H * H) / 12;
    using State = std::array<double, 7>; ///< x, y, angle, their rates, elongation of the tangential spring

    static State sum(State s, const State& d, double dt)
    {
        for (std::size_t i = 0; i < s.size(); ++i)
            s[i] += dt * d[i];
        return s;
    }

    State rate(const State& s) const
    {
        State d{s[3], s[4], s[5], 0, -9.81, 0, 0};
        const double sine = std::sin(s[2]), cosine = std::cos(s[2]);
        double x[2], depth[2]; // of the lower corners against the centre, and under the base's surface
        for (int i : {0, 1}) {
            const double along = (i == 0 ? -0.5 : 0.5) * B;
            x[i] = along * cosine + 0.5 * H * sine;
            depth[i] = -(s[1] + along * sine - 0.5 * H * cosine);
        }
        if (depth[0] <= 0 && depth[1] <= 0)
            return d;
        for (int i : {0, 1}) // the face leaves the base between its corners
            if (depth[i] < 0) {
                x[i] = x[1 - i] + (x[i] - x[1 - i]) * depth[1 - i] / (depth[1 - i] - depth[i]);
                depth[i] = 0;
            }
        const double part = x[1] - x[0];
        double force = 0, moment = 0;
        for (int i : {0, 1}) {
            const double closing = -(s[4] + s[5] * x[i]);
            const double F = std::max(0.0, K_ * part * (2 * depth[i] + depth[1 - i]) / 6 + C_ * part / B * closing / 2);
            force += F;
            moment += F * x[i];
        }
        const double sliding = s[3] + s[5] * s[1]; // of the face at the base's surface
        const double shear = K_ * B * s[6] + C_ * part / B * sliding;
        d[3] = -shear / m;
        d[4] += force / m;
        d[5] = (moment - shear * s[1]) / I;
        d[6] = sliding;
        return d;
    }

    double K_, C_;
    State state_{};
};

TEST(FaceDamping, RestitutionOfTheRockingMonolith)
{
    const double alpha = std::atan(0.048 / 0.174);
    for (const double z : {0.1, 0.2, 0.3, 0.5}) {
        RockerOnItsBed rocker(1e8, z, 0.5 * alpha);
        double lowest = 0;
        while (lowest > -1e-3 * alpha || rocker.angle() <= lowest) {
            lowest = std::min(lowest, rocker.angle());
            rocker.step(2e-6);
        }
        const auto energy = [&](double lean) { return std::cos(alpha - lean) - std::cos(alpha); };
        const double e = std::sqrt(energy(-lowest) / energy(0.5 * alpha));
        Realization r = verification::leaned_block(mono_stone, 1e8, 0.5, 0.05, z);
        r.joints[0].mechanisms.face_damping = 1;
        EXPECT_NEAR(verification::impact_restitution(r), e, 5e-4) << z;
    }
}

TEST(CornerLoss, TopplesWhenTheLoadIsBeyondWhatIsLeft)
{
    const double chip = 0.004, b = mono_stone.width / 2, K = 1e9;
    Realization r = mono(K, 0.3);
    r.joints[0].mechanisms.chip_right_m = chip;
    const double chipped = static_capacity(b - chip, K), whole = static_capacity(b, K);
    EXPECT_NEAR(toppling_slope(r, 1, 0.8 * chipped, 1.2 * chipped), chipped, 4e-3 * chipped);
    EXPECT_NEAR(toppling_slope(r, -1, 0.8 * whole, 1.2 * whole), whole, 4e-3 * whole);
}

TEST(CornerLoss, IsTakenFromTheBlockThatEndsTheFace)
{
    // a narrow lower block under a wide one: the lower face is the one that is chipped
    Realization r = stack({{0.048, 0.029, 0.1355}, {0.1, 0.029, 0.3}}, {1e9, 0.3, 5}, 2e-5, 0.2);
    r.joints[1].mechanisms.chip_left_m = 0.006;
    const BedLaw law = beds_at_rest(r)[1].law;
    EXPECT_EQ(law.faces.loss.lower_left, 0.006);
    EXPECT_EQ(law.faces.loss.upper_left, 0);
    EXPECT_NEAR(face_length_m(r, 1), 0.042, 1e-15);
}

TEST(CornerWear, TheFaceShrinksByThePathOfTheRotation)
{
    // a block that nothing can move (1 / m = 1 / I = 0) is turned to and fro at a depth: F = K d (2 b - 2 k P)
    const TopologyJoint joint{0, 1};
    Topology topology{2, 1, 1, 1, &joint, 0, {true, ContactForm::area}};
    std::vector<int> bed_lists(static_cast<std::size_t>(bed_lists_size(topology)));
    list_beds(topology, bed_lists.data());
    std::vector<double> memory(bundle_registers(topology), 0.0);
    const Bundle b = bind_bundle(topology, 1, memory.data());
    const double depth = 1e-5, K = 1e8, wear = 0.2, turn = 1e-6;
    for (int i : {0, 1}) {
        b.at(OfBlock::half_width, i, 0) = i == 0 ? 0.05 : 0.024;
        b.at(OfBlock::half_height, i, 0) = 0.02;
    }
    b.at(OfBlock::y, 1, 0) = -depth;
    b.at(OfJoint::height, 0, 0) = 0.04;
    b.at(OfJoint::depth_limit, 0, 0) = 0.002;
    b.at(OfJoint::K_n, 0, 0) = K;
    b.at(OfJointMechanisms::corner_wear, 0, 0) = wear;
    for (int chunk = 0; chunk < 100; ++chunk) {
        b.at(OfBlock::dtheta, 1, 0) = chunk % 2 == 0 ? turn : -turn;
        kernels(Isa::scalar).planar.run(topology, b, 0, chunk_steps);
    }
    const double path = 100 * chunk_steps * turn;
    const double face = 0.048 - 2 * wear * (path - turn); // of the step before the last
    EXPECT_NEAR(b.at(OfBlock::force_y, 1, 0), K * depth * face, 1e-4 * K * depth * face);
    EXPECT_LT(face, 0.046);
    // it stops before the face is gone
    b.at(OfJointMechanisms::turned, 0, 0) = 1e6;
    kernels(Isa::scalar).planar.run(topology, b, 0, 1);
    EXPECT_NEAR(b.at(OfBlock::force_y, 1, 0), K * depth * 0.1 * 0.048, 1e-3 * K * depth * 0.0048);
}

/// An area of 2e-5 m2 over 0.1 m is 2e-4 m deep; a slope of 0.002 makes 3e-4 and 1e-4 of it at the ends. Each end that
/// is lost held K d^2 / 2 on its length of 0.01 m: 1e8 / 2 x 0.01 x (9e-8 + 1e-8) = 0.05 J.
TEST(CornerWear, EnergyOfTheLostEndsByHand)
{
    EXPECT_NEAR(worn_energy(1e8, 2e-5, 0.1, 0.002, 0.01), 0.05, 1e-12);
    EXPECT_NEAR(worn_energy(1e8, 2e-5, 0.1, -0.002, 0.01), 0.05, 1e-12);
    EXPECT_NEAR(worn_energy(1e8, 2e-5, 0.1, 0.006, 0.01), 0.125, 1e-12) << "one end is open: 5e-4 and nothing";
    EXPECT_NEAR(worn_corner(0.002, 0.01, 0.3, 0.024), 0.005, 1e-15);
    EXPECT_NEAR(worn_corner(0.002, 0.01, 30.0, 0.024), 0.45 * 0.048, 1e-15);
}

TEST(Wedge, TheStackRestsAtTheSumOfItsWedges)
{
    Realization r = spec({1e9, 0.1}, 2e-5);
    r.joints[1].mechanisms.wedge_rad = 0.01;
    r.joints[4].mechanisms.wedge_rad = -0.004;
    const StaticState rest = static_state(r);
    // the load of a bed leaves its middle by height x tilt: 12 N e / (K B3), 4 drums over the wedge
    const double N = 5 * 0.1355 * gravity, lean = 12 * N * 0.0725 * 0.01 / (1e9 * std::pow(0.048, 3));
    EXPECT_NEAR(rest.theta_rad[1], 0, 1e-4);
    EXPECT_NEAR(rest.theta_rad[2], 0.01 + lean, 2 * lean);
    EXPECT_NEAR(rest.theta_rad[6] - rest.theta_rad[4], -0.004, 1e-5);
    EXPECT_GT(std::fabs(rest.theta_rad[2] - 0.01), 1e-7);
}

TEST(Eccentricity, TopplesEarlierToItsSide)
{
    const double e = 0.003, b = mono_stone.width / 2, K = 1e9;
    Realization r = mono(K, 0.3);
    r.blocks[1].mechanisms.eccentricity_m = e;
    const double near = static_capacity(b - e, K), far = static_capacity(b + e, K);
    EXPECT_NEAR(toppling_slope(r, 1, 0.8 * near, 1.2 * near), near, 4e-3 * near);
    EXPECT_NEAR(toppling_slope(r, -1, 0.8 * far, 1.2 * far), far, 4e-3 * far);
}

TEST(TwoCorner, RocksOnThriceTheStiffness)
{
    for (const double K : {1e7, 1e8}) {
        const double step = 0.1 / std::sqrt(K * mono_stone.width / mono_stone.mass);
        Realization r = single(mono_stone, {K, 0, 5}, step, 0.2); // flush sides take .3 % from the area form's
        r.with_mechanisms = true;
        const double B = mono_stone.width, k_theta = K * B * B * B / 12;
        const double by_area = first_frequency(mono_stone, K * B, k_theta);
        EXPECT_NEAR(frequency_near(r, vibration(r, Way::x, 1e-4, 200), by_area), by_area, 2e-3 * by_area);
        r.form = ContactForm::two_corner;
        const double want = first_frequency(mono_stone, K * B, 3 * k_theta);
        EXPECT_NEAR(frequency_near(r, vibration(r, Way::x, 1e-4, 200), want), want, 2e-3 * want);
        EXPECT_NEAR(linear_response(r).frequency_hz.front(), want, 2e-3 * want);
        // and its vertical stiffness is that of the area form
        const double axial = std::sqrt(K * B / mono_stone.mass) / (2 * std::numbers::pi);
        EXPECT_NEAR(frequency(r, vibration(r, Way::y, 0.01, 20)), axial, 1e-3 * axial);
    }
}

TEST(Points, RestsAsTheAreaFormAndIsHalfAsStiffAgain)
{
    Realization r = mono(1e8);
    const double y = static_state(r).y_m[1];
    r.form = ContactForm::points;
    EXPECT_NEAR(static_state(r).y_m[1], y, 1e-12);
    const double axial = std::sqrt(1.5 * 1e8 * mono_stone.width / mono_stone.mass) / (2 * std::numbers::pi);
    EXPECT_NEAR(frequency(r, vibration(r, Way::y, 0.01, 20)), axial, 1.5e-3 * axial);
    const double k_theta = 1.5 * 1e8 * std::pow(mono_stone.width, 3) / 12;
    const double want = first_frequency(mono_stone, 1e8 * mono_stone.width, k_theta);
    EXPECT_NEAR(frequency_near(r, vibration(r, Way::x, 1e-4, 200), want), want, 2e-3 * want);
}
