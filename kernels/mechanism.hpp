#pragma once
/// Which model a step follows. The step is a template over this: a study that names no extension runs the baseline's
/// instructions and no others. `mechanisms/extended.hpp` has the other one.

#include "kernels/model.hpp"

namespace stylobate {

/// The paper's model, and nothing else.
struct Baseline {
    static constexpr bool extended = false;
    static constexpr ContactForm form = ContactForm::area;
    static constexpr int points = 0; ///< along a face, at which a form of its own has springs
};

/// The paper's model with all extensions of `mechanisms/`, each of which may be neutral, realization by realization:
/// where all are, it gives the baseline's bits.
template <ContactForm form_>
struct Extended {
    static constexpr bool extended = true;
    static constexpr ContactForm form = form_;
    static constexpr int points = form == ContactForm::two_corner ? 2 : form == ContactForm::points ? 5 : 0;
};

} // namespace stylobate
