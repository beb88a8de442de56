/// A block that slides on its base.

#include "studies/evidence/picture/picture.hpp"
#include "studies/evidence/verification/case.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/rigid_block.hpp"

#include <fmt/format.h>

namespace stylobate::verification {

namespace {

constexpr const char* sliding_subject = "Sliding";

// A wide low stone on a wide base. Its bed has w2 m / K_T = 1 / stiffness, and the step is 0.3 / sqrt(stiffness) / w.
// What is elastic in the slip is 1 / stiffness of mu g / w2; but where the sliding turns without sticking, the spring
// takes a time of about 2 / sqrt(stiffness) / w to follow, and the slip is off by as much.
constexpr double mu = 0.1;
const double w = 2 * model::pi, unit = mu * model::gravity / (w * w);

/// One for each eta = a / (mu g), in units of mu g / w2.
std::vector<Slip> slide(const Study& study, const std::vector<double>& etas, double stiffness)
{
    const model::Stone stone{1, 0.1, 100};
    const model::Bed bed{stiffness * stone.mass * w * w, 0.1, mu};
    std::vector<Realization> runs;
    for (double eta : etas) {
        const double base = std::max(4.0, 4 * eta * unit + 2); // it must not slide off
        runs.push_back(model::single(stone, bed, 0.3 / model::bed_rate(bed, stone), base));
        runs.back().frequency_hz = w / (2 * model::pi);
        runs.back().pga_m_s2 = eta * mu * model::gravity;
    }
    std::vector<double> last(etas.size());
    const auto outcomes =
        model::run_all(study, runs, nullptr, [&](std::size_t i, const Snapshot& s) { last[i] = s.x_m[1]; });
    std::vector<Slip> slips;
    for (std::size_t i = 0; i < etas.size(); ++i)
        slips.push_back({outcomes[i].total_sliding_m / unit, -last[i] / unit});
    return slips;
}

/// The limit of a stiff bed from two that are a factor of 25 apart, the error being as 1 / sqrt(stiffness).
std::vector<Slip> stiff_slide(const Study& study, const std::vector<double>& etas)
{
    const auto soft = slide(study, etas, 1e6);
    auto stiff = slide(study, etas, 2.5e7);
    for (std::size_t i = 0; i < etas.size(); ++i)
        stiff[i] = {(5 * stiff[i].total - soft[i].total) / 4, (5 * stiff[i].net - soft[i].net) / 4};
    return stiff;
}

/// Slip path over the base's path, of four cycles in the middle of a motion: the difference of two motions.
std::vector<double> steady_ratio(const std::vector<double>& etas, double stiffness)
{
    const auto more =
        stiffness > 0 ? slide(model::harmonic(16, 2), etas, stiffness) : stiff_slide(model::harmonic(16, 2), etas);
    const auto less =
        stiffness > 0 ? slide(model::harmonic(12, 2), etas, stiffness) : stiff_slide(model::harmonic(12, 2), etas);
    std::vector<double> ratio;
    for (std::size_t i = 0; i < etas.size(); ++i)
        ratio.push_back((more[i].total - less[i].total) / (16 * etas[i]));
    return ratio;
}

Finding pulses()
{
    struct Digits {
        double eta, half, full, net;
    };
    const Digits digits[]{{1.5, 0.80925349, 1.61671040, -0.00179657},
                          {2, 2.72811386, 5.18978059, -0.12673449},
                          {3, 9.58001414, 12.59964043, 1.61785827}};
    const std::vector<double> etas{1.5, 2, 3};
    // half a sine: one way only, no turn, so no such error; what is left is 1 / stiffness, some of it times ten
    const auto half = slide(model::pulse(ExcitationKind::half_sine), etas, 1e6);
    const auto full = stiff_slide(model::pulse(ExcitationKind::full_sine), etas);
    Finding f;
    for (std::size_t i = 0; i < etas.size(); ++i) {
        const double eta = etas[i];
        const Slip h = pulse_slip(eta, 0.5), s = pulse_slip(eta, 1);
        f.equals(fmt::format("half sine, eta = {}: slip", eta), h.total, half[i].total, 1e-5 * h.total);
        f.equals(fmt::format("full sine, eta = {}: total slip", eta), s.total, full[i].total, 1e-4);
        f.equals(fmt::format("full sine, eta = {}: base less block", eta), s.net, full[i].net, 1e-4);
        f.equals(fmt::format("the oracle against the reference value, eta = {}, half sine", eta), digits[i].half,
                 h.total, 1e-8);
        f.equals(fmt::format("the same, full sine, total, eta = {}", eta), digits[i].full, s.total, 1e-8);
        f.equals(fmt::format("the same, full sine, net, eta = {}", eta), digits[i].net, s.net, 1e-8);
    }
    std::vector<double> stiffness{1e4, 1e5, 1e6, 1e7}, totals;
    for (double s : stiffness)
        totals.push_back(slide(model::pulse(ExcitationKind::full_sine), {2.0}, s)[0].total);
    f.convergences.push_back(
        convergence("K_T / (w2 m)", "total slip of a full sine, eta = 2", stiffness, totals, pulse_slip(2, 1).total));
    return f;
}

Finding steady()
{
    Finding f;
    for (const auto& [eta, digits] :
         {std::pair{1.2, 0.064724028}, {1.5, 0.269152304}, {2.0, 0.618990892}, {10.0, 0.987585940}})
        f.equals(fmt::format("the oracle against the reference value, eta = {}", eta), digits, steady_slip_ratio(eta),
                 1e-9);
    const std::vector<double> etas{1.1, 1.2, 1.35, 1.5, 1.7, 1.85, 2, 2.5, 3, 4, 5, 6.7072, 8, 10};
    const auto measured = steady_ratio(etas, 0);
    for (std::size_t i = 0; i < etas.size(); ++i) {
        const double exact = steady_slip_ratio(etas[i]);
        f.equals(fmt::format("eta = {}: slip path over base path", etas[i]), exact, measured[i],
                 (etas[i] == 1.85 ? 5e-4 : 2e-4) * exact);
    }
    // 0.25 m at 20 Hz with mu = 0.6: the block stays where it is while the base moves
    f.equals("eta = 670.7 (0.25 m at 20 Hz, mu = 0.6)", std::sqrt(1 - std::pow(model::pi / (2 * 670.7), 2)),
             steady_ratio({670.7}, 1e6)[0], 1e-4);
    std::vector<double> x, y;
    for (double eta = 1.01; eta < 10.3; eta += eta < 2 ? 0.02 : 0.2) {
        x.push_back(eta);
        y.push_back(steady_slip_ratio(eta));
    }
    f.pictures.push_back({"steady_sliding",
                          "Steady sliding under a harmonic base motion",
                          {curves({"eta = a / (mu g)", false, 1, 10.5}, {"slip path / base path", false, 0, 1.05},
                                  {{"rigid block", x, y, true, {}, {}}, {"engine", etas, measured, false, {}, {}}})}});
    return f;
}

} // namespace

Cases sliding_cases()
{
    return {
        {"SlidingPulses", sliding_subject,
         "Slip of a block under a half sine and a full sine of the base, in mu g / w2.",
         "the rigid block, piecewise in closed form; reference values (`reference_values.py`).",
         "half sine: the elastic part, 1e-6, up to ten times in some comparisons. Full sine: where the sliding "
         "reverses, the tangential spring needs a time proportional to 1 / sqrt(K_T); two stiffnesses give the limit "
         "to about 1e-5.",
         pulses},
        {"SteadySliding", sliding_subject,
         "Slip path over the base's path in the steady state, for eta from 1.1 to 670.",
         "for eta >= sqrt(1 + pi2 / 4) the block never sticks: sqrt(1 - (pi / (2 eta))2); below, the rigid block "
         "piecewise; reference values (`reference_values.py`).",
         "as above, relative: 2e-4; 5e-4 at 1.85, where the sticking phases nearly vanish.", steady},
    };
}

} // namespace stylobate::verification
