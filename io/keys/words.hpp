#pragma once
/// The words of the study file for the enumerations of a study, in the order of their enumerators: read and written
/// from the same lists.

#include "ensemble/model/study.hpp"
#include "io/files/key_reader.hpp"

namespace stylobate {

inline constexpr auto study_kind_names =
    words_of<StudyKind>("single", "surface", "fragility", "sensitivity", "rare", "survival");
inline constexpr auto past_prior_names = words_of<PastPrior>("log_uniform", "uniform", "hazard");
inline constexpr auto fragility_method_names = words_of<FragilityMethod>("stripes", "cloud");
inline constexpr auto intensity_measure_names = words_of<IntensityMeasure>("pga", "pgv", "pgd", "arias", "cav", "sa");
inline constexpr auto sensitivity_method_names = words_of<SensitivityMethod>("sobol", "morris");
inline constexpr auto sampling_names = words_of<Sampling>("independent", "sobol");
inline constexpr auto structure_kind_names = words_of<StructureKind>("column", "colonnade");
inline constexpr auto precision_names = words_of<Precision>("double", "single");
inline constexpr auto follow_names = words_of<Follow>("collapse", "rest");
inline constexpr auto excitation_kind_names = words_of<ExcitationKind>(
    "none", "harmonic", "half_sine", "full_sine", "ricker", "pulse", "tapered", "sweep", "noise", "record", "table");
inline constexpr auto edge_names = words_of<HarmonicEdge>("smooth", "abrupt");
inline constexpr auto pga_of_names = words_of<PgaOf>("realization", "mean");
inline constexpr auto damping_at_names = words_of<DampingAt>("centroid", "ends");
inline constexpr auto contact_form_names = words_of<ContactForm>("area", "two_corner", "points", "rigid");
inline constexpr auto restitution_law_names = words_of<RestitutionLaw>("newton", "poisson");
inline constexpr auto damping_per_names = words_of<DampingPer>("contact", "chord");
inline constexpr auto step_basis_names = words_of<StepBasis>("block", "structure");
inline constexpr auto spacing_names = words_of<Spacing>("linear", "log");
inline constexpr auto kept_realizations_names = words_of<KeptRealizations>("all", "none");
inline constexpr auto tail_names = words_of<Tail>("structure", "rest");
inline constexpr auto distribution_names = words_of<DistributionKind>("normal", "lognormal", "uniform", "log_uniform");
inline constexpr const char* trajectories_fit = "fit"; ///< as many as most_mb holds
inline constexpr const char* trajectories_all = "all";

} // namespace stylobate
