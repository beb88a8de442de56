#pragma once
/// The design of a study: which realizations it has, how they are counted, and what they have in common. Every member
/// has a neutral value, that of independent realizations of one structure under one excitation; what a kind of study
/// makes of it stands in study_design.cpp, and nothing else of the engine asks for the kind.
///
/// Realizations are counted cell by cell, then layer by layer: all originals, then all of them once more under two
/// events, and so on, or all replicas of the first kind in the same order, and so on.

#include "ensemble/model/kind_settings.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

namespace stylobate {

struct StudyDesign {
    // ---- which realizations there are ------------------------------------------------------------------------------

    std::uint64_t cells = 1;    ///< parts with as many originals each: frequency (or direction) x PGA, or motion x
                                ///< stripe
    std::uint64_t columns = 1;  ///< of the cells: cell = row x columns + column
    std::uint64_t per_cell = 1; ///< originals of a cell
    std::uint64_t layers = 1;   ///< times that all originals are there
    int events = 1;             ///< most shakings in succession, all with the strength of the cell; layer k has k + 1
    const ReplicasSpec* replica_set = nullptr; ///< layer k > 0 is its kind k - 1; null: there are none
    /// From this index on the numbers of a realization follow from those of others: it cannot be drawn alone.
    std::uint64_t chained_from = ~std::uint64_t{0};
    std::uint64_t most = 1; ///< upper bound of the realizations that are run
    bool selected = false;  ///< which ones are run depends on what others did

    // ---- what they have in common ----------------------------------------------------------------------------------

    std::uint64_t per_motion = 1;         ///< so many of a cell, in succession, draw the same motion
    std::uint64_t structure = 1;          ///< number of the structure under the motions of the seed
    std::uint64_t recurring = 1;          ///< so many cells in succession have the same structures
    std::uint64_t same_imperfections = 1; ///< so many structures in succession have the same ones
    std::uint64_t same_contacts = 1;      ///< so many of these have the same contacts too
    /// Standard deviation of the place of each drum, by which structures with the same contacts differ [m]; 0: they do
    /// not.
    double twin_m = 0;
    const FactorDesign* factors = nullptr;  ///< whose points the realizations are; null: they are no points
    const MotionSetSpec* motions = nullptr; ///< a row of cells each; null: one excitation for all
    const Axis* frequency_hz = nullptr;     ///< of the rows of cells; null: that of the excitation
    const Axis* direction_deg = nullptr;    ///< of the rows of cells in space; null: that of the excitation
    const Axis* pga_m_s2 = nullptr;         ///< of the columns; null: that of the excitation
    std::optional<double> event_pause_s;    ///< between two events; none: until the realization is at rest

    // ---- what is reported of them ----------------------------------------------------------------------------------

    bool traced = false;    ///< each one by itself, over time
    bool residuals = false; ///< what remains of the displacements: simulated until rest by default
    bool end_state = false; ///< the offset of each bed and the rotation of each block at the end

    // ---- how they are counted --------------------------------------------------------------------------------------

    /// Realizations that are not perturbed replicas, under one event.
    std::uint64_t originals() const { return per_cell * cells; }
    std::uint64_t total() const { return originals() * layers; }
    bool chained() const { return chained_from < total(); }
    /// How many of the first `count` can be drawn alone.
    std::uint64_t drawn_alone(std::uint64_t count) const { return std::min(count, chained_from); }
    /// The original of a replica, or the realization of one event with the same draws; of an original its own index.
    std::uint64_t original(std::uint64_t index) const { return layers > 1 ? index % originals() : index; }
    /// Its kind; null of an original.
    const Replica* replica(std::uint64_t index) const
    {
        return replica_set != nullptr && index >= originals() ? &replica_set->kinds[index / originals() - 1] : nullptr;
    }
    std::uint64_t cell(std::uint64_t index) const { return cells > 1 ? original(index) / per_cell : 0; }
    /// How many events shake a realization.
    int events_of(std::uint64_t index) const { return events > 1 ? 1 + static_cast<int>(index / originals()) : 1; }
    /// The number of a factor by its name among the inputs; -1: it is none.
    int factor(const std::string& name) const { return factors != nullptr ? factors->number(name) : -1; }
    /// Index by which a realization draws its motion: that of all structures under the motion, or of all points of a
    /// row.
    std::uint64_t motion_index(std::uint64_t index) const
    {
        return factors != nullptr ? factors->rest_index(index)
                                  : index / per_cell * per_cell + index % per_cell / per_motion;
    }
};

} // namespace stylobate
