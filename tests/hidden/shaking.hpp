#pragma once
/// Motions of the table: what is commanded, and what the table does.

#include "tests/hidden/draws.hpp"
#include "tests/hidden/laws/model.hpp"

#include <string>
#include <utility>
#include <vector>

namespace stylobate::hidden {

/// A displacement with its velocity and acceleration; products and sines carry them along.
struct Jet {
    double u = 0, v = 0, a = 0;

    friend Jet operator+(const Jet& p, const Jet& q) { return {p.u + q.u, p.v + q.v, p.a + q.a}; }
    friend Jet operator*(const Jet& p, const Jet& q)
    {
        return {p.u * q.u, p.u * q.v + p.v * q.u, p.u * q.a + 2 * p.v * q.v + p.a * q.u};
    }
    friend Jet operator*(double c, const Jet& p) { return {c * p.u, c * p.v, c * p.a}; }
};

/// One commanded motion: an envelope that begins and ends with zero, times sines.
struct Shaking {
    struct Sine {
        double amplitude_m, hz, hz_per_s, phase_rad; ///< sine of 2 pi (f t + c t2 / 2) + phase
    };
    std::string kind; ///< "harmonic", "sweep", "quake"
    std::vector<Sine> sines;
    double from_s = 0.4; ///< still before
    double rise_s = 0.5; ///< to the full amplitude
    double fall_s = 0.5; ///< and from it
    double to_s = 3.5;   ///< still after
    double duration_s = 4;
    double peak_m_s2 = 0; ///< what its acceleration was scaled to

    /// Displacement of the table as commanded.
    Jet at(double time) const;
    /// Scales it to a peak acceleration.
    void scale_to(double peak);
};

/// Main frequency and length of the motions that suit a specimen.
struct ShakingBand {
    double low_hz, high_hz;
    double duration_s;
};

/// Draws a motion of a kind. Its peak acceleration is 1 m/s2 until it is scaled.
Shaking draw_shaking(const std::string& kind, const ShakingBand& band, Draws& draws);

/// What the table does when it is commanded so much, but for a vertical motion of its own frequency.
/// @param peak_m greatest commanded displacement
BaseState table_at(const Jet& commanded, const BaseEffect& effect, double peak_m);

/// The table through one run, at every half step of the integrator from the start; before it the table is still.
class TableMotion {
public:
    /// What the table does when it is commanded this, with these effects.
    TableMotion(const Shaking& shaking, const BaseEffect& effect, double step_s);
    /// As given at every half step.
    explicit TableMotion(std::vector<BaseState> states) : states_(std::move(states)) {}

    BaseState at(long half_step) const;
    long half_steps() const { return static_cast<long>(states_.size()); }

private:
    std::vector<BaseState> states_;
};

/// What the file says of the table if its sensor adds no noise, where so much is commanded, and at a time of a run.
/// @param of_command the command; otherwise a sensor that sees all that the table does horizontally but for its gain
Jet reported(const Jet& commanded, const BaseEffect& effect, bool of_command, double peak_m);
Jet reported(const Shaking& shaking, const BaseEffect& effect, bool of_command, double time);

} // namespace stylobate::hidden
