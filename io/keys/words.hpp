#pragma once
/// The words of the study file for the enumerations of a study: read and written from the same lists.

#include "ensemble/model/study.hpp"
#include "io/files/toml_key.hpp"

#include <array>

namespace stylobate {

inline constexpr std::array study_kind_names = {
    Name<StudyKind>{"single", StudyKind::single},       Name<StudyKind>{"surface", StudyKind::surface},
    Name<StudyKind>{"fragility", StudyKind::fragility}, Name<StudyKind>{"sensitivity", StudyKind::sensitivity},
    Name<StudyKind>{"rare", StudyKind::rare},           Name<StudyKind>{"survival", StudyKind::survival}};
inline constexpr std::array past_prior_names = {Name<PastPrior>{"log_uniform", PastPrior::log_uniform},
                                                Name<PastPrior>{"uniform", PastPrior::uniform},
                                                Name<PastPrior>{"hazard", PastPrior::hazard}};
inline constexpr std::array fragility_method_names = {Name<FragilityMethod>{"stripes", FragilityMethod::stripes},
                                                      Name<FragilityMethod>{"cloud", FragilityMethod::cloud}};
inline constexpr std::array intensity_measure_names = {
    Name<IntensityMeasure>{"pga", IntensityMeasure::pga}, Name<IntensityMeasure>{"pgv", IntensityMeasure::pgv},
    Name<IntensityMeasure>{"pgd", IntensityMeasure::pgd}, Name<IntensityMeasure>{"arias", IntensityMeasure::arias},
    Name<IntensityMeasure>{"cav", IntensityMeasure::cav}, Name<IntensityMeasure>{"sa", IntensityMeasure::sa}};
inline constexpr std::array sensitivity_method_names = {Name<SensitivityMethod>{"sobol", SensitivityMethod::sobol},
                                                        Name<SensitivityMethod>{"morris", SensitivityMethod::morris}};
inline constexpr std::array sampling_names = {Name<Sampling>{"independent", Sampling::independent},
                                              Name<Sampling>{"sobol", Sampling::sobol}};
inline constexpr std::array structure_kind_names = {Name<StructureKind>{"column", StructureKind::column},
                                                    Name<StructureKind>{"colonnade", StructureKind::colonnade}};
inline constexpr std::array precision_names = {Name<Precision>{"double", Precision::double_},
                                               Name<Precision>{"single", Precision::single}};
inline constexpr std::array follow_names = {Name<Follow>{"collapse", Follow::collapse},
                                            Name<Follow>{"rest", Follow::rest}};
inline constexpr std::array excitation_kind_names = {Name<ExcitationKind>{"none", ExcitationKind::none},
                                                     Name<ExcitationKind>{"harmonic", ExcitationKind::harmonic},
                                                     Name<ExcitationKind>{"half_sine", ExcitationKind::half_sine},
                                                     Name<ExcitationKind>{"full_sine", ExcitationKind::full_sine},
                                                     Name<ExcitationKind>{"ricker", ExcitationKind::ricker},
                                                     Name<ExcitationKind>{"pulse", ExcitationKind::pulse},
                                                     Name<ExcitationKind>{"tapered", ExcitationKind::tapered},
                                                     Name<ExcitationKind>{"sweep", ExcitationKind::sweep},
                                                     Name<ExcitationKind>{"noise", ExcitationKind::noise},
                                                     Name<ExcitationKind>{"record", ExcitationKind::record},
                                                     Name<ExcitationKind>{"table", ExcitationKind::table}};
inline constexpr std::array edge_names = {Name<HarmonicEdge>{"smooth", HarmonicEdge::smooth},
                                          Name<HarmonicEdge>{"abrupt", HarmonicEdge::abrupt}};
inline constexpr std::array pga_of_names = {Name<PgaOf>{"realization", PgaOf::realization},
                                            Name<PgaOf>{"mean", PgaOf::mean}};
inline constexpr std::array damping_at_names = {Name<DampingAt>{"centroid", DampingAt::centroid},
                                                Name<DampingAt>{"ends", DampingAt::ends}};
inline constexpr std::array contact_form_names = {
    Name<ContactForm>{"area", ContactForm::area}, Name<ContactForm>{"two_corner", ContactForm::two_corner},
    Name<ContactForm>{"points", ContactForm::points}, Name<ContactForm>{"rigid", ContactForm::rigid}};
inline constexpr std::array restitution_law_names = {Name<RestitutionLaw>{"newton", RestitutionLaw::newton},
                                                     Name<RestitutionLaw>{"poisson", RestitutionLaw::poisson}};
inline constexpr std::array damping_per_names = {Name<DampingPer>{"contact", DampingPer::contact},
                                                 Name<DampingPer>{"chord", DampingPer::chord}};
inline constexpr std::array step_basis_names = {Name<StepBasis>{"block", StepBasis::block},
                                                Name<StepBasis>{"structure", StepBasis::structure}};
inline constexpr std::array spacing_names = {Name<Spacing>{"linear", Spacing::linear},
                                             Name<Spacing>{"log", Spacing::log}};
inline constexpr std::array kept_realizations_names = {Name<KeptRealizations>{"all", KeptRealizations::all},
                                                       Name<KeptRealizations>{"none", KeptRealizations::none}};
inline constexpr const char* trajectories_fit = "fit"; ///< as many as most_mb holds
inline constexpr const char* trajectories_all = "all";
inline constexpr std::array tail_names = {Name<Tail>{"structure", Tail::structure}, Name<Tail>{"rest", Tail::rest}};
inline constexpr std::array distribution_names = {Name<DistributionKind>{"normal", DistributionKind::normal},
                                                  Name<DistributionKind>{"lognormal", DistributionKind::lognormal},
                                                  Name<DistributionKind>{"uniform", DistributionKind::uniform},
                                                  Name<DistributionKind>{"log_uniform", DistributionKind::log_uniform}};
inline constexpr std::array per_names = {Name<Per>{"joint", Per::joint}, Name<Per>{"block", Per::block},
                                         Name<Per>{"structure", Per::structure}};

/// The study file's key for the standard deviation of a quantity: its unit is part of it.
constexpr const char* sd_key(Quantity quantity)
{
    switch (quantity) {
    case Quantity::normal_stiffness:
        return "sd_n_m2";
    case Quantity::tangential_stiffness:
        return "sd_n_m";
    case Quantity::drum_width:
    case Quantity::drum_height:
    case Quantity::drum_offset:
        return "sd_m";
    case Quantity::density:
        return "sd_kg_m3";
    case Quantity::tilt:
    case Quantity::phase:
        return "sd_rad";
    case Quantity::pulse_frequency:
        return "sd_hz";
    case Quantity::friction:
    case Quantity::damping_ratio:
    case Quantity::pulse_gamma:
        break;
    }
    return "sd";
}

} // namespace stylobate
