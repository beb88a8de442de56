#pragma once
/// What the extensions of the model make of a realization: whether there are any, and how a bed carries with them.

#include "ensemble/model/realization.hpp"
#include "kernels/bundle.hpp"
#include "kernels/mechanisms/extended.hpp"

#include <vector>

namespace stylobate {

/// Whether any extension of the realization, or its contact form, is not neutral, or the realization is marked as
/// extended.
bool is_extended(const Realization& realization);
/// Whether an extension acts on it at rest: its form, its exponents, chips, wedges or eccentricities.
bool rests_otherwise(const Realization& realization);
/// Which step runs it.
Model model_of(const Realization& realization);

/// Force across a bed at rest [N]: the weight of what stands on it in its own column, with an equal share of the
/// epistyles' for each of their seats; of an epistyle's bed its share.
double bed_load_n(const Realization& realization, int bed);

/// Length that the faces of a bed have in common in the reference stack, without what `corner_loss` takes [m].
double face_length_m(const Realization& realization, int bed);

/// Longest contact that two blocks can have: the longer side of the smaller one [m].
double longest_contact_m(const Block& a, const Block& b);

/// Mass that the dashpots of a pair's contact are counted for: of the block that moves, or of the lighter one [kg].
double contact_mass_kg(const Block& a, const Block& b);

/// The elastic law of a bed.
struct BedLaw {
    ContactForm form = ContactForm::area;
    BedFaces<double> faces{};
    double K_n = 0;           ///< [N/m2]
    double exponent = 0;      ///< q - 1
    double per_reference = 0; ///< [1/m2]
    bool bonded = false;      ///< what opens carries tension, too (`mortar`)

    /// Elastic normal force under an overlap (or what stands for it in the other forms) [N].
    double force(double area) const;
    /// The overlap under a force [m2]; inverse of `force`.
    double area(double force) const;
};

BedLaw bed_law(const Realization& realization, int bed);

/// Writes the extensions of a realization into its lane.
/// @param order kernel's block -> realization's block
/// @pre the lane's rows are 0
void store_extension(const Realization& realization, const std::vector<int>& order, const Bundle& bundle, int lane);

} // namespace stylobate
