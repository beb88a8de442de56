/// Two columns that carry a cap: the rigid rocking frame, and the static limit.

#include "ensemble/planar/structure/limit_analysis.hpp"
#include "ensemble/planar/structure/static_state.hpp"
#include "studies/evidence/picture/picture.hpp"
#include "studies/evidence/verification/case.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/rigid_block.hpp"
#include "studies/evidence/verification/trials.hpp"

#include <fmt/format.h>

namespace stylobate::verification {

namespace {

constexpr const char* frame_subject = "Frames";

/// Two columns of 1 x 4 m and 2500 kg/m3, 8 m apart, with a cap of 9.4 x 0.5 m that weighs as much as both (G = 1).
Realization frame_a(double K_n, double part)
{
    model::Colonnade c;
    c.spacing = 8;
    c.drum = {1, 4, 10000};
    c.epistyle = {9.4, 0.5, 20000};
    const model::Bed bed{K_n, 0.1, 5, true};
    Realization r = model::colonnade(c, bed, 0.2 / model::bed_rate(bed, c.drum), false);
    r.initial_tilt_rad = part * model::slenderness(c.drum);
    return r;
}

Finding rocking_frame()
{
    Finding f;
    const RigidBlock frame = rigid_frame(1, 4, 1), colo = rigid_frame(0.06L, 0.1L, 0.76L);
    f.equals("COLO: p against its reference value [rad/s]", 11.232991, static_cast<double>(rigid_block(0.06L, 0.1L).p),
             1e-6);
    f.equals("COLO: p of the frame [rad/s]", 9.845976, static_cast<double>(colo.p), 1e-6);
    f.equals("COLO: e of the frame", 0.510940, static_cast<double>(housner_restitution(colo.alpha, 0.76L)), 1e-6);
    f.equals("A with G = 1: p of the frame [rad/s]", 1.636057, static_cast<double>(frame.p), 1e-6);
    f.equals("A with G = 1: e of the frame", 0.889706, static_cast<double>(housner_restitution(frame.alpha, 1)), 1e-6);
    f.equals("quarter period from 0.3 alpha against its reference value [s]", 0.548962,
             static_cast<double>(quarter_period(frame, 0.3L * frame.alpha)), 1e-6);
    f.equals("quarter period from 0.5 alpha against its reference value [s]", 0.806377,
             static_cast<double>(quarter_period(frame, 0.5L * frame.alpha)), 1e-6);
    const std::vector<double> stiffness{1e9, 1e10, 1e11, 1e12};
    for (const double part : {0.3, 0.5}) {
        const double exact = static_cast<double>(quarter_period(frame, static_cast<long double>(part) * frame.alpha));
        std::vector<double> values;
        for (double K : stiffness)
            values.push_back(upright_time(frame_a(K, part), {0, 1}));
        f.equals(fmt::format("quarter period from {} alpha, K_N to infinity [s]", part), exact, aitken(values),
                 1e-3 * exact);
        for (const std::size_t i : {0U, 1U})
            f.equals(fmt::format("quarter period from {} alpha at K_N = {:g} N/m2, by the second solver [s]", part,
                                 stiffness[i]),
                     reference_upright_time(frame_a(stiffness[i], part), {0, 1}), values[i], 1e-8);
        f.convergences.push_back(convergence("K_N [N/m2]",
                                             fmt::format("quarter period of the frame from {} alpha [s]", part),
                                             stiffness, values, exact));
    }
    return f;
}

Realization paper_frame(int drums, double K_n, double mu)
{
    const model::Colonnade c = model::paper_colonnade(drums);
    const model::Bed bed{K_n, 0.3, mu};
    return model::colonnade(c, bed, 0.25 / model::bed_rate(bed, c.drum), false);
}

/// The limit of COLO by hand [m/s2]. Its columns (m) stand at -0.045 and 0.045 m, their toes are at -0.015 and 0.075 m,
/// and the cap (M) is in the middle, with its centre 0.03 m above the seats; inertia acts to the right.
///
/// With friction for less than 7 the cap leaves the trailing column, and stands on the leading one alone:
///   a (0.05 m + 0.1 M + 0.03 M) = g (0.03 m + 0.075 M)         about the toe of the leading column
/// With more, the trailing column holds the cap by a shear t under n = t / mu, at the corner over its own toe:
///   0.05 m a + 0.1 t = 0.03 m g                                about the toe of the trailing column
///   a (0.1 m + 0.13 M) = g (0.06 m + 0.075 M) - 0.09 n          both columns and the cap, about their toes
double limit_by_hand(double mu)
{
    const double m = 0.75, M = 1.14;
    const double alone = (0.03 * m + 0.075 * M) / (0.05 * m + 0.13 * M);
    const double held = (0.06 * m + 0.075 * M - 0.027 * m / mu) / (0.1 * m + 0.13 * M - 0.045 * m / mu);
    return model::gravity * std::min(mu, std::max(alone, held));
}

Finding static_limit()
{
    Finding f;
    for (const double mu : {0.2, 0.6, 0.68, 10.0})
        for (int drums : {1, 2})
            f.equals(fmt::format("linear programme against the limit by hand: mu = {}, {} drum{} a column [m/s2]", mu,
                                 drums, drums > 1 ? "s" : ""),
                     limit_by_hand(mu), limit_acceleration(paper_frame(drums, 1e8, mu)).acceleration_m_s2, 1e-9);
    const LimitLoad limit = limit_acceleration(paper_frame(1, 1e8, 0.6));
    f.equals("linear programme, mu = 0.6: force on the seat of the trailing column [N]", 0, limit.pressure_n[3], 1e-9);

    const std::vector<double> stiffness{1e8, 1e9, 1e10};
    for (const auto& [mu, drums] : {std::pair{0.6, 1}, {0.6, 2}, {10.0, 1}}) {
        const double exact = limit_acceleration(paper_frame(drums, 1e8, mu)).acceleration_m_s2;
        std::vector<double> values;
        for (double K : stiffness)
            values.push_back(largest_held_acceleration(paper_frame(drums, K, mu), 4, 6, 1e-3));
        const std::string name = fmt::format("COLO, mu = {}, {} drum{} a column", mu, drums, drums > 1 ? "s" : "");
        f.equals(name + ", K_N to infinity [m/s2]", exact, aitken(values), 0.01 * exact);
        f.convergences.push_back(convergence("K_N [N/m2]", name + ": a_max [m/s2]", stiffness, values, exact));
    }
    f.equals("COLO, mu = 0.2, K_N = 1e10 N/m2 [m/s2]", limit_by_hand(0.2),
             largest_held_acceleration(paper_frame(1, 1e10, 0.2), 1.5, 2.5, 1e-3), 0.01);

    // just below the limit the cap must have left its seat on the trailing column
    const Realization r = paper_frame(1, 1e10, 0.6);
    const double held = 0.99 * f.convergences.front().value.back();
    const HeldState state = hold(r, held);
    double seats[2] = {state.pressure_n[2], state.pressure_n[3]};
    std::sort(seats, seats + 2);
    f.equals("K_N = 1e10 N/m2, at 0.99 of its limit: the less loaded seat, over the cap's weight", 0,
             seats[0] / (1.14 * model::gravity), 0.03);
    return f;
}

} // namespace

Cases frame_cases()
{
    return {
        {"RockingFrame", frame_subject,
         "Two columns of 1 x 4 m, 8 m apart, with a cap as heavy as both, tilted by 0.3 and 0.5 alpha and released: "
         "time "
         "to the upright position.",
         "the rigid frame, which obeys the equation of one block with p2 (1 + 2 G) / (1 + 3 G); at the two softest K_N "
         "the second solver (`reference_solver.hpp`); reference values (`reference_values.py`).",
         "Aitken's limit of the three stiffest, 0.1 %; against the second solver the rounding of its steps.",
         rocking_frame},
        {"FrameLimit", frame_subject,
         "COLO under an acceleration that is reached slowly and held, with a drag that is zero at rest: the largest "
         "acceleration at which it stays upright.",
         "static limit analysis of rigid blocks in dry contact, a linear programme solved here by the simplex method, "
         "which is itself compared with the equilibrium by hand (`limit_by_hand`). The cap lifts off the trailing "
         "column, so the limit is below g B / H = 5.886.",
         "the compliant contacts approach the limit as K_N^(-1/3): the extrapolation is accurate to 1 %.", static_limit,
         Duration::slow},
    };
}

} // namespace stylobate::verification
