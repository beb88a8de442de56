#include "ensemble/estimators/past/agreeing_states.hpp"
#include "ensemble/model/input_error.hpp"
#include "io/hazard/hazard_file.hpp"
#include "io/keys/kind_keys.hpp"
#include "io/study/study_parts.hpp"

#include <fmt/format.h>

#include <numeric>
#include <system_error>

namespace stylobate {

namespace {

namespace keys_of = survival_keys;

void check_count(const KeyReader& keys, const ListKey& key, std::size_t found, std::size_t wanted, const char* of)
{
    if (found != wanted)
        keys.refuse(key.name, fmt::format("has {} values, and there are {} {}", found, wanted, of),
                    "Give one value for each, in their order.");
}

void read_offsets(const KeyReader& keys, std::size_t beds, ObservedState& observed)
{
    if (!keys.has(keys_of::tolerance)) {
        for (const ListKey* key : {&keys_of::joint_offset, &keys_of::joints})
            if (keys.has(*key))
                keys.missing(keys_of::tolerance.name, fmt::format("{} was measured with some tolerance: give it in "
                                                                  "metres.",
                                                                  key->name));
        return;
    }
    observed.tolerance_m = keys.read(keys_of::tolerance);
    for (const std::uint64_t joint : keys.whole_list_or_none(keys_of::joints.name, 0, beds - 1,
                                                             fmt::format("The structure has {} joints.", beds))) {
        if (!observed.joints.empty() && static_cast<int>(joint) <= observed.joints.back())
            keys.refuse(keys_of::joints.name, "is not in ascending order", "Give each joint once, the lowest first.");
        observed.joints.push_back(static_cast<int>(joint));
    }
    if (observed.joints.empty()) {
        observed.joints.resize(beds);
        std::iota(observed.joints.begin(), observed.joints.end(), 0);
    }
    observed.offset_m.assign(observed.joints.size(), 0);
    if (!keys.has(keys_of::joint_offset))
        return;
    observed.offset_m = keys.number_list(keys_of::joint_offset.name, keys_of::joint_offset.range);
    check_count(keys, keys_of::joint_offset, observed.offset_m.size(), observed.joints.size(), "joints");
}

void read_rotations(const KeyReader& keys, const Layout& layout, ObservedState& observed)
{
    if (keys.has(keys_of::rotation) != keys.has(keys_of::rotation_tolerance))
        keys.missing(keys.has(keys_of::rotation) ? keys_of::rotation_tolerance.name : keys_of::rotation.name,
                     "rotation_rad and rotation_tolerance_rad belong together.");
    if (!keys.has(keys_of::rotation))
        return;
    std::size_t free = 0;
    for (const PlacedBlock& block : layout.blocks)
        free += !block.fixed;
    observed.rotation_rad = keys.number_list(keys_of::rotation.name, keys_of::rotation.range);
    observed.tolerance_rad = keys.read(keys_of::rotation_tolerance);
    check_count(keys, keys_of::rotation, observed.rotation_rad.size(), free, "free blocks");
}

ObservedState read_observed(const KeyReader& keys, const StructureSpec& structure)
{
    const Layout layout = lay_out(structure);
    ObservedState observed;
    read_offsets(keys, layout.beds.size(), observed);
    read_rotations(keys, layout, observed);
    if (observed.joints.empty() && observed.rotation_rad.empty())
        keys.missing(
            keys_of::tolerance.name,
            "Give the tolerance of the measured displacements; without joint_offset_m the structure is as new. "
            "Where only its standing is known, omit `observed`.");
    observed.mirrored = keys.read(keys_of::mirrored);
    if (observed.mirrored && !mirror_image(layout))
        keys.refuse(keys_of::mirrored.name, "needs a structure that is its own mirror image",
                    "Remove it: what shaking of the other sense leaves of it is no mirror image.");
    return observed;
}

void check_curve(const KeyReader& keys, const HazardSpec& hazard, const char* key)
{
    const std::vector<double>&a = hazard.intensity_m_s2, &h = hazard.rate_per_year;
    if (a.size() < 2 || a.size() != h.size())
        keys.refuse(key, fmt::format("gives {} intensities and {} rates", a.size(), h.size()),
                    "A hazard curve has as many of both, two at least.");
    for (std::size_t i = 1; i < a.size(); ++i)
        if (!(a[i] > a[i - 1]) || h[i] > h[i - 1] || (i + 1 == a.size() && h[i] == h[i - 1]))
            keys.refuse(key,
                        fmt::format("is no hazard curve: point {} has {:g} m/s2 at {:g} per year after {:g} at {:g}",
                                    i + 1, a[i], h[i], a[i - 1], h[i - 1]),
                        "Intensities ascend, and the rates at which they are exceeded descend; the last two differ.");
}

HazardSpec read_rates(const KeyReader& keys, const std::filesystem::path& beside)
{
    HazardSpec hazard;
    const std::optional<std::string> named = keys.maybe(keys_of::file), site = keys.maybe(keys_of::site);
    const bool power = keys.has(keys_of::k0), points = keys.has(keys_of::intensities), file = named.has_value();
    if (power + points + file != 1)
        keys.refuse_all(fmt::format("survival.hazard has {} hazard curves, not one: give k0_per_year and k, or "
                                    "intensity_m_s2 and rate_per_year, or file",
                                    power + points + file));
    if (keys.has(keys_of::k) != power)
        power ? keys.missing(keys_of::k.name, "It is the slope of the hazard curve, mostly 1 to 4.")
              : keys.refuse(keys_of::k.name, "is not used beside points of a curve", "Remove it.");
    if (site && !file)
        keys.refuse(keys_of::site.name, "is not used without a file", "Remove it.");
    if (keys.has(keys_of::rates) != points)
        points ? keys.missing(keys_of::rates.name, "Give the rate of each of intensity_m_s2.")
               : keys.refuse(keys_of::rates.name, "is not used without intensity_m_s2", "Remove it.");
    keys.read_fields(keys_of::hazard, hazard);
    if (points)
        check_curve(keys, hazard, keys_of::intensities.name.c_str());
    if (file) {
        std::filesystem::path path = *named;
        std::error_code none;
        if (path.is_relative() && std::filesystem::exists(beside / path, none))
            path = beside / path;
        try {
            const HazardModel curve = read_hazard({path.string()}, "pga_m_s2", site);
            hazard.intensity_m_s2 = curve.intensity;
            hazard.rate_per_year = curve.frequency;
        } catch (const InputError& error) {
            const std::string what = error.what();
            throw what.starts_with("--site ") ? InputError("survival.hazard.site = " + what.substr(7)) : error;
        }
    }
    return hazard;
}

/// Structures under one motion, and those that were built alike.
void check_alike(const KeyReader& keys, const KeyReader& study, std::uint64_t realizations,
                 const SurvivalSpec& survival)
{
    if (realizations % survival.per_motion != 0) {
        const std::uint64_t below = realizations / survival.per_motion * survival.per_motion;
        study.refuse("realizations",
                     fmt::format("is no multiple of survival.structures_per_motion = {}", survival.per_motion),
                     below > 0 ? fmt::format("Give {} or {}.", below, below + survival.per_motion)
                               : fmt::format("Give {}.", survival.per_motion));
    }
    if (survival.standing > survival.built)
        keys.refuse(keys_of::standing.name,
                    fmt::format("is above survival.built = {}: more stand than were built", survival.built),
                    "Give how many of those that were built alike stand, this one included.");
    if (survival.built > survival.per_motion)
        keys.refuse(
            keys_of::built.name,
            fmt::format("is above survival.structures_per_motion = {}: structures of one site have been through "
                        "the same motions, and so many of them are needed under each",
                        survival.per_motion),
            fmt::format("Give structures_per_motion = {} or more.", survival.built));
}

/// What several events in succession do not go with.
void check_events(const KeyReader& keys, const Study& study)
{
    const auto refuse = [&](const char* why) {
        keys.refuse(keys_of::events.name, std::string("above 1 is not available with ") + why,
                    "Remove it, or give events = 1.");
    };
    if (study.vertical)
        refuse("a vertical record");
    if (study.names(Mechanism::time_offset) || study.names(Mechanism::harmonic_distortion))
        refuse("mechanisms.time_offset and mechanisms.harmonic_distortion, which belong to one measured motion");
    if (study.excitation.kind == ExcitationKind::harmonic &&
        (study.excitation.start == HarmonicEdge::abrupt || study.excitation.end == HarmonicEdge::abrupt))
        refuse("an abrupt start or end, whose acceleration has no samples");
}

} // namespace

SurvivalSpec read_survival(const KeyReader& top, const Study& study, const std::filesystem::path& beside)
{
    const KeyReader keys = top.table(keys_of::table), axes = top.table("surface");
    SurvivalSpec survival;
    if (study.surface->adaptive)
        axes.refuse("adaptive", "is not used by study.kind = \"survival\"",
                    "Remove it: likelihoods are compared between cells of equally many realizations.");
    if (study.surface->pga_m_s2.count < 3)
        axes.refuse("pga_m_s2", fmt::format("has {} values", study.surface->pga_m_s2.count),
                    "A likelihood over the intensity needs three values at least; eight or more are useful.");
    if (keys.has(keys_of::observed))
        survival.observed = read_observed(keys.table(keys_of::observed), study.structure);
    keys.read_fields(keys_of::table, survival);
    check_alike(keys, top.table("study"), study.realizations, survival);
    if (keys.has(keys_of::hazard))
        survival.hazard = read_rates(keys.table(keys_of::hazard), beside);
    if (survival.stands_for_years && !survival.hazard)
        keys.refuse(keys_of::stands_for.name, "updates the rates of survival.hazard, which is missing",
                    "Give hazard = { k0_per_year = ..., k = ..., sigma_ln = ... }, or remove it.");
    if (survival.prior == PastPrior::hazard && !survival.hazard)
        keys.refuse(keys_of::prior.name, "needs the rates of survival.hazard", "Give hazard, or another prior.");
    if (survival.events > 1)
        check_events(keys, study);
    return survival;
}

} // namespace stylobate
