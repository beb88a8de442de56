#pragma once
/// A study as plain data: the content of a study file, with every default filled in. SI units throughout.
///
/// `io/study/study_file.hpp` fills it from TOML and checks every range; nothing after that checks again.

#include "ensemble/model/mechanism_spec.hpp"
#include "ensemble/model/motion.hpp"
#include "ensemble/model/structure.hpp"
#include "kernels/planar/step_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

enum class StudyKind {
    single,
    surface,
    fragility,   ///< many motions, each scaled to given intensities: probabilities of damage and their curves
    sensitivity, ///< which of the perturbed quantities the outcomes depend on
    rare,        ///< a probability of collapse too small to be counted
    survival     ///< past shaking, inferred from the state of a structure
};

/// Whether frequency and PGA are those of the cells of [surface].
constexpr bool has_axes(StudyKind kind)
{
    return kind == StudyKind::surface || kind == StudyKind::survival;
}

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
    double normal_stiffness_n_m2 = 0;    ///< K_N, force per overlap area, for the whole depth
    double tangential_stiffness_n_m = 0; ///< K_T
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

enum class Spacing { linear, log };

/// How long a realization is simulated after the shaking, if it does not come to rest before.
enum class Tail {
    structure, ///< long enough for a fall: `tail_after_shaking()`
    rest       ///< until it lies still, at most `longest_tail()`
};

struct ExcitationSpec {
    ExcitationKind kind = ExcitationKind::none;
    double duration_s = 0; ///< `none`: the simulated time; `sweep`: its length

    // all but none; for a surface these two come from the cell
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
    std::string file;      ///< as given in the study; relative to the study file's folder, else to the working folder
    std::string run;       ///< of a measured campaign
    std::string component; ///< which one, where a file has several: its name or its column (counted from 1)
    std::string unit;      ///< "m/s2", "cm/s2", "mm/s2", "g" or empty (the file gives it)
    double time_scale = 1; ///< stretches the record's time; in a surface the frequency axis does this
    bool baseline = true;  ///< correct the record's baseline
    std::optional<BandPass> band_pass; ///< filter it too

    std::optional<double> tail_s; ///< simulated at most after the shaking; none: as `tail` says
    Tail tail = Tail::structure;  ///< in a study file `rest` is the default of kinds that report what remains

    friend bool operator==(const ExcitationSpec&, const ExcitationSpec&) = default;
};

struct Axis {
    double from = 0;
    double to = 0;
    int count = 0;
    Spacing spacing = Spacing::linear;

    /// The i-th of `count` values; the first and last are exactly `from` and `to`.
    double value(int i) const;
};

/// Confidence of the intervals of an adaptive surface.
inline constexpr double adaptive_level = 0.95;

/// Realizations where they are needed (ensemble/estimators/surface/adaptive.hpp), instead of equal numbers in each
/// cell.
struct AdaptiveSpec {
    std::uint64_t budget = 0;  ///< realizations of the whole surface, at most
    std::uint64_t minimum = 8; ///< of each cell
    double half_width = 0.05;  ///< that each cell's interval is to have
    bool borrow = true;        ///< from neighbouring cells
};

struct SurfaceSpec {
    Axis frequency_hz; ///< nf rows
    Axis pga_m_s2;     ///< np columns
    std::optional<AdaptiveSpec> adaptive = {};
    int cells() const { return frequency_hz.count * pga_m_s2.count; }
};

/// Which motions a fragility study has, and how strong.
enum class FragilityMethod {
    stripes, ///< every motion scaled to each intensity of an axis
    cloud    ///< every motion once, as it was recorded
};

/// By which measure motions are scaled.
enum class IntensityMeasure { pga, pgv, pgd, arias, cav, sa };

/// A ground motion of a fragility study, as files hold it.
struct RecordSpec {
    std::string file;
    std::string component; ///< empty: the only one there is
    std::string unit;      ///< empty: the file gives it
    friend bool operator==(const RecordSpec&, const RecordSpec&) = default;
};

/// A fragility study: motions x stripes x structures, `Study::realizations` structures under each motion in each
/// stripe. The structures of a motion are the same in all its stripes (an incremental dynamic analysis of each), and
/// others than those of another motion.
struct FragilitySpec {
    FragilityMethod method = FragilityMethod::stripes;
    std::vector<RecordSpec> records; ///< of an excitation "record", else none
    /// Files of the folder that hold no accelerations, and its vertical components: not part of the study, for
    /// messages.
    std::vector<std::string> left_out = {};
    int motions = 0; ///< those of the records, or as many drawn from the seed
    IntensityMeasure measure = IntensityMeasure::pga;
    double period_s = 1; ///< of `sa`
    Axis intensity;      ///< of `stripes`; in the measure's unit
    double scale = 1;    ///< of `cloud`: factor on every motion

    // Number of earthquakes in succession, each with the intensity of its stripe; each begins from the state that the
    // one before has left.
    int shakings = 1;
    std::optional<double> pause_s; ///< between two of them; none: `pause_until_rest_s` of the nominal structure

    // Where the scatter comes from: of the structures of a motion, every `contacts` x `twins` have the same
    // imperfections, and every `twins` of these the same contacts too.
    int contacts = 1;
    int twins = 1;
    double twin_m = 1e-9; ///< standard deviation of what twins differ by: the place of each drum

    std::vector<double> peak_limits = {0.15, 0.35, 1};         ///< of the top's displacement over the column's width
    std::vector<double> residual_limits = {0.005, 0.01, 0.02}; ///< of a joint's dislocation over its width
    std::vector<double> periods_s = {0.5, 1, 2};               ///< at which spectral accelerations are measured

    int stripes() const { return method == FragilityMethod::cloud ? 1 : intensity.count; }
};

enum class SensitivityMethod {
    sobol, ///< shares of the variance (estimators/designs/sobol_indices.hpp): points A, B, A_1 ... of each row
    morris ///< screening (estimators/designs/sobol_indices.hpp): points A, A_1 ...
};

/// A design of the factors: rows of points, and at each point some realizations that differ in all that is no factor,
/// the same way at all points of a row. Realizations are counted row by row, point by point.
struct SensitivitySpec {
    SensitivityMethod method = SensitivityMethod::sobol;
    std::uint64_t samples = 0;        ///< rows
    std::uint64_t inner = 1;          ///< realizations at each point
    std::vector<std::string> factors; ///< perturbed quantities, by the names of the inputs; in the order of the inputs

    struct Place {
        std::uint64_t row = 0;
        std::uint64_t point = 0; ///< A is 0
        std::uint64_t draw = 0;  ///< of the rest
    };
    /// Number of the first of the points A_k.
    std::uint64_t first_changed() const { return method == SensitivityMethod::sobol ? 2 : 1; }
    std::uint64_t points() const { return factors.size() + first_changed(); }
    std::uint64_t total() const { return samples * points() * inner; }
    Place place(std::uint64_t index) const
    {
        return {index / (points() * inner), index / inner % points(), index % inner};
    }
};

/// Subset simulation (estimators/designs/subset_simulation.hpp), repeated for its interval.
struct RareSpec {
    std::uint64_t samples = 1000; ///< at each level
    std::uint64_t repeats = 10;
    static constexpr double level_probability = 0.1;
    static constexpr std::uint64_t most_levels = 10; ///< beyond the first one
    /// The pilot, which is number 0, and the repeats after it.
    std::uint64_t simulations() const { return repeats + 1; }
    /// A realization's index is the number of its simulation x this + its number in it.
    static constexpr std::uint64_t indices_of_simulation = std::uint64_t{1} << 32;
    /// Upper bound of its realizations.
    std::uint64_t most() const { return simulations() * samples * (most_levels + 1); }
};

/// The density of the prior over the intensity of the past shaking.
enum class PastPrior {
    log_uniform, ///< equal probability for equal ratios
    uniform,     ///< equal probability for equal differences
    hazard       ///< in proportion to the rate at which the hazard of the study has such shakings
};

/// The state in which a structure is found, as far as it was measured. A state agrees with it where every measured
/// value is met within its tolerance.
struct ObservedState {
    std::vector<int> joints;          ///< that were measured, counted as the beds of `lay_out`, ascending
    std::vector<double> offset_m;     ///< (joints) how far the faces lie from where they lay when it was built
    double tolerance_m = 0;           ///< largest difference between the true and the measured offset
    std::vector<double> rotation_rad; ///< (free blocks) from upright; empty: not measured
    double tolerance_rad = 0;
    bool mirrored = false; ///< the sense of the shaking is unknown: the mirrored state agrees too
};

/// Rates of exceedance of the intensity, and their uncertainty.
struct HazardSpec {
    double k0_per_year = 0; ///< H(a) = k0 a^-k, a in m/s2; 0: the points
    double k = 0;
    std::vector<double> intensity_m_s2; ///< ascending; between them H is a power law
    std::vector<double> rate_per_year;  ///< descending
    double sigma_ln = 0;                ///< of the factor on all rates, lognormal about 1
};

/// Inference from the survival of a structure. Of each cell of [surface] the study has `Study::realizations` with one
/// event, then as many with two in succession, up to `events`.
struct SurvivalSpec {
    std::optional<ObservedState> observed = {}; ///< none: it is only known that it stands
    PastPrior prior = PastPrior::log_uniform;
    double level = 0.95;           ///< of exclusions and credible intervals
    int events = 1;                ///< largest number, equally strong
    std::optional<double> pause_s; ///< between two of them; none: `pause_until_rest_s` of each realization
    std::uint64_t monuments = 200; ///< simulated ones by which the intervals are calibrated and tested
    /// Structures of one site share the seed, and so their shaking; each draws its own properties by its number.
    std::uint64_t structure = 1;
    std::uint64_t per_motion = 1; ///< so many realizations of a cell, in succession, have the same motion
    /// Alike structures that were built at the site, and how many of them stand; the observed one is among these.
    std::uint64_t built = 1, standing = 1;
    std::optional<double> stands_for_years = {};
    std::optional<HazardSpec> hazard = {};
};

/// The property in which the replica of a realization differs.
enum class ReplicaBy {
    move,      ///< the place of one drum
    step,      ///< the time step
    precision, ///< stepped in single precision
    form       ///< the contact form
};

/// One kind of replica: the same realization in all draws, except for one property.
struct Replica {
    ReplicaBy by = ReplicaBy::move;
    double size = 0; ///< move: how far to the right [m]; step: times the realization's own
    ContactForm form = ContactForm::area;
    friend bool operator==(const Replica&, const Replica&) = default;
};

/// Twins of every realization of a surface: how reliable a verdict is, and what decides it
/// (ensemble/replicas/replicas.hpp).
struct ReplicasSpec {
    std::vector<Replica> kinds; ///< moves, then the step, the precision and the forms
    int block = 0;              ///< the drum that is moved, in layout order
    /// Number of realizations of each cell, the first ones, whose displaced replicas are followed step by step.
    std::uint64_t followed = 8;
    double tolerance = 0.01; ///< predictable as long as replicas are closer than this part of the drums' width
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
    pulse_gamma           ///< oscillatory character of a velocity pulse; per structure
};
inline constexpr int quantity_count = 12;
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
struct VerticalSpec {
    std::string file;
    std::string component;
    std::string unit;
    bool baseline = true;
};

/// The structure leaned as one rigid body about a corner; of a colonnade each column alike, and the epistyles ride on
/// them.
struct InitialSpec {
    double tilt_rad = 0;     ///< > 0 counter-clockwise
    int tilt_from_block = 0; ///< of each column, from the bottom: it and all above it lean about its lower corner
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
    std::string title; ///< of its pictures and pages; empty: they bear the name of the results' file
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
    std::optional<SensitivitySpec> sensitivity;
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
    /// Parts of as many realizations each: those of a surface, or motions x stripes.
    std::uint64_t cells() const
    {
        if (surface)
            return static_cast<std::uint64_t>(surface->cells());
        if (fragility)
            return static_cast<std::uint64_t>(fragility->motions) * static_cast<std::uint64_t>(fragility->stripes());
        return 1;
    }
    /// Most events that a realization is shaken by, one after the other.
    int events() const { return survival ? survival->events : 1; }
    /// How many shake this one.
    int events(std::uint64_t index) const
    {
        return survival ? 1 + static_cast<int>(index / (realizations * cells())) : 1;
    }
    /// Realizations that are not perturbed replicas, under one event.
    std::uint64_t originals() const { return replicas || events() > 1 ? realizations * cells() : total(); }
    /// Realizations of the whole study. Of a surface with replicas: the originals, then all replicas of the first kind
    /// in the same order, and so on; of a survival study those of one event, then those of two, and so on.
    std::uint64_t total() const
    {
        if (sensitivity)
            return sensitivity->total();
        if (rare)
            return rare->simulations() * RareSpec::indices_of_simulation;
        return realizations * cells() *
               (static_cast<std::uint64_t>(events()) + (replicas ? replicas->kinds.size() : 0));
    }
    /// The original of a replica, or the realization of one event with the same draws; of an original its own index.
    std::uint64_t original(std::uint64_t index) const { return replicas || events() > 1 ? index % originals() : index; }
    /// Its kind; null of an original.
    const Replica* replica(std::uint64_t index) const
    {
        return replicas && index >= originals() ? &replicas->kinds[index / originals() - 1] : nullptr;
    }
    /// The cell of a realization: frequency row x number of PGAs + PGA column, or motion x number of stripes + stripe.
    std::uint64_t cell(std::uint64_t index) const { return surface || fragility ? original(index) / realizations : 0; }
    /// The number of a factor of a sensitivity study, by its name among the inputs; -1: it is none.
    int factor(const std::string& name) const
    {
        if (!sensitivity)
            return -1;
        const auto found = std::find(sensitivity->factors.begin(), sensitivity->factors.end(), name);
        return found == sensitivity->factors.end() ? -1 : static_cast<int>(found - sensitivity->factors.begin());
    }
    /// Index by which a realization draws the quantities that are not factors: its own, or that of all points of its
    /// row.
    std::uint64_t rest_index(std::uint64_t index) const
    {
        if (!sensitivity)
            return index;
        const SensitivitySpec::Place place = sensitivity->place(index);
        return place.row * sensitivity->inner + place.draw;
    }
    /// Index by which a realization draws its motion: of a survival study that of all structures under the motion.
    std::uint64_t motion_index(std::uint64_t index) const
    {
        if (!survival)
            return rest_index(index);
        return index / realizations * realizations + index % realizations / survival->per_motion;
    }
};

/// Default sampling rate of a trajectory: 100 times in 2 pi / p, p = sqrt(3 g / (4 R)) of the free
/// block that rocks fastest, R half its diagonal; 20 times in a period of the fastest shaking whose frequency the study
/// gives; and 100 times a second, since records have little above 25 Hz. Rounded up to whole tens.
double usual_trajectory_rate_hz(const Study& study);

} // namespace stylobate
