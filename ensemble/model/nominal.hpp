#pragma once
/// The values that a realization is built from, and what they are without perturbation.

#include "ensemble/model/structure.hpp"
#include "ensemble/model/study.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace stylobate {

/// Nominal values of a quantity: one for each bed or each block of the layout, in its order, or one in all for what
/// belongs to the whole structure. In the quantity's unit; an epistyle's drum_width is its length, its drum_offset is
/// counted from its place as it is designed.
std::vector<double> nominal_values(const Study& study, const Layout& layout, Quantity quantity);

/// A mechanism that a study names, with all places at which it acts.
struct ActingMechanism {
    const MechanismRule* rule;
    std::vector<bool> at;                                    ///< joint by joint, block by block, or the base
    std::array<std::vector<double>, most_parameters> values; ///< nominal ones, neutral elsewhere: [parameter][place]
    bool may_act = false;                                    ///< not neutral everywhere, or drawn
};

/// The mechanisms of a study, in the order in which it names them first.
std::vector<ActingMechanism> acting_mechanisms(const Study& study, const Layout& layout);

/// What a realization is built from.
struct RealizationValues {
    /// Each quantity: block by block, once, or bed by bed; of beds there is one value more, the last one, for blocks
    /// that meet elsewhere. Then each parameter of each acting mechanism, place by place.
    std::vector<std::vector<double>> all;
    std::vector<double> twin_m; ///< (blocks) how far it is from its twin's place; empty: it has none

    static constexpr std::size_t slot(Quantity quantity) { return static_cast<std::size_t>(quantity); }
    static constexpr std::size_t slot(std::size_t mechanism, std::size_t parameter)
    {
        return quantity_count + most_parameters * mechanism + parameter;
    }
    std::vector<double>& operator[](Quantity quantity) { return all[slot(quantity)]; }
    const std::vector<double>& operator[](Quantity quantity) const { return all[slot(quantity)]; }
    double of(std::size_t mechanism, std::size_t parameter, std::size_t place) const
    {
        return all[slot(mechanism, parameter)][place];
    }
};

/// The values of a realization of which nothing is drawn.
RealizationValues nominal_values(const Study& study, const Layout& layout,
                                 const std::vector<ActingMechanism>& mechanisms);

/// A drum of a realization as it is stacked.
struct StackedDrum {
    double bottom_m = 0, height_m = 0;
};
/// The drums of a realization, in the order of the layout, whose first blocks they are. A column of its own is as high
/// as its drums are; those of a colonnade stay level, as masons dress the seats: the topmost drum of each takes up what
/// the others differ.
/// @param index of the realization
/// @throws InputError if that leaves less than half of a topmost drum
std::vector<StackedDrum> stacked_drums(const Study& study, const Layout& layout, const RealizationValues& values,
                                       std::uint64_t index);

/// The parts of the critical damping that the dashpots of a joint have.
struct DampingRatios {
    double normal = 0;
    double tangential = 0;
};
/// Those of a realization: the ratio that is drawn is the normal one. A value that takes the nominal one's place is
/// that of both directions; a change of the nominal one changes both in proportion.
/// @param own of the bed: its own ratio changes as that of [contact] does, and stays where a drawn value takes the
///            latter's place
DampingRatios damping_ratios(const Study& study, const RealizationValues& values, const BedSpec& own = {});

/// Of each bed of the layout, in its order.
std::vector<double> nominal_restitution(const Study& study, const Layout& layout);

/// For each bed between the layout's blocks: how deep the weight on it presses the blocks into each other, W / (K_N B),
/// W the weight above and B the length of the bed [m] (Winkler bed, `kernels/THEORY.md` section 1). The weight of an
/// epistyle is shared equally by all of its seats.
std::vector<double> static_sinkage_m(const Study& study);

/// `tail_after_shaking` (base_motion.hpp) of the structure as it is given, nothing drawn [s].
double nominal_tail_s(const StructureSpec& structure);
/// So many times `tail_after_shaking` is the pause between earthquakes by default.
inline constexpr double pause_tails = 10;
/// The pause between two shakings of a sequence [s]. @pre the study has a set of motions
double shaking_pause_s(const Study& study);
/// So many times longer a realization may be simulated until it lies still (`Tail::rest`).
inline constexpr double rest_tails = 20;

} // namespace stylobate
