#pragma once
/// Which model a step follows. The step is a template over this: a study that names no extension runs the instructions
/// of its contact form and no others. `mechanisms/extended.hpp` has the extended one.

#include "kernels/model.hpp"

namespace stylobate {

/// Points along a face, at which a form has springs of its own.
constexpr int points_of(ContactForm form)
{
    return form == ContactForm::two_corner ? 2 : form == ContactForm::points ? 5 : 0;
}

/// The paper's model with one contact form, without extensions.
template <ContactForm form_>
struct Plain {
    static constexpr bool extended = false;
    static constexpr ContactForm form = form_;
    static constexpr int points = points_of(form);
};
using Baseline = Plain<ContactForm::area>;

/// The paper's model with all extensions of `mechanisms/`, each of which may be neutral, realization by realization:
/// where all are, it gives the bits of `Plain`.
template <ContactForm form_>
struct Extended {
    static constexpr bool extended = true;
    static constexpr ContactForm form = form_;
    static constexpr int points = points_of(form);
};

} // namespace stylobate
