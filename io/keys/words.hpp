#pragma once
/// The words of the study file for the enumerations of a study, in the order of their enumerators: read and written
/// from the same lists.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"

#include <algorithm>
#include <initializer_list>

namespace stylobate {

inline constexpr auto study_kind_names =
    word_list<StudyKind>("single", "surface", "fragility", "sensitivity", "rare", "survival");
inline constexpr auto past_prior_names = word_list<PastPrior>("log_uniform", "uniform", "hazard");
inline constexpr auto fragility_method_names = word_list<FragilityMethod>("stripes", "cloud");
inline constexpr auto intensity_measure_names = word_list<IntensityMeasure>("pga", "pgv", "pgd", "arias", "cav", "sa");
inline constexpr auto sensitivity_method_names = word_list<SensitivityMethod>("sobol", "morris");
inline constexpr auto sampling_names = word_list<Sampling>("independent", "sobol");
inline constexpr auto structure_kind_names = word_list<StructureKind>("column", "colonnade");
inline constexpr auto shape_names = word_list<Shape>("round", "square", "rectangle");
inline constexpr auto along_names = word_list<Along>("x", "z");
inline constexpr auto precision_names = word_list<Precision>("double", "single");
inline constexpr auto follow_names = word_list<Follow>("collapse", "rest");
inline constexpr auto excitation_kind_names = word_list<ExcitationKind>(
    "none", "harmonic", "half_sine", "full_sine", "ricker", "pulse", "tapered", "sweep", "noise", "record", "table");
inline constexpr auto edge_names = word_list<HarmonicEdge>("smooth", "abrupt");
inline constexpr auto pga_of_names = word_list<PgaOf>("realization", "mean");
inline constexpr auto of_pair_names = word_list<OfPair>("first", "larger", "geometric_mean", "at_once");
inline constexpr auto damping_at_names = word_list<DampingAt>("centroid", "ends");
inline constexpr auto contact_form_names = word_list<ContactForm>("area", "two_corner", "points", "rigid");
inline constexpr auto restitution_law_names = word_list<RestitutionLaw>("newton", "poisson");
inline constexpr auto damping_per_names = word_list<DampingPer>("contact", "chord");
inline constexpr auto step_basis_names = word_list<StepBasis>("block", "structure");
inline constexpr auto spacing_names = word_list<Spacing>("linear", "log");
inline constexpr auto kept_realizations_names = word_list<KeptRealizations>("all", "none");
inline constexpr auto tail_names = word_list<Tail>("structure", "rest");
inline constexpr auto distribution_names = word_list<DistributionKind>("normal", "lognormal", "uniform", "log_uniform");
inline constexpr const char* trajectories_fit = "fit"; ///< as many as most_mb holds
inline constexpr const char* trajectories_all = "all";

// Conditions under which a key is used, in the words of the study file.

/// Where the key has one of these words.
template <class List, class Enum>
Condition where(const char* key, const List& names, std::initializer_list<Enum> values)
{
    Condition condition{key, {}};
    for (const Enum value : values)
        condition.values.emplace_back(word_for(names, value));
    return condition;
}
/// Where it has another one.
template <class List, class Enum>
Condition where_not(const char* key, const List& names, std::initializer_list<Enum> values)
{
    Condition condition{key, {}};
    for (const auto& name : names)
        if (std::find(values.begin(), values.end(), name.value) == values.end())
            condition.values.emplace_back(name.word);
    return condition;
}

inline Condition in_studies(std::initializer_list<StudyKind> kinds)
{
    return where("study.kind", study_kind_names, kinds);
}
inline Condition not_in_studies(std::initializer_list<StudyKind> kinds)
{
    return where_not("study.kind", study_kind_names, kinds);
}

inline Condition for_motions(std::initializer_list<ExcitationKind> kinds)
{
    return where("excitation.kind", excitation_kind_names, kinds);
}
inline Condition not_for_motions(std::initializer_list<ExcitationKind> kinds)
{
    return where_not("excitation.kind", excitation_kind_names, kinds);
}

/// The value of `model_key`.
inline const char* dimensions_word(const StructureSpec& structure)
{
    return structure.spatial() ? "3" : "2";
}
/// Of a key that studies in space alone use.
inline std::vector<std::string> in_space()
{
    return {model_names[1]};
}

/// Of a key that studies in the plane alone use.
inline std::vector<std::string> in_plane()
{
    return {model_names[0]};
}

inline Condition with_rigid_contacts()
{
    return where("contact.form", contact_form_names, {ContactForm::rigid});
}
/// Forms whose contacts yield: what has springs, dashpots and a step that must resolve their vibration.
inline Condition compliant()
{
    return where_not("contact.form", contact_form_names, {ContactForm::rigid});
}

// Of a study with [surface] the axis of its rows gives the frequency, or in space the direction.

inline Condition without_frequencies()
{
    return {"surface.frequency_hz", {key_absent}};
}
inline Condition without_directions()
{
    return {"surface.direction_deg", {key_absent}};
}
/// @param directions whether the rows are directions
inline void add_rows(KeyUse& use, bool directions)
{
    use.kinds.emplace("surface.frequency_hz", directions ? key_absent : key_given);
    use.kinds.emplace("surface.direction_deg", directions ? key_given : key_absent);
}

/// What the kinds of a study let its keys be used for.
inline KeyUse key_use(const Study& study)
{
    KeyUse use{{{"study.kind", word_for(study_kind_names, study.kind)},
                {"structure.kind", word_for(structure_kind_names, study.structure.kind)},
                {model_key, dimensions_word(study.structure)},
                {"contact.form", word_for(contact_form_names, study.contact.form)},
                {"excitation.kind", word_for(excitation_kind_names, study.excitation.kind)}}};
    if (study.fragility)
        use.kinds.emplace("fragility.method", word_for(fragility_method_names, study.fragility->method));
    if (has_axes(study.kind))
        add_rows(use, study.surface && study.surface->direction_deg);
    return use;
}

} // namespace stylobate
