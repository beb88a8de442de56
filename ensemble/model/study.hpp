#pragma once
/// A study as plain data: the content of a study file, with every default filled in. SI units throughout.
///
/// `io/study/study_file.hpp` fills it from TOML and checks every range; nothing after that checks again.

#include "ensemble/model/kind_settings.hpp"
#include "ensemble/model/mechanism_spec.hpp"
#include "ensemble/model/motion.hpp"
#include "ensemble/model/structure.hpp"
#include "ensemble/model/study_design.hpp"
#include "kernels/planar/step_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// What the uniform numbers of a cell's realizations are (point_set.hpp).
enum class Sampling {
    independent,
    sobol ///< scrambled Sobol points
};

/// How the dashpot coefficients C_N and C_T of Eqs. 1 and 2 depend on the contact.
enum class DampingPer {
    contact, ///< a constant for each pressed contact: Eq. 1 as it stands
    chord    ///< in proportion to the length of the contact: no jump when a sliver of contact appears
};

/// Where the normal dashpot of a contact acts.
enum class DampingAt {
    centroid, ///< the paper's: at the centroid of the overlap
    ends      ///< at the ends of the contact, where it takes up rotation too: `face_damping` 1 in every joint
};

struct ContactSpec {
    ContactForm form = ContactForm::area;
    double normal_stiffness_n_m2 = 0;     ///< K_N, force per overlap area, for the whole depth
    double tangential_stiffness_n_m = 0;  ///< K_T
    double normal_stiffness_n_m3 = 0;     ///< in space instead of K_N: per area of the bed
    double tangential_stiffness_n_m3 = 0; ///< in space instead of K_T: per area of the bed
    double normal_damping_ratio = 0.1;
    double tangential_damping_ratio = 0.1;
    std::optional<double> normal_damping_n_s_m;     ///< C_N itself, instead of the ratio
    std::optional<double> tangential_damping_n_s_m; ///< C_T itself, instead of the ratio
    DampingAt damping = DampingAt::centroid;
    DampingPer damping_per = DampingPer::contact;
    double friction = 0;    ///< mu
    double restitution = 0; ///< of the rigid form, which has no stiffness and no dashpot: those are then 0
    RestitutionLaw restitution_law = RestitutionLaw::newton;
};

enum class ExcitationKind {
    none,
    harmonic,  ///< ramped displacement (kernels/base_motion.hpp)
    half_sine, ///< of acceleration
    full_sine, ///< of acceleration
    ricker,    ///< Ricker's wavelet (synthetic_pulse.hpp)
    pulse,     ///< velocity pulse of Mavroeidis and Papageorgiou (synthetic_pulse.hpp)
    tapered,   ///< harmonic of tapered acceleration (synthetic_sine.hpp)
    sweep,     ///< sine sweep (synthetic_sine.hpp)
    noise,     ///< filtered noise, each realization's own (synthetic_noise.hpp)
    record,
    table ///< samples as they stand: a file of columns, or a run of a measured campaign
};
enum class HarmonicEdge { smooth, abrupt };

/// What the PGA of a synthetic earthquake is.
enum class PgaOf {
    realization, ///< each realization's own peak: all are scaled to it
    mean         ///< the mean of the peaks: one scale for all realizations of a cell, whose peaks differ
};

/// How long a realization is simulated after the shaking, if it does not come to rest before.
enum class Tail {
    structure, ///< long enough for a fall: `tail_after_shaking()`
    rest       ///< until it lies still, at most `longest_tail()`
};

struct ExcitationSpec {
    ExcitationKind kind = ExcitationKind::none;
    double duration_s = 0; ///< `none`: the simulated time; `sweep`: its length

    // all but none; for a surface these two come from the cell (of one over directions the PGA alone)
    double frequency_hz =
        0;               ///< of the sine or pulse; of a half sine, 1 / the full one's period; of noise, the ground's
    double pga_m_s2 = 0; ///< largest acceleration (harmonic: on the plateau); of a record or table 0: as it stands

    // harmonic; ramps, cycles and phase of a tapered one too, ramps of a sweep, phase nu of a pulse
    HarmonicEdge start = HarmonicEdge::smooth;
    HarmonicEdge end = HarmonicEdge::smooth;
    double ramp_cycles = 2; ///< length of a smooth start, and of a smooth end
    double cycles = 10;     ///< in all, ramps included
    double phase_rad = 0;

    // pulse
    double gamma = 2; ///< oscillatory character: cycles under the bell

    // sweep (and duration_s); a surface's frequency axis stretches its time
    double from_hz = 0;
    double to_hz = 0;
    Spacing spacing = Spacing::log; ///< equal times for equal differences, or for equal ratios
    double central_frequency_hz() const { return std::sqrt(from_hz * to_hz); }

    // noise
    PgaOf pga_of = PgaOf::realization;
    double ground_damping_ratio = 0.6;  ///< z_g
    double low_cut_ratio = 0.1;         ///< w_f / w_g
    double low_cut_damping_ratio = 0.6; ///< z_f
    double rise_s = 2;
    double strong_s = 8;
    double decay_s = 3; ///< in which the envelope falls to 1/e

    // record; table: file, run and time_scale
    std::string file; ///< as given in the study; relative to the study file's folder, else to the working folder
    std::optional<std::string> run; ///< of a measured campaign; nullopt: the file is a table
    /// Which one of several in a file, by its name or its column (counted from 1); nullopt: the file has one.
    std::optional<std::string> component;
    std::optional<std::string> unit;   ///< "m/s2", "cm/s2", "mm/s2", "g"; nullopt: the file gives it
    double time_scale = 1;             ///< stretches the record's time; in a surface the frequency axis does this
    bool baseline = true;              ///< correct the record's baseline
    std::optional<BandPass> band_pass; ///< filter it too

    // In space: the motion above is the first component, along `direction_deg`; the second one is horizontal and
    // across it (direction + 90 degrees), the third one is vertical. Angles are in the unit of study files, whose
    // texts must read back to the same bits.
    double direction_deg = 0;      ///< azimuth of the first component, from x towards z; for a surface over
                                   ///< directions it comes from the cell
    double second_ratio = 0;       ///< of a synthetic motion: second over first component; 0: there is none
    double second_phase_deg = 90;  ///< of a harmonic, tapered or pulse: added to the first's phase
    double second_correlation = 0; ///< of noise: of the two components before they are scaled
    double vertical_ratio = 0;     ///< vertical over first component; 0: there is none, or it is `Study::vertical`
    std::optional<ComponentSpec> second; ///< of a record or table
    OfPair pga_of_pair = OfPair::first;  ///< what `pga_m_s2` is of two components

    std::optional<double> tail_s; ///< simulated at most after the shaking; none: as `tail` says
    Tail tail = Tail::structure;  ///< in a study file `rest` is the default of kinds that report what remains

    /// Whether it has a second horizontal component.
    bool has_second() const { return second_ratio > 0 || second.has_value(); }
    friend bool operator==(const ExcitationSpec&, const ExcitationSpec&) = default;
};

/// What can be perturbed. The names in study files are the enumerators' names.
enum class Quantity {
    friction,             ///< mu; per joint or structure
    normal_stiffness,     ///< K_N; per joint or structure
    tangential_stiffness, ///< K_T; per joint or structure
    damping_ratio,        ///< both damping ratios at once; per structure
    drum_width,           ///< B, of an epistyle its length; per block or structure
    drum_height,          ///< H; per block or structure
    drum_offset,          ///< of a drum from its column's axis, of an epistyle from its place; per block
    density,              ///< mass at given sizes; per block or structure
    tilt,                 ///< of the base, out of level; per structure [rad]
    phase,                ///< of the harmonic or pulse; per structure [rad]
    pulse_frequency,      ///< of a velocity pulse; per structure [Hz]
    pulse_gamma,          ///< oscillatory character of a velocity pulse; per structure
    direction,            ///< of the shaking in space; per structure [degrees, as in study files]
    // in space, drawn with the quantity of the other direction, from the same distribution
    drum_offset_z, ///< `drum_offset` along z; per block
    tilt_x         ///< of the base about x (`tilt` is about z); per structure [rad]
};
inline constexpr int quantity_count = 15;
inline constexpr int perturbable_count = 13; ///< the first ones: those that a study file names
const char* to_string(Quantity quantity);

enum class DistributionKind { normal, lognormal, uniform, log_uniform };
enum class Per { joint, block, structure };

/// A distribution. Three ways of reading the drawn number z:
///   normal      value = nominal + N(0, sd), or nominal * (1 + N(0, cov)) where cov is given
///   lognormal   value = nominal * exp(N(0, sigma_ln))
///   uniform     value ~ U(from, to): replaces the nominal value
///   log_uniform ln value ~ U(ln from, ln to): replaces the nominal value
/// `min` and `max` truncate the distribution of the value itself (not clip: no mass at the ends).
/// Where nominal values differ from block to block or bed to bed, each has its own distribution; drawn once for the
/// structure, all take the same quantile of theirs.
struct Spread {
    DistributionKind distribution = DistributionKind::normal;
    Per per = Per::structure;
    double sd = 0;       ///< normal, in the quantity's unit
    double cov = 0;      ///< normal, relative to the nominal value
    double sigma_ln = 0; ///< lognormal
    double from = 0;     ///< uniform, log_uniform
    double to = 0;       ///< uniform, log_uniform
    std::optional<double> min;
    std::optional<double> max;

    friend bool operator==(const Spread&, const Spread&) = default;
};

/// One perturbed quantity.
struct Perturbation : Spread {
    Quantity quantity = Quantity::friction;

    friend bool operator==(const Perturbation&, const Perturbation&) = default;
};

/// One perturbed parameter of a mechanism that the study names, at each place where it acts.
struct MechanismPerturbation : Spread {
    Mechanism mechanism = Mechanism::stribeck;
    std::size_t parameter = 0; ///< of the mechanism's rule
};

/// The vertical motion of the base, where it is a record of its own: corrected as one, in the time and size of the
/// horizontal record or table where there is one, else as it stands.
struct VerticalSpec : ComponentSpec {
    bool baseline = true;
};

/// The structure leaned as one rigid body about a corner, or in space about the rim of a face, and raised; of a
/// colonnade each column alike, and the epistyles ride on them.
struct InitialSpec {
    double tilt_rad = 0; ///< > 0 counter-clockwise; in space towards `tilt_direction_rad`
    /// In space: azimuth towards which it leans, from x towards z; pi is to the left, as counter-clockwise in the
    /// plane.
    double tilt_direction_rad = std::numbers::pi;
    int tilt_from_block = 0; ///< of each column, from the bottom: it and all above it lean about its lower corner
    double lift_m = 0;       ///< in the plane: the same part is held so high above its bed until the start
};

struct OutputSpec {
    double trajectory_rate_hz = 1000; ///< in a study file the default is `usual_trajectory_rate_hz`
    /// Number of realizations of a single study, the first ones, whose trajectories are kept; none: as many as
    /// `most_mb` holds.
    std::optional<std::uint64_t> trajectories = {};
    double most_mb = 100; ///< of trajectories in a results file, in 1e6 bytes

    static constexpr std::uint64_t all = ~std::uint64_t{0}; ///< trajectories
};

/// How long a realization is followed.
enum class Follow {
    collapse, ///< until a block has fallen
    rest      ///< until all fallen blocks are at rest: partial and total collapse, and their order
};

struct OutcomeSpec {
    Follow follow = Follow::collapse;      ///< in a study file `rest` is the default of a colonnade
    double collapse_height_fraction = 0.6; ///< a drum's centre below this part of its rest height: collapse
    double rocking_threshold_rad = 0.01;   ///< largest relative rotation below which a column has not rocked
    double sliding_threshold = 0.005;      ///< total sliding over drum width below which a column has not slid
};

/// From what the safe bound of the step is taken (`step_bound.hpp`).
enum class StepBasis {
    block,    ///< each block by itself, held by its neighbours
    structure ///< the whole structure: a longer step
};

/// What the steps are computed in.
enum class Precision {
    double_, ///< 53 binary digits
    single   ///< 24, with compensated sums: the paper's model alone, about twice as fast (docs/precision.md)
};

struct RunSpec {
    Precision precision = Precision::double_;
    double step_fraction = 0.9; ///< of the safe bound of each realization (see README.md of this folder)
    StepBasis step_bound = StepBasis::block;
    std::optional<double> step_s; ///< a fixed step instead
    /// Largest change of a collapse probability by the numerics, which are chosen for it where the study gives none
    /// (`Study::chosen`).
    std::optional<double> accuracy;
    bool allow_step_above_bound = false; ///< run such a step all the same
    double max_invalid_fraction = 0.001; ///< more invalid realizations than this: exit status 3
};

/// A part of the numerics that `run.accuracy` has chosen, because the study does not give it.
struct NumericsChoice {
    std::string key;    ///< "contact.form"
    std::string value;  ///< as in a study file
    std::string reason; ///< a sentence without its full stop
};

/// What a results file holds of the realizations.
enum class KeptRealizations {
    all, ///< a row of each
    none ///< of a surface: counts alone, so that the file does not grow with their number
};

struct Study {
    StudyKind kind = StudyKind::single;
    std::optional<std::string> title; ///< of its pictures and pages; nullopt: they bear the name of the results' file
    std::uint64_t seed = 1;
    /// Per cell of a surface; under a motion in a stripe; of a single study, in all; not used by other kinds.
    std::uint64_t realizations = 1;
    Sampling sampling = Sampling::independent;
    KeptRealizations kept = KeptRealizations::all;
    std::vector<std::string> allow; ///< checks that this study is meant to fail (plausible.hpp), in their order

    StructureSpec structure;
    ContactSpec contact;
    ExcitationSpec excitation;
    std::optional<SurfaceSpec> surface;
    std::optional<FragilitySpec> fragility;
    std::optional<FactorDesign> sensitivity;
    std::optional<RareSpec> rare;
    std::optional<SurvivalSpec> survival;    ///< beside `surface`, which has its axes
    std::optional<ReplicasSpec> replicas;    ///< of a surface
    std::vector<Perturbation> perturbations; ///< at most one for each quantity, in the order of the enumeration
    std::vector<MechanismSpec> mechanisms;   ///< in the order of the enumeration, then of their first places
    std::optional<VerticalSpec> vertical;
    /// At most one for each parameter, in the order of the enumeration and the parameters.
    std::vector<MechanismPerturbation> mechanism_perturbations;
    InitialSpec initial;
    OutputSpec output;
    OutcomeSpec outcome;
    RunSpec run;

    std::vector<NumericsChoice> chosen; ///< by `run.accuracy`; in the text they are values like others
    /// Whether it was chosen, by its key.
    bool chose(const std::string& key) const
    {
        return std::any_of(chosen.begin(), chosen.end(), [&](const NumericsChoice& one) { return one.key == key; });
    }

    std::string text; ///< canonical TOML of all the above: two studies are the same if this is

    /// Whether it allows what a check of this name refuses or warns of.
    bool allows(const std::string& check) const { return std::find(allow.begin(), allow.end(), check) != allow.end(); }

    /// Whether it names the mechanism.
    bool names(Mechanism mechanism) const
    {
        return std::any_of(mechanisms.begin(), mechanisms.end(),
                           [mechanism](const MechanismSpec& spec) { return spec.mechanism == mechanism; });
    }
    /// Whether any of its motions has a second horizontal component.
    bool has_pairs() const
    {
        return excitation.has_second() ||
               (fragility && std::any_of(fragility->records.begin(), fragility->records.end(),
                                         [](const RecordSpec& record) { return record.second.has_value(); }));
    }
    /// Which realizations it has and what they share. It refers to this study.
    StudyDesign design() const;
    // What is asked of it most often.
    std::uint64_t cells() const { return design().cells; }
    int events() const { return design().events; }
    std::uint64_t originals() const { return design().originals(); }
    std::uint64_t total() const { return design().total(); }
    std::uint64_t original(std::uint64_t index) const { return design().original(index); }
    const Replica* replica(std::uint64_t index) const { return design().replica(index); }
    std::uint64_t cell(std::uint64_t index) const { return design().cell(index); }

    /// So many realizations of its structure under its excitation, and nothing of its kind.
    Study as_single(std::uint64_t count) const;
    /// Its originals alone.
    Study without_replicas() const;
};

/// Default sampling rate of a trajectory: 100 times in 2 pi / p, p = sqrt(3 g / (4 R)) of the free
/// block that rocks fastest, R half its diagonal; 20 times in a period of the fastest shaking whose frequency the study
/// gives; and 100 times a second, since records have little above 25 Hz. Rounded up to whole tens.
double usual_trajectory_rate_hz(const Study& study);

} // namespace stylobate
