#pragma once
/// The builder of a study's structures: of those in the plane, or of those in space.

#include "ensemble/planar/structure/builder.hpp"
#include "ensemble/spatial/structure/builder.hpp"

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

namespace stylobate {

/// Builds the realizations of a study by the model that `StructureSpec::dimensions` names. What its functions do and
/// throw is described at the builders of the models.
class StructureBuilder {
public:
    using Realization = stylobate::Realization;

    explicit StructureBuilder(const Study& study) : builder_(of(study)) {}

    const RealizationValues& nominal() const
    {
        return std::visit([](const auto& builder) -> const RealizationValues& { return builder.nominal(); }, builder_);
    }
    const std::vector<ActingMechanism>& mechanisms() const
    {
        return std::visit(
            [](const auto& builder) -> const std::vector<ActingMechanism>& { return builder.mechanisms(); }, builder_);
    }
    Realization build(RealizationValues values, RealizationHeader header) const
    {
        return std::visit([&](const auto& builder) { return builder.build(std::move(values), std::move(header)); },
                          builder_);
    }
    static Scales scales(const Realization& realization)
    {
        return realization.spatial() ? SpatialBuilder::scales(realization) : PlanarBuilder::scales(realization);
    }
    double step_s(const Realization& realization) const
    {
        return std::visit([&](const auto& builder) { return builder.step_s(realization); }, builder_);
    }
    void move(const Replica& replica, std::uint64_t original, Realization& realization) const
    {
        std::visit([&](const auto& builder) { builder.move(replica, original, realization); }, builder_);
    }

private:
    using AnyBuilder = std::variant<PlanarBuilder, SpatialBuilder>;

    static AnyBuilder of(const Study& study)
    {
        if (study.structure.spatial())
            return SpatialBuilder(study);
        return PlanarBuilder(study);
    }

    AnyBuilder builder_;
};

} // namespace stylobate
