/// Two columns that carry a cap: the rigid rocking frame, and the static limit.

#include "ensemble/statics/limit_analysis.hpp"
#include "ensemble/statics/static_state.hpp"
#include "studies/evidence/picture/picture.hpp"
#include "studies/evidence/verification/case.hpp"
#include "studies/evidence/verification/colonnade.hpp"
#include "studies/evidence/verification/held_load.hpp"
#include "studies/evidence/verification/rigid_block.hpp"

#include <fmt/format.h>

namespace stylobate::verification {

namespace {

constexpr const char* subject = "Frames";

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

/// Time at which the columns are upright for the first time [s]; the mean of both.
double upright_time(const Realization& r)
{
    model::BareColumn frame(r);
    frame.put(static_state(r));
    const auto lean = [&] { return 0.5 * (frame.at(OfBlock::theta, 0) + frame.at(OfBlock::theta, 1)); };
    double before = lean();
    for (int n = 0; n * r.step_s < 5; ++n) {
        frame.step();
        const double now = lean();
        if (now <= 0)
            return r.step_s * (n + before / (before - now));
        before = now;
    }
    throw std::runtime_error("the frame did not come through the upright position in time");
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
            values.push_back(upright_time(frame_a(K, part)));
        f.equals(fmt::format("quarter period from {} alpha, K_N to infinity [s]", part), exact, aitken(values),
                 1e-3 * exact);
        if (part == 0.3) {
            const double other[]{0.55379, 0.55047, 0.54943};
            for (std::size_t i = 0; i < 3; ++i)
                f.equals(fmt::format("another program's quarter period at K_N = {:g} N/m2 [s]", stiffness[i + 1]),
                         other[i], values[i + 1], 0.003 * other[i]);
        }
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

Finding static_limit()
{
    Finding f;
    for (const auto& [mu, digits] : {std::pair{0.2, 1.962}, {0.6, 5.705331}, {0.68, 5.705331}, {10.0, 5.733378}})
        for (int drums : {1, 2})
            f.equals(fmt::format("linear programme against its reference value: mu = {}, {} drum{} a column [m/s2]", mu,
                                 drums, drums > 1 ? "s" : ""),
                     digits, limit_acceleration(paper_frame(drums, 1e8, mu)).acceleration_m_s2, 1e-6);
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
    f.equals("COLO, mu = 0.2, K_N = 1e10 N/m2 [m/s2]", 1.962,
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
        {"RockingFrame", subject,
         "Two columns of 1 x 4 m, 8 m apart, with a cap as heavy as both, tilted by 0.3 and 0.5 alpha and released: "
         "time "
         "to the upright position.",
         "the rigid frame, which obeys the equation of one block with p2 (1 + 2 G) / (1 + 3 G); and numbers of another "
         "program.",
         "Aitken's limit of the three stiffest; the start (cap on the corners) moves it by up to 0.3 %.",
         rocking_frame},
        {"FrameLimit", subject,
         "COLO under an acceleration that is reached slowly and held, with a drag that is zero at rest: the largest "
         "acceleration at which it stays upright.",
         "static limit analysis of rigid blocks in dry contact, a linear programme solved here by the simplex method; "
         "and published values with seven digits. The cap lifts off the trailing column, so the limit is below g B / H "
         "= 5.886.",
         "the compliant contacts approach the limit as K_N^(-1/3): the extrapolation is accurate to 1 %.", static_limit,
         Duration::slow},
    };
}

} // namespace stylobate::verification
