#pragma once
/// Which model a step follows. The step is a template over this: a study that names no mechanism runs the instructions
/// of its contact form and no others. `planar/mechanisms/mechanisms.hpp` has that with mechanisms.

#include "kernels/planar/step_model.hpp"

namespace stylobate {

/// Points along a face, at which a form has springs of its own.
constexpr int points_of(ContactForm form)
{
    return form == ContactForm::two_corner ? 2 : form == ContactForm::points ? 5 : 0;
}

/// The paper's model with one contact form, without mechanisms.
template <ContactForm form_>
struct Plain {
    static constexpr bool mechanisms = false;
    static constexpr ContactForm form = form_;
    static constexpr int points = points_of(form);
};
using Baseline = Plain<ContactForm::area>;

/// The paper's model with all mechanisms of `planar/mechanisms/`, each of which may be neutral, realization by
/// realization: where all are, it gives the bits of `Plain`.
template <ContactForm form_>
struct Mechanisms {
    static constexpr bool mechanisms = true;
    static constexpr ContactForm form = form_;
    static constexpr int points = points_of(form);
};

} // namespace stylobate
