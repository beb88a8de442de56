#pragma once
/// Harmonic distortion of a sampled motion: the overtones that a shaking table adds to its command.
///
/// A displacement u has the analytic signal z = u + i H(u), H the Hilbert transform (Gabor, "Theory of communication",
/// Journal of the Institution of Electrical Engineers 93 (1946) 429). With |z| the envelope of u and psi its phase, u =
/// |z| sin psi, the order m adds
///
///   a |z| sin(m psi) + b |z| cos(m psi)        a in phase, b in quadrature
///
/// which for u = A sin w t is A (a sin m w t + b cos m w t) (own derivation). The line from the first to the last
/// sample is subtracted from the displacement before. At both ends the overtones rise from 0 and fall to it within half
/// a second (2 % of the duration where that is less), so that the motion still starts at rest.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/realization.hpp"

#include <array>
#include <vector>

namespace stylobate {

class Distortion {
public:
    Distortion() = default;
    /// @pre the motion is not empty; it is not kept
    explicit Distortion(const Motion& motion);

    /// The motion with its overtones; its PGA and predominant frequency are those without them.
    Motion distorted(const Motion& motion, const BaseChange& change) const;

private:
    /// Of unit coefficients, in the order of `BaseChange`: (4 x n) [m/s2].
    std::array<std::vector<double>, 4> acceleration_;
};

} // namespace stylobate
