#pragma once
/// From drawn values to a structure in the plane: its blocks, its joints, its mechanisms, and its step.

#include "ensemble/model/nominal.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/planar/structure/mechanism_builder.hpp"
#include "ensemble/planar/structure/scales.hpp"
#include "ensemble/realization/realization.hpp"

#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// Builds the realizations of a study. It refers to the study, which must outlive it, stay where it is and not change.
class PlanarBuilder {
public:
    using Realization = stylobate::Realization;

    /// @throws InputError if the structure cannot stand
    explicit PlanarBuilder(const Study& study);

    /// The values of a realization of which nothing is drawn.
    const RealizationValues& nominal() const { return nominal_; }
    const std::vector<ActingMechanism>& mechanisms() const { return mechanisms_.acting(); }

    /// A realization without its shaking and its step.
    /// @throws InputError if it cannot be built: blocks that miss each other or overlap
    Realization build(RealizationValues values, RealizationHeader header) const;
    static Scales scales(const Realization& realization) { return scales_of(realization); }
    /// The step of a realization that has its shaking.
    /// @throws InputError if the study's own step is above the safe bound and the study does not allow it explicitly
    double step_s(const Realization& realization) const;
    /// Displaces a block. Last of all, so that nothing follows from it: contacts, dashpots and step stay as they are.
    /// @param original index of the realization of which it is a replica
    /// @throws InputError if the block then misses the one below or above it
    void move(const Replica& replica, std::uint64_t original, Realization& realization) const;

private:
    void watch_pairs();
    void stack(const RealizationValues& values, Realization& realization) const;
    void lay_epistyles(const RealizationValues& values, Realization& realization) const;
    Block block(const RealizationValues& values, std::size_t i, double height_m) const;
    Block ground() const;
    Joint joint(const RealizationValues& values, const std::vector<Block>& blocks, int lower, int upper,
                std::size_t value, double chord_m) const;
    void join(const RealizationValues& values, Realization& realization) const;
    void watch(const RealizationValues& values, Realization& realization) const;
    double rigid_step_s(const Realization& realization) const;
    std::string name(int block) const;

    const Study* study_;
    Layout layout_;
    MechanismBuilder mechanisms_;
    RealizationValues nominal_;
    std::vector<double> restitution_; ///< (beds)
    bool has_ground_ = false;
    std::vector<std::pair<int, int>> watched_; ///< lower and upper block
};

} // namespace stylobate
