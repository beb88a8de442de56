#include "studies/results/kinds.hpp"

#include "studies/kinds/adaptive/adaptive_kind.hpp"
#include "studies/kinds/fragility/fragility_kind.hpp"
#include "studies/kinds/rare/rare_kind.hpp"
#include "studies/kinds/replicas/replicas_kind.hpp"
#include "studies/kinds/sensitivity/sensitivity_kind.hpp"
#include "studies/kinds/single/single_kind.hpp"
#include "studies/kinds/surface/surface_kind.hpp"
#include "studies/kinds/survival/survival_kind.hpp"

#include <algorithm>
#include <stdexcept>

namespace stylobate {

namespace {

struct Entry {
    bool (*fits)(const Study& study);
    std::unique_ptr<Kind> (*make)(const Study& study, const ResultHeader& header);
    std::span<const PictureKind> pictures;
};

template <class OfKind>
std::unique_ptr<Kind> make(const Study& study, const ResultHeader& header)
{
    return std::make_unique<OfKind>(study, header);
}

template <class OfKind>
constexpr Entry entry{OfKind::fits, make<OfKind>, OfKind::own_pictures};

/// The first that fits.
constexpr Entry kinds[] = {entry<SingleKind>,   entry<FragilityKind>, entry<SensitivityKind>, entry<RareKind>,
                           entry<SurvivalKind>, entry<ReplicasKind>,  entry<AdaptiveKind>,    entry<SurfaceKind>};

} // namespace

std::unique_ptr<Kind> make_kind(const Study& study, const ResultHeader& header)
{
    if (header.kind == "replay")
        return make<SingleKind>(study, header);
    for (const Entry& kind : kinds)
        if (kind.fits(study))
            return kind.make(study, header);
    throw std::logic_error("a study is of some kind");
}

std::vector<PictureKind> kind_pictures()
{
    std::vector<PictureKind> all;
    for (const Entry& kind : kinds)
        for (const PictureKind& picture : kind.pictures)
            if (std::ranges::find(all, picture.name, &PictureKind::name) == all.end())
                all.push_back(picture);
    return all;
}

} // namespace stylobate
