#pragma once
/// One perturbed structure and its base motion: a pure function of (study, seed, index). Plain data, SI units.

#include "ensemble/model/motion.hpp"
#include "kernels/planar/step_model.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace stylobate {

/// What a block is, for names, limit states and pictures.
enum class BlockRole : std::uint8_t {
    drum,     ///< of a column, a capital or a whole shaft included
    epistyle, ///< spans from column to column
    ground    ///< what a structure stands on, and what has fallen lies on
};

/// What the mechanisms (`kernels/planar/mechanisms/`) make of a joint. Every default is neutral.
struct JointMechanisms {
    double dynamic_ratio = 1;         ///< stribeck: mu_d / mu
    double stribeck_velocity_m_s = 1; ///< stribeck: v_s
    double wear_per_m = 0;            ///< friction_wear: mu (1 - k S), S the slip of the joint so far
    double adhesion_n_m = 0;          ///< adhesion: c, force per contact length, until the joint first slips
    double dowel_stiffness_n_m = 0;   ///< dowel: k_d
    double dowel_yield_n = 0;         ///< dowel: F_d
    double dowel_gap_m = 0;           ///< dowel: free play to either side
    double force_exponent = 1;        ///< hertz: q in F = K A^q, scaled to the force at the reference overlap
    double reference_overlap_m2 = 1;  ///< hertz: where the law has the force of the linear one
    double rate_s_m = 0;              ///< rate_damping: Hunt and Crossley's lambda
    double face_damping = 0;          ///< share of the normal dashpot that acts at the ends of the contact
    double chip_left_m = 0;           ///< corner_loss: contact face lost at its left end
    double chip_right_m = 0;          ///< corner_loss: at its right end
    double corner_wear_m_rad = 0;     ///< corner_wear: further loss at both ends per path of the relative rotation
    double wedge_rad = 0;             ///< wedge: the lower block's face is turned by this, counter-clockwise
    friend bool operator==(const JointMechanisms&, const JointMechanisms&) = default;
};

/// The same of a block.
struct BlockMechanisms {
    double drag_n_s2_m2 = 0;   ///< drag: F = -c |v| v, v the centre's velocity in the laboratory
    double eccentricity_m = 0; ///< eccentricity: centre of mass from the geometric centre, along the width
    double tie_n_m = 0;        ///< tie: k in F = f - k x - c x', horizontally, against the base; may be negative
    double tie_n_s_m = 0;      ///< tie: c
    double tie_n = 0;          ///< tie: f
    double tie_n_m_s = 0;      ///< tie: moment against the rotation, per rate of rotation
    friend bool operator==(const BlockMechanisms&, const BlockMechanisms&) = default;
};

/// What strengthens a joint (`kernels/planar/mechanisms/strengthening.hpp`). Every default is neutral. All of it was
/// put in when the structure was at rest.
struct JointStrengthening {
    double bearing_n_m = 0;        ///< bearing: k
    double bearing_n_s_m = 0;      ///< bearing: c
    double bearing_per_m = 0;      ///< bearing: 1 / R, the curvature of its dish
    double bond_tension_n_m = 0;   ///< mortar: tensile strength times depth, f_t D
    double bond_cohesion_n_m = 0;  ///< mortar: cohesion times depth, c D
    double hold_n = 0;             ///< pull_out: F_a of one dowel
    double hold_stiffness_n_m = 0; ///< pull_out: axial stiffness of one dowel
    double hold_length_m = 0;      ///< pull_out: opening at which a dowel is out
    double hold_spread_m = 0;      ///< pull_out: of the two dowels from the middle of the upper face
    bool bonded() const { return bond_tension_n_m > 0; }
    friend bool operator==(const JointStrengthening&, const JointStrengthening&) = default;
};

/// The same of a block.
struct BlockStrengthening {
    double tendon_n_m = 0;         ///< tendon: k, from the middle of the block's top face down to the fixed ground
    double tendon_prestress_n = 0; ///< tendon: T0, at rest
    double tendon_yield_n = 1e12;  ///< tendon: T_y
    double clamp_n_m = 0;          ///< clamp: k, to the block `clamp_to`
    double clamp_strength_n = 0;   ///< clamp: F_y
    double clamp_gap_m = 0;        ///< clamp: free play to either side
    double clamp_compression = 1;  ///< clamp: its stiffness in compression over that in tension
    double clamp_height_m = 0;     ///< clamp: above the middle of this block
    double clamp_break_m = 10;     ///< clamp: elongation at which it breaks
    int clamp_to = -1;             ///< the block beside it at the right; -1: no clamp
    friend bool operator==(const BlockStrengthening&, const BlockStrengthening&) = default;
};

/// The same of the base, beside what changes its horizontal motion alone (gain, offset in time, distortion).
struct BaseMechanisms {
    double pitch_rad_s2_m = 0; ///< table_pitch: rotation of the table about the middle of the base, per acceleration
    double vertical_ratio = 0; ///< vertical_motion: vertical over horizontal acceleration of the base
    friend bool operator==(const BaseMechanisms&, const BaseMechanisms&) = default;
};

/// Changes of the horizontal motion of the base before it reaches the structure (`base_motion.hpp`). Every default
/// is neutral. With psi the phase of the motion, u = |z| sin psi (`distortion.hpp`), the distortion adds
/// second |z| sin 2 psi + second_quadrature |z| cos 2 psi, and the same of the third order.
struct BaseChange {
    double gain = 1;              ///< sensor_gain: true motion over the one that the study names
    double offset_s = 0;          ///< time_offset: at time t the base is where the named motion is at t + offset
    double second = 0;            ///< harmonic_distortion, as parts of the displacement
    double second_quadrature = 0; ///< the same, a quarter of a period apart
    double third = 0;
    double third_quadrature = 0;
    bool distorts() const { return second != 0 || second_quadrature != 0 || third != 0 || third_quadrature != 0; }
    friend bool operator==(const BaseChange&, const BaseChange&) = default;
};

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
};

/// What every model's realization has: its index, its shaking, its step and what was drawn.
struct RealizationHeader {
    std::uint64_t index = 0;
    BaseChange change;
    double frequency_hz = 0; ///< of the sine or pulse; of noise the ground's; of a record the predominant one
    double pga_m_s2 = 0;
    double phase_rad = 0;
    double pulse_gamma = 0; ///< oscillatory character of a velocity pulse
    /// The base motion that is this realization's own (noise, a distorted one, one of a set), else null.
    std::shared_ptr<const Motion> motion;
    double motion_scale = 1; ///< factor on its own motion
    /// Vertical base motion of its own, which starts with the shaking; else null.
    std::shared_ptr<const Motion> vertical;
    double gravity_m_s2 = 9.81;
    double step_s = 0;
    std::vector<double> inputs; ///< drawn values in the order of `input_names(study)`
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

struct Realization : RealizationHeader, PlanarStructure {};

} // namespace stylobate
