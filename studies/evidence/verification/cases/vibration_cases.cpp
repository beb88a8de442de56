/// Small vibrations of stacks at rest.

#include "ensemble/planar/structure/static_state.hpp"
#include "studies/evidence/picture/picture.hpp"
#include "studies/evidence/verification/case.hpp"
#include "studies/evidence/verification/model.hpp"
#include "studies/evidence/verification/stack_vibration.hpp"

#include <complex>
#include <fmt/format.h>

namespace stylobate::verification {

namespace {

constexpr const char* vibration_subject = "Small vibrations";

using model::pi;

/// Frequency of the strongest line [Hz]: the maximum of the windowed spectrum between two frequencies.
double strongest_line(const std::vector<double>& x, double step_s, double low, double high)
{
    double mean = 0;
    for (double v : x)
        mean += v / static_cast<double>(x.size());
    const auto size = [&](double f) {
        std::complex<double> sum = 0, turn = 1;
        const std::complex<double> step = std::polar(1.0, -2 * pi * f * step_s);
        const double n = static_cast<double>(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (i % 1024 == 0)
                turn = std::polar(1.0, -2 * pi * f * step_s * static_cast<double>(i));
            const double s = std::sin(pi * (static_cast<double>(i) + 0.5) / n);
            sum += (x[i] - mean) * s * s * turn;
            turn *= step;
        }
        return std::abs(sum);
    };
    double best = low, width = (high - low) / 60;
    for (double f = low; f <= high; f += width)
        if (size(f) > size(best))
            best = f;
    for (; width > 1e-7 * best; width *= 0.5) // one top in this neighbourhood: walk up to it
        for (double f : {best - width, best + width})
            if (size(f) > size(best))
                best = f;
    return best;
}

/// The scheme shortens periods: sin(w_num dt / 2) = w dt / 2.
double without_scheme(double f, double step_s)
{
    return std::sin(pi * f * step_s) / (pi * step_s);
}

/// Position of the top block in time: the start, then after each step.
std::vector<double> top_history(const Study& study, const Realization& r, int steps)
{
    LaneSet set(study, nullptr, kernels(best_isa()), r);
    set.load(0, r);
    std::vector<double> x{set.snapshot(0).x_m.back()};
    for (int n = 0; n < steps; ++n) {
        set.advance(n % chunk_steps, n % chunk_steps + 1);
        x.push_back(set.snapshot(0).x_m.back());
    }
    return x;
}

/// Measured over sixty periods of free vibration after half a sine that is too weak to open a joint [Hz].
double first_frequency(const Realization& undamped, double guess_hz)
{
    Realization r = undamped;
    r.frequency_hz = guess_hz;
    r.pga_m_s2 = 0.05 * std::min(1.0, guess_hz / 37);
    Study study = model::pulse(ExcitationKind::half_sine);
    study.excitation.tail_s = 80 / guess_hz;
    const auto all = top_history(study, r, static_cast<int>(60 / guess_hz / r.step_s));
    const auto pushed = static_cast<std::ptrdiff_t>(0.5 / guess_hz / r.step_s) + 2;
    const double f = strongest_line({all.begin() + pushed, all.end()}, r.step_s, 0.7 * guess_hz, 1.4 * guess_hz);
    return without_scheme(f, r.step_s);
}

Finding first_mode()
{
    Finding f;
    std::vector<double> at, oracle, spec_hz, mono_hz, mono_oracle;
    for (const double K : {1e7, 3.1622776602e7, 1e8, 3.1622776602e8, 1e9}) {
        const double dt = 5e-5 * std::sqrt(1e8 / K);
        const Realization column = model::spec({K, 0, 10}, dt, 1e-5),
                          block = model::single(model::mono_stone, {K, 0, 10}, dt, 0.06);
        const double want = frequencies_hz(column)[0], want_mono = frequencies_hz(block)[0];
        at.push_back(K);
        oracle.push_back(want);
        mono_oracle.push_back(want_mono);
        spec_hz.push_back(first_frequency(column, want));
        mono_hz.push_back(first_frequency(block, want_mono));
        f.equals(fmt::format("SPEC, K_N = {:.3g} N/m2: f1 [Hz]", K), want, spec_hz.back(), 1e-5 * want);
        f.equals(fmt::format("MONO, K_N = {:.3g} N/m2: f1 [Hz]", K), want_mono, mono_hz.back(), 1e-5 * want_mono);
    }
    const double flush = frequencies_hz(model::spec({1e8, 0, 10}, 5e-5))[0];
    f.equals("SPEC with flush sides, K_N = 1e8 N/m2: f1 [Hz]", flush,
             first_frequency(model::spec({1e8, 0, 10}, 5e-5), flush), 1e-3 * flush);
    for (const auto& [K, digits] : {std::pair{1e7, 11.601259}, {1e8, 36.925473}, {1e9, 116.843899}})
        f.equals(fmt::format("the oracle against the reference value of SPEC, K_N = {:g} N/m2 [Hz]", K), digits,
                 frequencies_hz(model::spec({K, 0, 1}, 1))[0], 1e-6);
    f.equals("the oracle against the reference value of MONO, K_N = 1e8 N/m2 [Hz]", 52.460075,
             frequencies_hz(model::single(model::mono_stone, {1e8, 0, 1}, 1))[0], 1e-6);
    f.pictures.push_back({"first_frequency",
                          "First lateral frequency over the contact stiffness: eigenvalues (lines) and "
                          "free vibration in the engine (marks)",
                          {curves({"K_N [N/m2]", true, 0, 0}, {"f1 [Hz]", true, 0, 0},
                                  {{"SPEC, eigenvalue", at, oracle, true, {}, {}},
                                   {"SPEC, engine", at, spec_hz, false, {}, {}},
                                   {"MONO, eigenvalue", at, mono_oracle, true, {}, {}},
                                   {"MONO, engine", at, mono_hz, false, {}, {}}})}});
    return f;
}

Finding axial_modes()
{
    // struck upwards at the top, by too little to open a joint: every axial mode answers
    const double K = 1e8, dt = 2e-5, w1 = std::sqrt(K * 0.048 / 0.1355);
    Finding f;
    const auto measure = [&](const Realization& r, const std::vector<double>& wanted) {
        model::BareColumn column(r);
        const StaticState rest = static_state(r);
        for (int i = 1; i < column.blocks(); ++i)
            column.at(OfBlock::y, i) = rest.y_m[static_cast<std::size_t>(i)];
        const int top = column.blocks() - 1;
        column.at(OfBlock::dy, top) = 2e-8 * w1 * dt;
        std::vector<double> y;
        for (int n = 0; n < 20000; ++n) {
            column.step();
            y.push_back(column.at(OfBlock::y, top));
        }
        for (std::size_t i = 0; i < wanted.size(); ++i)
            f.equals(fmt::format("{}, mode {} [Hz]", wanted.size() > 1 ? "SPEC" : "one drum", i + 1), wanted[i],
                     without_scheme(strongest_line(y, dt, 0.97 * wanted[i], 1.03 * wanted[i]), dt), 2e-5 * wanted[i]);
    };
    measure(model::single(model::spec_drum, {K, 0, 10}, dt, 0.06), {w1 / (2 * pi)});
    std::vector<double> wanted;
    for (int i = 1; i <= 6; ++i)
        wanted.push_back(w1 / pi * std::sin((2 * i - 1) * pi / 26));
    measure(model::spec({K, 0, 10}, dt), wanted);
    f.equals("the formula against the reference value, one drum [Hz]", 947.264153, w1 / (2 * pi), 1e-6);
    f.equals("the formula against the reference value, mode 1 [Hz]", 228.360153, wanted[0], 1e-6);
    f.equals("the formula against the reference value, mode 6 [Hz]", 1839.476756, wanted[5], 1e-6);
    return f;
}

} // namespace

Cases vibration_cases()
{
    return {
        {"FirstFrequency", vibration_subject,
         "Free vibration after a small impulse, over sixty periods, at five contact stiffnesses.",
         "eigenvalues (Eigen) of matrices that are assembled from discrete springs. The weight presses along the "
         "normal "
         "of the lower face, in the middle of the overlap. Reference values (`reference_values.py`).",
         "the window of the spectrum contributes 1e-7, the amplitude 1e-6. Drums taper by 1e-5, so that no two sides "
         "are "
         "flush. For flush sides the contact normal tilts by overlap / width, which is a force of constant size and "
         "contributes 3e-4 at this amplitude.",
         first_mode},
        {"AxialModes", vibration_subject, "Vertical vibration of one drum and of SPEC after a blow at the top.",
         "w_i = 2 w1 sin((2 i - 1) pi / (4 n + 2)), w1 = sqrt(K_N B / m); reference values (`reference_values.py`).",
         "the width of the spectral line over 20 000 steps.", axial_modes},
    };
}

} // namespace stylobate::verification
