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
    bool (*fits)(const Study& study, const ResultHeader& header);
    std::unique_ptr<Kind> (*make)(const Study& study, const ResultHeader& header);
    std::span<const PictureKind> pictures = {};
};

template <class OfKind>
std::unique_ptr<Kind> make(const Study& study, const ResultHeader& header)
{
    return std::make_unique<OfKind>(study, header);
}

/// The first that fits.
const Entry kinds[] = {
    {[](const Study&, const ResultHeader& h) { return h.kind == "replay"; }, make<SingleKind>},
    {[](const Study& s, const ResultHeader&) { return s.kind == StudyKind::single; }, make<SingleKind>},
    {[](const Study& s, const ResultHeader&) { return s.fragility.has_value(); }, make<FragilityKind>,
     FragilityKind::own_pictures},
    {[](const Study& s, const ResultHeader&) { return s.sensitivity.has_value(); }, make<SensitivityKind>,
     SensitivityKind::own_pictures},
    {[](const Study& s, const ResultHeader&) { return s.rare.has_value(); }, make<RareKind>, RareKind::own_pictures},
    {[](const Study& s, const ResultHeader&) { return s.surface && s.survival; }, make<SurvivalKind>,
     SurvivalKind::own_pictures},
    {[](const Study& s, const ResultHeader&) { return s.surface && s.replicas; }, make<ReplicasKind>,
     ReplicasKind::own_pictures},
    {[](const Study& s, const ResultHeader&) { return s.surface && s.surface->adaptive; }, make<AdaptiveKind>,
     AdaptiveKind::own_pictures},
    {[](const Study& s, const ResultHeader&) { return s.surface.has_value(); }, make<SurfaceKind>,
     SurfaceKind::own_pictures},
};

} // namespace

std::unique_ptr<Kind> make_kind(const Study& study, const ResultHeader& header)
{
    for (const Entry& kind : kinds)
        if (kind.fits(study, header))
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
