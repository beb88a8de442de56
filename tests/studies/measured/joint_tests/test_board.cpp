/// `board` by a block that slides on a slope whose angle grows at a constant rate: closed form.

#include "tests/studies/measured/joint_tests/joint_sample.hpp"

namespace stylobate::joint_sample {
namespace {

struct SlidingBlock {
    double static_left = 0.6, static_right = 0.6; ///< friction at the first slip
    double kinetic = 1;                           ///< over the static one, after it
    double stop_m = 1;                            ///< where something stops it, for a second
    bool turns = false;                           ///< instead of sliding
};

/// Slip down the slope at a tilt, after the first slip at `first`; x'' = g (sin t - mu cos t), t' = rate.
double slipped_at(double tilt, double first, double rate, double mu)
{
    if (tilt <= first)
        return 0;
    const double since = (tilt - first) / rate;
    const double sine = std::sin(first) + rate * since * std::cos(first) - std::sin(tilt);
    const double cosine = std::cos(first) - rate * since * std::sin(first) - std::cos(tilt);
    return gravity / (rate * rate) * (sine - mu * cosine);
}

std::vector<MeasuredRun> tilted(const SlidingBlock& block, unsigned seed, RunKind kind = RunKind::board)
{
    std::vector<MeasuredRun> runs = plan(kind);
    for (MeasuredRun& run : runs) {
        const double side = run.base_tilt_rad.values.back() > 0 ? -1 : 1; // to which it slides
        const double mu = side < 0 ? block.static_left : block.static_right, first = std::atan(mu);
        Path path;
        double held_s = 0;
        for (std::size_t i = 0; i < run.time_s.size(); ++i) {
            const double tilt = std::fabs(run.base_tilt_rad.values[i]);
            const double slip = slipped_at(tilt, first, M_PI / 90, mu * block.kinetic);
            if (slip > block.stop_m)
                held_s += 1 / run.rate_hz;
            path.x.push_back(block.turns ? 0 : side * (held_s > 1 ? slip : std::min(slip, block.stop_m)));
            path.theta.push_back(block.turns ? -side * std::max(0.0, tilt - first) : 0);
        }
        see(run, path, seed++);
        disturb(run.base_tilt_rad, level_rad, seed++);
    }
    return runs;
}

std::vector<Estimate> board_estimates(const SlidingBlock& block, unsigned seed)
{
    return estimates(column(), tilted(block, seed));
}

TEST(Board, GivesTheFrictionAtAndAfterTheFirstSlip)
{
    for (const double mu : {0.3, 0.6, 0.75}) {
        SlidingBlock block;
        block.static_left = block.static_right = mu;
        const auto all = board_estimates(block, 1);
        expect_estimate(all, "board.static", std::log(mu), 0.002);
        expect_estimate(all, "board.kinetic", 0, 0.003);
        expect_estimate(all, "board.direction", 0, 0.004);
    }
}

TEST(Board, TellsFrictionThatFallsOnceItSlides)
{
    for (const double kinetic : {0.98, 0.9, 0.7}) {
        SlidingBlock block;
        block.kinetic = kinetic;
        const auto all = board_estimates(block, 20);
        expect_estimate(all, "board.static", std::log(0.6), 0.002);
        expect_estimate(all, "board.kinetic", std::log(kinetic), 0.004);
        expect_estimate(all, "board.direction", 0, 0.004);
    }
}

TEST(Board, TellsDirection)
{
    SlidingBlock block;
    block.static_left = 0.66;
    const auto all = board_estimates(block, 40);
    expect_estimate(all, "board.direction", std::log(1.1), 0.004);
    expect_estimate(all, "board.static", std::log(0.6) + std::log(1.1) / 2, 0.002);
    expect_estimate(all, "board.kinetic", 0, 0.003);
}

TEST(Board, SeesTheFirstSlipOfABlockThatIsStopped)
{
    SlidingBlock block; // by a dowel, a third of a millimetre on
    block.stop_m = 0.0003;
    const auto all = board_estimates(block, 60);
    expect_estimate(all, "board.static", std::log(0.6), 0.008);
    EXPECT_FALSE(find(all, "board.kinetic"));
}

TEST(Board, EstimatesNothingWhereNothingSlid)
{
    SlidingBlock steep;
    steep.static_left = steep.static_right = 2; // 63 degrees
    const auto held = board_estimates(steep, 70);
    expect_estimate(held, "board.static", std::log(std::tan(steepest_board_rad)), 0.002);
    EXPECT_FALSE(find(held, "board.kinetic"));
    SlidingBlock turning;
    turning.turns = true;
    EXPECT_TRUE(board_estimates(turning, 80).empty());
    std::vector<MeasuredRun> fallen = tilted({}, 90); // the block leaves the joint after 12 mm: what was before counts
    for (MeasuredRun& run : fallen) {
        run.collapsed = true;
        bool gone = false;
        for (std::size_t i = 0; i < run.time_s.size(); ++i) {
            gone = gone || std::fabs(run.blocks.x_m.values[3 * i + 1] - 0.25) > 0.012;
            for (SeenMotion* seen : {&run.blocks})
                for (Series* series : {&seen->x_m, &seen->y_m, &seen->theta_rad})
                    if (gone)
                        series->values[3 * i + 1] = none;
        }
    }
    expect_estimate(estimates(column(), fallen), "board.static", std::log(0.6), 0.002);
    std::vector<MeasuredRun> unseen = tilted({}, 95); // the cameras were off when it slid
    for (MeasuredRun& run : unseen)
        for (std::size_t i = 0; i < run.time_s.size(); ++i)
            if (run.time_s[i] > 10)
                run.blocks.x_m.values[3 * i + 1] = none;
    EXPECT_TRUE(estimates(column(), unseen).empty());
}

// ---- tilt -----------------------------------------------------------------------------------------------------------

struct TurningBody {
    double centre_m = 0; ///< of the body, to the right
    double left_m = 0, right_m = 0;
    double offset_m = 0;
};

/// The body turns by I q'' = M g (h sin(t + q) - a cos(t + q)) about the corner, by small steps.
std::vector<MeasuredRun> turned(const TurningBody& body, unsigned seed)
{
    constexpr double high = 3 * half_height;
    const double own = (half_width * half_width + 9 * half_height * half_height) / 3;
    std::vector<MeasuredRun> runs = plan(RunKind::tilt);
    for (MeasuredRun& run : runs) {
        const double side = run.base_tilt_rad.values.back() > 0 ? -1 : 1;
        const double edge = half_width - std::max(0.0, side * body.offset_m);
        const double arm = edge - side * body.centre_m - (side > 0 ? body.right_m : body.left_m);
        const double inertia = own + arm * arm + high * high;
        Path path;
        double q = 0, speed = 0;
        for (std::size_t i = 0; i < run.time_s.size(); ++i) {
            constexpr int steps = 20;
            for (int k = 0; i > 0 && k < steps && q < 0.3; ++k) {
                const double from = std::fabs(run.base_tilt_rad.values[i - 1]),
                             to = std::fabs(run.base_tilt_rad.values[i]);
                const double t = from + (to - from) * (k + 0.5) / steps, dt = 1 / run.rate_hz / steps;
                const double moment = gravity / inertia * (high * std::sin(t + q) - arm * std::cos(t + q));
                if (q > 0 || moment > 0) {
                    speed += dt * moment;
                    q += dt * speed;
                }
            }
            const double shown = q < 0.3 ? q : none; // then it has fallen
            path.theta.push_back(-side * shown);
            path.x.push_back(body.offset_m + side * (half_height * std::sin(shown) + arm * (1 - std::cos(shown))));
        }
        run.collapsed = true;
        see(run, path, seed++);
        disturb(run.base_tilt_rad, level_rad, seed++);
    }
    return runs;
}

void expect_tilt(const TurningBody& body, unsigned seed, double width, double centre)
{
    const auto all = estimates(column(), turned(body, seed));
    expect_estimate(all, "tilt.width", width, 1.5e-4, 2e-5);
    expect_estimate(all, "tilt.centre", centre, 1e-4, 1e-5);
}

TEST(Tilt, TellsCornersFromCentres)
{
    for (const unsigned seed : {1U, 11U, 21U})
        expect_tilt({}, seed, 0, 0);
    expect_tilt({.offset_m = -0.0008}, 31, 0, 0);
    expect_tilt({.centre_m = 0.001}, 41, 0, 0.001);
    expect_tilt({.left_m = 0.002}, 51, -0.002, -0.001);
    expect_tilt({.left_m = 0.001, .right_m = 0.001}, 61, -0.002, 0);
}

TEST(Tilt, EstimatesNothingWhereTheBodySlidesFirst)
{
    SlidingBlock slippery;
    slippery.static_left = slippery.static_right = 0.4;
    EXPECT_TRUE(estimates(column(), tilted(slippery, 80, RunKind::tilt)).empty());
    std::vector<MeasuredRun> one = turned({}, 90);
    one.pop_back();
    EXPECT_TRUE(estimates(column(), one).empty()) << "one side says nothing of width and centre";
}

TEST(BoardStatistics, ErrorsAreAsStated)
{
    expect_stated_errors([](unsigned seed) { return board_estimates({}, seed); });
    expect_stated_errors([](unsigned seed) { return board_estimates({.kinetic = 0.9}, seed); });
}

TEST(TiltStatistics, ErrorsAreAsStated)
{
    expect_stated_errors([](unsigned seed) { return estimates(column(), turned({}, seed)); });
}

} // namespace
} // namespace stylobate::joint_sample
