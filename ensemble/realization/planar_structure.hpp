#pragma once
/// A structure in the plane: rectangles, and what joins them. Plain data, SI units.

#include "ensemble/model/mechanism_spec.hpp"
#include "ensemble/model/structure.hpp"
#include "kernels/planar/step_model.hpp"

#include <cstdint>
#include <vector>

namespace stylobate {

/// A rigid rectangle in its place in the reference stack (faces just touching, before the static overlaps).
struct Block {
    double half_width_m = 0;
    double half_height_m = 0;
    double mass_kg = 0;
    double inertia_kg_m2 = 0; ///< about the centre, m (B2 + H2) / 12
    double x_m = 0;           ///< centre, against the axis of the structure
    double y_m = 0;           ///< centre, above the base
    bool fixed = false;       ///< moves with the base
    BlockRole role = BlockRole::drum;
    int column = 0; ///< of a drum, from the left; -1 for all else
    BlockMechanisms mechanisms{};
    BlockStrengthening strengthening{};
};

/// The bed between two blocks, or what becomes one if they meet.
struct Joint {
    int lower = 0; ///< index of the lower block
    int upper = 0; ///< index of the upper block
    double normal_stiffness_n_m2 = 0;
    double tangential_stiffness_n_m = 0;
    double normal_damping_n_s_m = 0;
    double tangential_damping_n_s_m = 0;
    double damping_chord_m = 0; ///< contact length at which the dashpots have these coefficients; 0: at any length
    double friction = 0;
    double restitution = 0; ///< of the rigid form, 0 to 1 (`RestitutionLaw`)
    JointMechanisms mechanisms{};
    JointStrengthening strengthening{};

    // A bond of the faces that holds them against opening too: mortar, or adhesion with a tension.
    bool bonded() const { return bond_tension_n_m() > 0; }
    double bond_tension_n_m() const { return strengthening.bond_tension_n_m + mechanisms.adhesion_tension_n_m; }
    double bond_cohesion_n_m() const
    {
        return strengthening.bond_cohesion_n_m + (mechanisms.adhesion_tension_n_m > 0 ? mechanisms.adhesion_n_m : 0);
    }
    /// Adhesion against sliding alone.
    double adhesion_n_m() const { return mechanisms.adhesion_tension_n_m > 0 ? 0 : mechanisms.adhesion_n_m; }
};

/// A structure in the plane: rectangles, and what joins them.
struct PlanarStructure {
    std::vector<Block> blocks; ///< column by column from the bottom, then the epistyles, then the ground where needed
    std::vector<Joint> joints; ///< with at least one free block each: the beds at rest, then the watched pairs
    int watched = 0;           ///< number of joints, the last ones, between blocks that share no bed but may meet
    int drums = 0;             ///< blocks without the ground
    BaseMechanisms base;
    double base_tilt_rad = 0;    ///< base out of level
    double initial_tilt_rad = 0; ///< leaned about the lower corner of `initial_tilt_block`
    int initial_tilt_block = 0;  ///< of each column, from the bottom: it and what stands on it lean
    double initial_lift_m = 0;   ///< from this block up it is held so high above its bed, and released at the start
    ContactForm form = ContactForm::area;
    RestitutionLaw restitution_law = RestitutionLaw::newton;
    bool with_mechanisms =
        false;                 ///< run by the step with mechanisms even where every mechanism is neutral (`model_of`)
    bool strengthened = false; ///< with the rows of strengthening even where every one is neutral (`model_of`)

    int beds() const { return static_cast<int>(joints.size()) - watched; }
    /// Blocks that are stepped.
    std::uint64_t free_blocks() const
    {
        std::uint64_t count = 0;
        for (const Block& block : blocks)
            count += !block.fixed;
        return count;
    }
};

} // namespace stylobate
