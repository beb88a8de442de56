#pragma once
/// The beds of a realization: their faces, what they carry at rest, their elastic laws, their stiffness at full
/// contact.

#include "ensemble/realization/realization.hpp"
#include "kernels/planar/mechanisms/mechanisms.hpp"

#include <vector>

namespace stylobate {

inline const Block& block_of(const Realization& realization, int block)
{
    return realization.blocks[static_cast<std::size_t>(block)];
}

/// Length that the faces of a bed have in common in the reference stack, without what `corner_loss` takes [m].
double face_length_m(const Realization& realization, int bed);

/// Force across a bed at rest [N]: the weight of what stands on it in its own column, with an equal share of the
/// epistyles' for each of their seats; of an epistyle's bed its share.
double bed_load_n(const Realization& realization, int bed);

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

/// A bed in the reference stack, under the loads at rest.
struct BedAtRest {
    const Joint& joint;
    const Block& lower;
    const Block& upper;
    double left_m, right_m;             ///< ends of the face that the blocks have in common
    bool left_of_lower, right_of_lower; ///< whose side ends it; the upper block's where both do
    double length_m;                    ///< `face_length_m`
    double force_n;                     ///< `bed_load_n` and what the tendons add at rest
    BedLaw law;
};

/// @return (beds), referring to the realization
std::vector<BedAtRest> beds_at_rest(const Realization& realization);

/// Depth at the middle of the contact, and rotation of the upper block relative to the lower one.
struct Bedding {
    double depth_m, rotation_rad;
};

/// How the paper's bed carries a force: stiffness K per area on a contact of length L under the force N at the
/// eccentricity e from its middle, without tension (Winkler bed with uplift, own derivation). A block that cannot stand
/// (e beyond L / 2) gets no rotation: it falls from where it is.
Bedding bedding(double K, double L, double N, double e);

/// How a bed of any contact form and exponent carries a force.
Bedding bedding(const BedLaw& law, double L, double N, double e);

/// Beds that stiffen with their load, and dashpots that do, are taken at this multiple of the load at rest.
inline constexpr double bound_load = 10;

/// Stiffness and dashpots of a bed whose faces touch all along, for the linear vibrations of a structure.
struct FullContact {
    double chord = 0;   ///< length of the contact [m]
    double x = 0;       ///< its centre [m]
    double k_n = 0;     ///< normal stiffness [N/m]
    double k_theta = 0; ///< rotational stiffness about the centre [N m]
    double k_t = 0;     ///< tangential stiffness [N/m]
    double c_n = 0;     ///< normal dashpots [N s/m]
    double c_theta = 0; ///< their moment about the centre per rate of rotation [N m s]
    double c_t = 0;     ///< tangential dashpot [N s/m]
};

/// Full contact of a bed of the paper's model.
FullContact full_contact(const Block& lower, const Block& upper, const Joint& joint);

/// Full contact of a bed with its form and mechanisms, about a load of `times` that at rest.
FullContact full_contact(const BedAtRest& bed, double times);

} // namespace stylobate
