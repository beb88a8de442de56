#pragma once
/// Which model a bundle's step uses: the paper's, or that with mechanisms (`planar/mechanisms/`), and the contact form.

#include <cstdint>

namespace stylobate {

/// How the faces of a bed carry (`kernels/planar/mechanisms/README.md`). Pairs other than beds use the area form.
enum class ContactForm : std::uint8_t {
    area,       ///< the paper's: overlap area, at its centroid
    two_corner, ///< springs at the two ends of the face
    points,     ///< Hertz-like springs at points along the face
    rigid       ///< no springs: the ends of the face may not enter it (`rigid/rigid_step.hpp`)
};

/// What a restitution is a part of.
enum class RestitutionLaw : std::uint8_t {
    newton, ///< of the velocity with which an end closes: it parts again with it
    poisson ///< of the impulse with which any end is compressed in an impact: it is given back
};

struct StepModel {
    bool mechanisms = false; ///< a mechanism of a joint, a block or the base may be other than neutral
    ContactForm form = ContactForm::area;
    bool strengthened =
        false; ///< with mechanisms: so may be one of what strengthens a structure (`mechanisms/strengthening.hpp`)
    constexpr bool rigid() const { return form == ContactForm::rigid; }
    /// Whether the bundle has the rows of the mechanisms: some belong to the forms.
    constexpr bool has_mechanism_rows() const
    {
        return mechanisms || form == ContactForm::two_corner || form == ContactForm::points;
    }
    friend bool operator==(const StepModel&, const StepModel&) = default;
};

} // namespace stylobate
