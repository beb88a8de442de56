/// Overturning of one block by half a sine and by a full one, against the rigid block.

#include "io/tables/table.hpp"
#include "studies/evidence/picture/picture.hpp"
#include "studies/evidence/verification/case.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/rigid_block.hpp"
#include "studies/evidence/verification/trials.hpp"

#include <fmt/format.h>

namespace stylobate::verification {

namespace {

constexpr const char* overturning_subject = "Overturning";

const std::vector<double> rates{1, 2, 3, 4, 5, 6, 8, 10}; // w / p
constexpr double step_rate = 0.3;

RigidBlock rigid_monolith()
{
    return rigid_block(0.048L, 0.174L);
}

/// MONO under a pulse of w = rate x p and the amplitude eta g tan alpha.
Realization pulsed_monolith(double K_n, double rate, double eta, double xi, double step)
{
    const model::Bed bed{K_n, xi, 5, true};
    Realization r = model::single(model::mono_stone, bed, step / model::bed_rate(bed, model::mono_stone), 0.1);
    r.frequency_hz = rate * model::rocking_rate(model::mono_stone) / (2 * model::pi);
    r.pga_m_s2 = eta * model::gravity * model::mono_stone.width / model::mono_stone.height;
    return r;
}

/// How it fell, for each eta: 0 it stands, else 1 + the number of times it had crossed over before.
std::vector<int> ways(ExcitationKind kind, double K_n, double rate, const std::vector<double>& etas, double xi)
{
    std::vector<Realization> tries;
    for (double eta : etas)
        tries.push_back(pulsed_monolith(K_n, rate, eta, xi, step_rate));
    // the base first accelerates to +x: the block leans to -x, counter-clockwise
    const double clear = 0.01 * model::slenderness(model::mono_stone);
    // A full sine may bring a block back that was beyond its balance for long, and one that stays there for a while
    // may look as if at rest: where it is at the end tells.
    Study study = model::pulse(kind);
    study.outcome.follow = Follow::rest;
    std::vector<int> side(etas.size(), 1), crossings(etas.size(), 0);
    std::vector<double> last(etas.size(), 0);
    model::run_all(study, tries, nullptr, [&](std::size_t i, const Snapshot& s) {
        last[i] = s.theta_rad[1];
        if (side[i] * last[i] < -clear) {
            side[i] = -side[i];
            ++crossings[i];
        }
    });
    std::vector<int> way;
    for (std::size_t i = 0; i < etas.size(); ++i)
        way.push_back(std::fabs(last[i]) < model::slenderness(model::mono_stone) ? 0 : 1 + crossings[i]);
    return way;
}

/// Least eta of a way of falling between two that bracket it.
double edge(ExcitationKind kind, int way, double K_n, double rate, double low, double high, double xi = 0.1)
{
    return model::threshold(
        [&](const std::vector<double>& etas) {
            std::vector<bool> yes;
            for (int w : ways(kind, K_n, rate, etas, xi))
                yes.push_back(w == way);
            return yes;
        },
        low, high, 1e-4);
}

/// An edge of a half sine by the second solver, looked for near the engine's.
double reference_edge(double K_n, double rate, double engine, double xi = 0.1)
{
    double low = engine - 4e-4, high = engine + 4e-4;
    const auto so = [&](double eta) {
        return reference_way(model::pulse(ExcitationKind::half_sine), pulsed_monolith(K_n, rate, eta, xi, step_rate)) ==
               1;
    };
    if (so(low) || !so(high))
        throw std::runtime_error("by the second solver the edge is not near that of the engine");
    while (high - low > 2e-5) {
        const double middle = 0.5 * (low + high);
        (so(middle) ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

/// At how many amplitudes about an edge of a full sine both solvers find the same way of falling. (After an impact the
/// edge is no single amplitude: within 3e-4 of it ways of falling alternate, by the phase of the contact's vibration.)
std::size_t alike(double K_n, double rate, double edge, const std::vector<double>& from_it, double xi = 0.1)
{
    std::vector<double> etas;
    for (const double d : from_it)
        etas.push_back(edge + d);
    const std::vector<int> engine = ways(ExcitationKind::full_sine, K_n, rate, etas, xi);
    std::size_t same = 0;
    for (std::size_t i = 0; i < etas.size(); ++i)
        same += reference_way(model::pulse(ExcitationKind::full_sine),
                              pulsed_monolith(K_n, rate, etas[i], xi, step_rate)) == engine[i];
    return same;
}

Finding half_sine()
{
    Finding f;
    const std::vector<double> stiffness{1e8, 1e9, 1e10, 1e11};
    const double digits[]{1.321072, 1.801581, 2.297965, 2.798592, 3.300895, 3.804013, 4.811423, 5.819579};
    std::vector<double> rigid, limit, soft;
    for (std::size_t i = 0; i < rates.size(); ++i) {
        rigid.push_back(half_sine_edge(rigid_monolith(), rates[i]));
        f.equals(fmt::format("the oracle against the reference value, w = {} p", rates[i]), digits[i], rigid[i], 1e-6);
        std::vector<double> values;
        for (double K : stiffness)
            values.push_back(edge(ExcitationKind::half_sine, 1, K, rates[i], 1.05, rigid[i] + 0.2));
        limit.push_back(aitken(values));
        soft.push_back(values.front());
        f.equals(fmt::format("w = {} p, K_N to infinity: eta", rates[i]), rigid[i], limit[i], 1e-3 * rigid[i]);
        if (rates[i] == 4) {
            for (const std::size_t k : {0U, 1U, 2U})
                f.equals(fmt::format("eta at K_N = {:g} N/m2, w = 4 p, by the second solver", stiffness[k]),
                         reference_edge(stiffness[k], 4, values[k]), values[k], 1e-4);
            f.convergences.push_back(
                convergence("K_N [N/m2]", "eta of a half sine, w = 4 p", stiffness, values, rigid[i]));
        }
    }
    f.pictures.push_back({"half_sine",
                          "Smallest amplitude of a half sine that overturns MONO",
                          {curves({"w / p", false, 0, 11}, {"eta = a / (g tan alpha)", false, 0, 0},
                                  {{"rigid block", rates, rigid, true, {}, {}},
                                   {"engine, limit of K_N", rates, limit, false, {}, {}},
                                   {"engine, K_N = 1e8 N/m2", rates, soft, false, {}, {}}})}});
    return f;
}

/// Quarter period, static capacity and overturning of MONO over K_N, relative to the rigid block.
Finding stiffness_effect()
{
    const RigidBlock block = rigid_monolith();
    const double rigid_quarter = static_cast<double>(quarter_period(block, block.alpha / 2));
    const double rigid_capacity = model::gravity * model::mono_stone.width / model::mono_stone.height;
    const double rigid_half = half_sine_edge(block, 4), rigid_full = full_sine_edges(block, 4, 0).direct;
    const std::vector<double> at{1e7, 1e8, 1e9, 1e10};
    std::vector<double> quarter, capacity, half, full;
    std::string table =
        markdown_head("K_N [N/m2] | quarter period | static capacity | -3 t* h / b | overturning by a half "
                      "sine, w = 4 p | by a full sine without impact, w = 4 p");
    for (const double K : at) {
        quarter.push_back(upright_time(leaned_block(model::mono_stone, K, 0.5, 0.2)));
        const model::Bed bed{K, 0.3, 10};
        capacity.push_back(largest_held_acceleration(
            model::single(model::mono_stone, bed, 0.4 / model::bed_rate(bed, model::mono_stone), 0.06), 1.5, 2.75,
            5e-4));
        half.push_back(edge(ExcitationKind::half_sine, 1, K, 4, 1.5, rigid_half + 0.2));
        full.push_back(edge(ExcitationKind::full_sine, 1, K, 4, 3, rigid_full + 0.2));
        const double t = std::pow(
            std::sqrt(2 * model::mono_stone.mass * model::gravity / K) / (3 * model::mono_stone.height), 2.0 / 3);
        const auto change = [](double value, double rigid) { return 100 * (value / rigid - 1); };
        table += markdown_row("{:.0e} | {:+.2f} % | {:+.2f} % | {:+.2f} % | {:+.2f} % | {:+.2f} %", K,
                              change(quarter.back(), rigid_quarter), change(capacity.back(), rigid_capacity),
                              -300 * t * model::mono_stone.height / model::mono_stone.width,
                              change(half.back(), rigid_half), change(full.back(), rigid_full));
    }
    Finding f;
    const auto falls = [&](const char* what, const std::vector<double>& values, double rigid, double exponent) {
        f.convergences.push_back(convergence("K_N [N/m2]", what, at, values, rigid));
        f.equals(fmt::format("exponent of K_N: {}", what), exponent, f.convergences.back().order, 0.02);
    };
    falls("quarter period of MONO from 0.5 alpha [s]", quarter, rigid_quarter, -0.5);
    falls("static capacity of MONO [m/s2]", capacity, rigid_capacity, -1.0 / 3);
    falls("eta of a half sine, w = 4 p", half, rigid_half, -0.4);
    falls("eta of a full sine without impact, w = 4 p", full, rigid_full, -0.4);
    f.remarks.push_back(table);
    return f;
}

Finding stiffest()
{
    const double rigid = half_sine_edge(rigid_monolith(), 4);
    const double at_1e12 = edge(ExcitationKind::half_sine, 1, 1e12, 4, 2.7, 2.9);
    const double at_1e13 = edge(ExcitationKind::half_sine, 1, 1e13, 4, 2.7, 2.9);
    Finding f;
    f.equals("eta at K_N = 1e13 N/m2", rigid, at_1e13, 4e-3);
    f.at_least("eta at K_N = 1e13 N/m2, above that at 1e12", at_1e12, at_1e13);
    for (const double K : {1e8, 1e10}) {
        const auto at = [&](double step) {
            return model::least_overturning(
                model::pulse(ExcitationKind::half_sine),
                [&](double eta) { return pulsed_monolith(K, 4, eta, 0.1, step); }, 2.3, 3, 1e-4);
        };
        f.equals(fmt::format("eta at K_N = {:g} N/m2: a quarter of the step against the longest", K), at(0.15), at(0.6),
                 1e-3);
    }
    return f;
}

Finding full_sine_direct()
{
    Finding f;
    const std::vector<double> stiffness{1e8, 1e9, 1e10, 1e11};
    const double digits[]{1.417400, 2.358878, 3.669653, 5.336236, 7.362836, 9.757167, 15.684700, 23.193915};
    for (std::size_t i = 0; i < rates.size(); ++i) {
        // without an impact no restitution enters
        const FullSineEdges edges = full_sine_edges(rigid_monolith(), rates[i], 0);
        const double rigid = edges.direct;
        f.equals(fmt::format("the oracle against the reference value, w = {} p", rates[i]), digits[i], rigid,
                 1e-6 * digits[i]);
        if (edges.direct_pressure < 0) {
            // a contact cannot pull, so such a block flies, and the rigid one is no oracle
            f.remarks.push_back(fmt::format(
                "At w = {} p the rigid block would have to be held down by {:.3f} of its weight. Here the block lifts "
                "off instead, so the two are **not expected** to agree, and no comparison is made.",
                rates[i], -edges.direct_pressure));
            continue;
        }
        std::vector<double> values;
        for (double K : stiffness)
            values.push_back(edge(ExcitationKind::full_sine, 1, K, rates[i], 1 + 0.5 * (rigid - 1), 1.2 * rigid));
        f.equals(fmt::format("w = {} p, K_N to infinity: eta", rates[i]), rigid, aitken(values), 2e-3 * rigid);
        if (rates[i] == 4)
            f.convergences.push_back(
                convergence("K_N [N/m2]", "eta of a full sine without impact, w = 4 p", stiffness, values, rigid));
    }
    return f;
}

Finding full_sine_impact()
{
    Finding f;
    const RigidBlock rigid = rigid_monolith();
    const double housner = static_cast<double>(housner_restitution(rigid.alpha));
    struct Digits {
        double rate, low, high;
    };
    const Digits digits[]{{1, 1.131490, 1.415484}, {2, 1.225406, 2.323675}, {3, 1.408328, 3.526372},
                          {4, 1.821030, 4.964773}, {5, 3.028258, 6.582665}, {6, 4.916057, 8.286245}};
    std::vector<double> at, with_housner, with_ours, engine, direct;
    for (const Digits& d : digits) {
        const FullSineEdges edges = full_sine_edges(rigid, d.rate, housner);
        f.equals(fmt::format("the oracle with Housner's e against the reference value, w = {} p, lower edge", d.rate),
                 d.low, edges.low, 1e-6 * d.low);
        f.equals(fmt::format("the same, upper edge, w = {} p", d.rate), d.high, edges.high, 1e-6 * d.high);
        at.push_back(d.rate);
        with_housner.push_back(edges.low);
        direct.push_back(edges.direct);
    }
    // with the engine's own e, from free rocking at the same stiffness and dashpots
    const double K = 1e11, e = impact_restitution(leaned_block(model::mono_stone, K, 0.5, 0.1));
    for (const Digits& d : digits) {
        const FullSineEdges edges = full_sine_edges(rigid, d.rate, e);
        with_ours.push_back(edges.low);
        engine.push_back(edge(ExcitationKind::full_sine, 2, K, d.rate, 1.005, 1.05 * edges.low));
        f.equals(fmt::format("w = {} p, K_N = 1e11 N/m2: lower edge after an impact, against the rigid block with "
                             "e = {:.4f}",
                             d.rate, e),
                 edges.low, engine.back(), 0.015 * edges.low);
    }
    for (const double soft : {1e8, 1e10}) {
        const double found = edge(ExcitationKind::full_sine, 2, soft, 4, 1.2, 1.8);
        const std::vector<double> from_it{-1e-2, -1e-3, -2e-4,  -1.6e-4, -1.2e-4, -8e-5, -4e-5, 0,
                                          4e-5,  8e-5,  1.2e-4, 1.6e-4,  2e-4,    1e-3,  1e-2};
        const auto all = static_cast<double>(from_it.size());
        f.equals(fmt::format("of {:g} amplitudes about the lower edge, {:.4f} at K_N = {:g} N/m2, w = 4 p, those that "
                             "end alike by the second solver",
                             all, found, soft),
                 all, static_cast<double>(alike(soft, 4, found, from_it)), 0.5);
    }
    f.remarks.push_back(fmt::format(
        "With Housner's e = {:.4f} the rigid block needs a larger amplitude: this contact law dissipates less energy "
        "at an impact and is **not expected** to agree with Housner. The comparison is with the rigid block with e = "
        "{:.4f}, the restitution of the engine in free rocking from 0.5 alpha with the same contact.",
        housner, e));
    f.pictures.push_back({"full_sine",
                          "Overturning of MONO by a full sine",
                          {curves({"w / p", false, 0, 7}, {"eta = a / (g tan alpha)", false, 0, 10},
                                  {{"rigid, after an impact, Housner's e", at, with_housner, true, {}, {}},
                                   {fmt::format("rigid, after an impact, e = {:.3f}", e), at, with_ours, true, {}, {}},
                                   {"engine, after an impact, K_N = 1e11 N/m2", at, engine, false, {}, {}},
                                   {"rigid, without impact", at, direct, true, {}, {}}})}});
    return f;
}

} // namespace

Cases overturning_cases()
{
    return {
        {"HalfSine", overturning_subject,
         "Smallest amplitude of a half sine that overturns MONO, by bisection to 1e-4, for w from 1 to 10 p.",
         "the rigid block, integrated by Runge and Kutta in extended precision (no impact is possible before it "
         "falls); at three stiffnesses the second solver of the same equations (`reference_solver.hpp`); reference "
         "values (`reference_values.py`).",
         "against the second solver the bisection, 1e-4. Aitken's limit multiplies the bisection error of 1e-4 by "
         "three, and its factor is only nearly constant.",
         half_sine, Duration::slow},
        {"StiffnessEffect", overturning_subject,
         "How much a compliant bed changes a time, a static capacity and an overturning amplitude of MONO, relative to "
         "the rigid block, at K_N from 1e7 to 1e10 N/m2.",
         "the exponents of K_N, derived in `kernels/THEORY.md`, section 8: -1/2, -1/3 and -2/5; the column -3 t* h / b "
         "is "
         "the first order of the static capacity.",
         "0.02: terms of higher order at 1e7 N/m2.", stiffness_effect, Duration::slow},
        {"HalfSineStiff", overturning_subject,
         "The same for w = 4 p on very stiff contacts, and with half and double the step.",
         "the rigid block; the other step.",
         "the error falls by a factor of 2.4 per decade of K_N; the step contributes about 1e-5, the bisection 1e-4.",
         stiffest, Duration::slow},
        {"FullSineDirect", overturning_subject,
         "Smallest amplitude of a full sine that overturns MONO without an impact, for w from 1 to 10 p.",
         "the rigid block; without an impact the result does not depend on restitution; reference values "
         "(`reference_values.py`).",
         "Aitken's limit, as for a half sine.", full_sine_direct, Duration::slow},
        {"FullSineImpact", overturning_subject,
         "Smallest amplitude of a full sine that overturns MONO after one impact, for w from 1 to 6 p.",
         "the rigid block with the restitution of the engine in free rocking: **not Housner's**, see below. "
         "The "
         "oracle itself is checked with Housner's e against reference values (`reference_values.py`). At softer "
         "contacts "
         "the second solver (`reference_solver.hpp`) has to fall in the same way at each of 15 amplitudes.",
         "the contact is not rigid: a half sine needs about 0.5 % less at this stiffness, and the impact has a finite "
         "duration.",
         full_sine_impact, Duration::slow},
    };
}

} // namespace stylobate::verification
