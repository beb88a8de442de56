/// How blocks begin to move from rest.

#include "ensemble/planar/structure/static_state.hpp"
#include "studies/evidence/picture/picture.hpp"
#include "studies/evidence/verification/case.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/rigid_block.hpp"

#include <fmt/format.h>

namespace stylobate::verification {

namespace {

constexpr const char* initiation_subject = "Initiation";

/// What a short push shows: second differences over two equal times after a rise that is slow against the contact and
/// short against 1 / p, so that the vibrations and their start cancel.
struct Onset {
    std::vector<double> turning; ///< (blocks) angular accelerations, clockwise [rad/s2]
    double sliding = 0;          ///< share of the measured time in which the lowest face slipped
};

/// @param acceleration of the base towards -x: what is on it tends to +x
/// @param rise time of the smooth rise;  @param span of each of the two times [s]
Onset onset(const Realization& r, double acceleration, double rise, double span)
{
    model::BareColumn column(r);
    column.put(static_state(r));
    const double dt = r.step_s;
    const auto run = [&](double from, double to) {
        for (double t = from; t < to; t += dt) {
            const double x = std::min(t / rise, 1.0);
            column.step(-acceleration * x * x * (3 - 2 * x) * dt * dt);
        }
    };
    const auto angles = [&] {
        std::vector<double> all;
        for (int i = 1; i < column.blocks(); ++i)
            all.push_back(-column.at(OfBlock::theta, i));
        return all;
    };
    Onset found;
    run(0, rise);
    const auto a = angles();
    run(rise, rise + span);
    const auto b = angles();
    const double slip = column.at(OfRealization::slip);
    run(rise + span, rise + 2 * span);
    const auto c = angles();
    found.sliding = (column.at(OfRealization::slip) - slip) / (acceleration * span * span);
    for (std::size_t i = 0; i < a.size(); ++i)
        found.turning.push_back((c[i] - 2 * b[i] + a[i]) / (span * span));
    return found;
}

/// Regime of one block of a slenderness B = b / h.
Regime measured_regime(double slenderness, double a, double mu)
{
    const model::Stone stone{0.1 * slenderness, 0.1, 1};
    const model::Bed bed{1e12, 0.3, mu};
    const double rate = model::bed_rate(bed, stone), dt = 0.3 / rate;
    const Realization r = model::single(stone, bed, dt, 4 * stone.width);
    // p is some 11 / s: in 4 ms nothing has turned far; a period of the contact takes 0.03 ms
    const Onset o = onset(r, a * model::gravity, 1e-3, 1.5e-3);
    const double p2 = 0.75 * model::gravity / (0.5 * std::hypot(stone.width, stone.height));
    const bool turns = o.turning[0] > 2e-3 * p2, slides = o.sliding > 1e-3;
    return turns ? (slides ? Regime::slide_rock : Regime::rock) : (slides ? Regime::slide : Regime::rest);
}

Finding regimes()
{
    Finding f;
    f.equals("friction at the edge of pure rocking: SPEC as one block, a = 2.621432 g", 0.68,
             rock_friction(2.621432, 48.0 / 174), 1e-6);
    f.equals("the same, 60 x 100 mm, a = 0.957895 g", 0.68, rock_friction(0.957895, 0.6), 1e-6);
    for (const auto& [B, name] : {std::pair{0.6, "60x100"}, {48.0 / 174, "48x174"}}) {
        std::vector<double> as, mus;
        for (int i = 0; i < 40; ++i)
            as.push_back((i + 0.5) * 0.04);
        for (int j = 0; j < 30; ++j)
            mus.push_back((j + 0.5) * 0.04);
        std::vector<int> kind;
        std::size_t agree = 0, far = 0;
        for (double mu : mus)
            for (double a : as) {
                const Regime want = shenton(a, mu, B), got = measured_regime(B, a, mu);
                kind.push_back(static_cast<int>(got));
                if (got == want) {
                    ++agree;
                    continue;
                }
                bool neighbour = false; // within one cell of where the formula says so
                for (double da : {-0.04, 0.0, 0.04})
                    for (double dm : {-0.04, 0.0, 0.04})
                        neighbour = neighbour || shenton(std::max(a + da, 0.0), std::max(mu + dm, 0.0), B) == got;
                far += !neighbour;
            }
        const double cells = static_cast<double>(kind.size());
        f.at_least(fmt::format("{} mm: share of {:g} cells that agree", name, cells), 0.97,
                   static_cast<double>(agree) / cells);
        f.equals(fmt::format("{} mm: cells that differ and are not next to the formula's boundary", name), 0,
                 static_cast<double>(far), 0);
        Series rock{std::nullopt, {}, {}, true, {}, {}}, edge{std::nullopt, {B, B}, {B, 1.2}, true, {}, {}},
            low{std::nullopt, {B, 1.6}, {B, B}, true, {}, {}},
            slide{"Shenton's boundaries", {0, B}, {0, B}, true, {}, {}};
        for (double a = B; a <= 1.6; a += 0.01) {
            rock.x.push_back(a);
            rock.y.push_back(rock_friction(a, B));
        }
        f.pictures.push_back(
            {fmt::format("regimes_{}", name),
             fmt::format(
                 "Initial motion of a block of {} mm: the engine on a grid (colours), Shenton's formulas (lines)",
                 name),
             {map({"a / g", false, 0, 0}, {"friction", false, 0, 0}, as, mus, kind,
                  {"rest", "slide", "rock", "slide and rock"}, {slide, rock, edge, low})}});
    }
    return f;
}

/// Time in which the faster block turns by 2e-4 rad: far beyond the softness of the contact, far below what changes the
/// levers. 5 ms where nothing should turn.
double measuring_time(const Start& start)
{
    const double fastest = std::max(start.lower, start.upper);
    return fastest > 0 ? std::sqrt(4e-4 / fastest) : 5e-3;
}

Realization pair_of(const TwoBlocks& k, double K_n)
{
    const model::Stone lower{2 * k.b1, 2 * k.h1, k.m1}, upper{2 * k.b2, 2 * k.h2, k.m2};
    const model::Bed bed{K_n, 0.3, 20};
    return model::stack({lower, upper}, bed, 0.2 / model::bed_rate(bed, k.b1 < k.b2 ? lower : upper), 4 * k.b1);
}

Finding two_blocks()
{
    Finding f;
    const TwoBlocks uneven{0.5, 0.5, 1000, 0.25, 1, 1000}, equal{0.024, 0.0435, 0.4065, 0.024, 0.0435, 0.4065};
    const auto starts_at = [](const TwoBlocks& k, auto yes, double low, double high) {
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (yes(two_block_start(k, middle)) ? high : low) = middle;
        }
        return 0.5 * (low + high);
    };
    // the oracle against the closed forms of its bounds
    f.equals("upper block alone, from g b2 / h2 [m/s2]", 2.4525,
             starts_at(
                 uneven, [](Start s) { return s.upper > 0; }, 1, 4),
             1e-9);
    f.equals("the lower one too [m/s2]", 7.3575,
             starts_at(
                 uneven, [](Start s) { return s.lower > 0; }, 4, 10),
             1e-6);
    f.equals("both as one [m/s2]", 12.290056,
             starts_at(
                 uneven, [](Start s) { return s.upper <= s.lower; }, 8, 20),
             1e-6);
    f.equals("equal pair, together [m/s2]", 2.706207,
             starts_at(
                 equal, [](Start s) { return s.lower > 0; }, 1, 4),
             1e-6);
    f.equals("equal pair, opposite [m/s2]", 92.0357,
             starts_at(
                 equal, [](Start s) { return s.upper < s.lower; }, 50, 120),
             1e-4);

    std::vector<double> a_u, lower, upper, a_line, lower_line, upper_line;
    for (double a = 1.5; a < 18; a += 0.1) {
        a_line.push_back(a);
        const Start s = two_block_start(uneven, a);
        lower_line.push_back(s.lower);
        upper_line.push_back(s.upper);
    }
    double worst = 0;
    for (double a : {2.0, 2.3, 3.0, 4.0, 5.0, 6.5, 8.0, 9.0, 10.0, 11.5, 13.0, 15.0, 17.0}) {
        const Start want = two_block_start(uneven, a);
        const double span = measuring_time(want);
        const Onset o = onset(pair_of(uneven, 1e14), a, span / 3, span);
        a_u.push_back(a);
        lower.push_back(o.turning[0]);
        upper.push_back(o.turning[1]);
        worst = std::max({worst, std::fabs(o.turning[0] - want.lower), std::fabs(o.turning[1] - want.upper)});
    }
    f.equals("lower 1 x 1 m, upper 0.5 x 2 m of equal mass: largest error of an angular acceleration over 13 base "
             "accelerations [rad/s2]",
             0, worst, 0.1);
    for (double a : {2.5, 5.0, 10.0, 50.0, 85.0, 100.0, 130.0}) {
        const Start want = two_block_start(equal, a);
        const double span = measuring_time(want);
        const Onset o = onset(pair_of(equal, 1e14), a, span / 3, span);
        f.equals(fmt::format("equal 48 x 87 mm pair at {} m/s2: lower block [rad/s2]", a), want.lower, o.turning[0],
                 0.01 * std::max(want.lower, 10.0));
        f.equals(fmt::format("the same: upper block [rad/s2]", a), want.upper, o.turning[1],
                 0.01 * std::max(want.upper, 10.0));
    }
    f.pictures.push_back(
        {"two_blocks",
         "Angular accelerations at the start of two blocks, 1 x 1 m below 0.5 x 2 m",
         {curves({"base acceleration [m/s2]", false, 0, 0}, {"angular acceleration [rad/s2]", false, 0, 0},
                 {{"lower, rigid", a_line, lower_line, true, {}, {}},
                  {"lower, engine", a_u, lower, false, {}, {}},
                  {"upper, rigid", a_line, upper_line, true, {}, {}},
                  {"upper, engine", a_u, upper, false, {}, {}}})}});
    return f;
}

} // namespace

Cases initiation_cases()
{
    return {
        {"Regimes", initiation_subject,
         "Initial motion of a block under a suddenly applied acceleration (rest, slide, rock, slide and rock), "
         "on 40 x 30 cells of a / g and friction, K_N = 1e12 N/m2.",
         "Shenton's closed forms.",
         "close to a boundary the rotation or slip within 4 ms is too small to classify, so cells next to it may "
         "differ.",
         regimes},
        {"TwoBlocks", initiation_subject,
         "Initial angular accelerations of two blocks, one on the other, without slip: only the upper block, both, "
         "both as one, or the upper block in the opposite direction.",
         "Lagrange's equations of each pattern, of which the valid one has its contact forces within the faces; and "
         "reference values of its bounds.",
         "in the measured time the blocks rotate by about 1e-3 rad, and their contacts vibrate.", two_blocks},
    };
}

} // namespace stylobate::verification
