#pragma once
/// The place where extensions of the model go.
///
/// The step is a template over a mechanism. A mechanism is a type with the members of `Baseline`; each is inlined, so
/// that a study that names none runs the baseline's instructions and no others. At its neutral value a mechanism must
/// give the baseline's bits, which a test checks for each.

#include "kernels/contact.hpp"

namespace stylobate {

/// The paper's model, and nothing else.
struct Baseline {
    /// Per-step state and parameters of the mechanism; none here.
    struct State {};

    /// The contact law of joint `joint`.
    template <class Real>
    static STYLOBATE_INLINE ContactForce<Real> force(const State&, int /*joint*/, const JointLaw<Real>& law, Real area,
                                                     Real length, Real closing, Real sliding, Real spring)
    {
        return contact_force(law, area, length, closing, sliding, spring);
    }
};

} // namespace stylobate
