#pragma once
/// From drawn values to a structure in space: its bodies, its joints, its mechanisms, and its step.

#include "ensemble/model/nominal.hpp"
#include "ensemble/model/study.hpp"
#include "ensemble/realization/realization.hpp"
#include "ensemble/spatial/structure/spatial_scales.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// Builds the realizations of a study in space. It refers to the study, which must outlive it, stay where it is and not
/// change.
class SpatialBuilder {
public:
    using Realization = stylobate::Realization;

    /// @throws InputError if the structure cannot stand
    explicit SpatialBuilder(const Study& study);

    /// The values of a realization of which nothing is drawn.
    const RealizationValues& nominal() const { return nominal_; }
    const std::vector<ActingMechanism>& mechanisms() const { return mechanisms_; }

    /// A realization without its shaking and its step: `Realization::space` of it, and what the header has of the
    /// structure.
    /// @throws InputError if it cannot be built: bodies that miss each other or overlap, a centre of mass outside its
    ///                    body
    Realization build(RealizationValues values, RealizationHeader header) const;
    static Scales scales(const Realization& realization) { return spatial_scales(realization); }
    /// The step of a realization that has its shaking.
    /// @throws InputError if the study's own step is above the safe bound and the study does not allow it explicitly
    double step_s(const Realization& realization) const;
    /// Displaces a body along x. Last of all, so that nothing follows from it: dashpots and step stay as they are.
    /// @param original index of the realization of which it is a replica
    /// @throws InputError if the body then misses the one below or above it
    void move(const Replica& replica, std::uint64_t original, Realization& realization) const;

private:
    void stack(const RealizationValues& values, Realization& realization) const;
    void lay_epistyles(const RealizationValues& values, Realization& realization) const;
    Solid solid(const RealizationValues& values, std::size_t i, double height_m, double bottom_m) const;
    Solid ground() const;
    void give_law(const RealizationValues& values, const Realization& realization, std::size_t value, double area,
                  SolidJoint& joint) const;
    void join(const RealizationValues& values, Realization& realization) const;
    void butt(const RealizationValues& values, Realization& realization) const;
    void check_overlaps(const Realization& realization) const;
    void apply_mechanisms(const RealizationValues& values, Realization& realization) const;
    void displace_mass(std::size_t place, Realization& realization) const;
    std::string name(int solid) const;

    const Study* study_;
    Layout layout_;
    std::vector<ActingMechanism> mechanisms_;
    RealizationValues nominal_;
    bool has_ground_;
    bool with_mechanisms_ = false; ///< a mechanism that the plain step does not have may act
};

} // namespace stylobate
