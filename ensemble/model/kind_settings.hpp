#pragma once
/// The settings of the kinds of studies as plain data, each with the names of its table in a study file. Only the files
/// of the kinds, their keys and their reader name them; all others ask a study for its `StudyDesign`.

#include "ensemble/model/motion.hpp"
#include "ensemble/model/surface_axes.hpp"
#include "kernels/planar/step_model.hpp"

#include <algorithm>
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

/// Whether the cells of [surface] give the PGA, and the frequency or the direction.
constexpr bool has_axes(StudyKind kind)
{
    return kind == StudyKind::surface || kind == StudyKind::survival;
}

enum class Spacing { linear, log };

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
    Axis frequency_hz; ///< nf rows; without values where the rows are directions
    Axis pga_m_s2;     ///< np columns
    std::optional<AdaptiveSpec> adaptive = {};
    /// In space instead of the frequencies: azimuths of the first component, nf rows.
    std::optional<Axis> direction_deg = {};

    const Axis& rows() const { return direction_deg ? *direction_deg : frequency_hz; }
    const RowQuantity& row_quantity() const { return direction_deg ? direction_rows : frequency_rows; }
    int cells() const { return rows().count * pga_m_s2.count; }
};

/// How strong the motions of a set are.
enum class FragilityMethod {
    stripes, ///< every motion scaled to each intensity of an axis
    cloud    ///< every motion once, as it was recorded
};

/// By which measure motions are scaled.
enum class IntensityMeasure { pga, pgv, pgd, arias, cav, sa };

/// A component of a recorded motion beside the first one.
struct ComponentSpec {
    std::optional<std::string> file; ///< nullopt: that of the first one, or the one beside it that is named like it
    std::optional<std::string> component; ///< nullopt: the only one, or by its direction
    std::optional<std::string> unit;      ///< nullopt: the file gives it
    friend bool operator==(const ComponentSpec&, const ComponentSpec&) = default;
};

/// A ground motion of a set, as files hold it.
struct RecordSpec {
    std::string file;
    std::optional<std::string> component; ///< nullopt: the file has one
    std::optional<std::string> unit;      ///< nullopt: the file gives it
    /// Its other components in space, where they are not found by their names.
    std::optional<ComponentSpec> second = {}, vertical = {};
    friend bool operator==(const RecordSpec&, const RecordSpec&) = default;
};

/// Motions x stripes, and `Study::realizations` structures under each motion in each stripe. The structures of a motion
/// are the same in all its stripes (an incremental dynamic analysis of each), and others than those of another motion.
struct MotionSetSpec {
    FragilityMethod method = FragilityMethod::stripes;
    std::vector<RecordSpec> records; ///< of an excitation "record", else none
    /// Files of the folder that hold no accelerations, and its vertical components: not part of the study, for
    /// messages.
    std::vector<std::string> left_out = {};
    int motions = 0; ///< those of the records, or as many drawn from the seed
    IntensityMeasure measure = IntensityMeasure::pga;
    double period_s = 1;                         ///< of `sa`
    Axis intensity;                              ///< of `stripes`; in the measure's unit
    double scale = 1;                            ///< of `cloud`: factor on every motion
    OfPair of_pair = OfPair::geometric_mean;     ///< what the measures of two components are
    std::vector<double> periods_s = {0.5, 1, 2}; ///< at which spectral accelerations are measured

    // Number of earthquakes in succession, each with the intensity of its stripe; each begins from the state that the
    // one before has left.
    int shakings = 1;
    std::optional<double> pause_s; ///< between two of them; none: `pause_until_rest_s` of the nominal structure

    int stripes() const { return method == FragilityMethod::cloud ? 1 : intensity.count; }
};

/// A fragility study: a set of motions, how the structures under each are related, and the damage that is counted.
struct FragilitySpec : MotionSetSpec {
    // Where the scatter comes from: of the structures of a motion, every `contacts` x `twins` have the same
    // imperfections, and every `twins` of these the same contacts too.
    int contacts = 1;
    int twins = 1;
    double twin_m = 1e-9; ///< standard deviation of what twins differ by: the place of each drum

    std::vector<double> peak_limits = {0.15, 0.35, 1};         ///< of the top's displacement over the column's width
    std::vector<double> residual_limits = {0.005, 0.01, 0.02}; ///< of a joint's dislocation over its width
};

enum class SensitivityMethod {
    sobol, ///< shares of the variance (estimators/designs/sobol_indices.hpp): points A, B, A_1 ... of each row
    morris ///< screening (estimators/designs/sobol_indices.hpp): points A, A_1 ...
};

/// A design of the factors: rows of points, and at each point some realizations that differ in all that is no factor,
/// the same way at all points of a row. Realizations are counted row by row, point by point.
struct FactorDesign {
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
    /// Index by which a realization draws the quantities that are not factors: that of all points of its row.
    std::uint64_t rest_index(std::uint64_t index) const { return place(index).row * inner + place(index).draw; }
    /// The number of a factor by its name among the inputs; -1: it is none.
    int number(const std::string& name) const
    {
        const auto found = std::find(factors.begin(), factors.end(), name);
        return found == factors.end() ? -1 : static_cast<int>(found - factors.begin());
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

} // namespace stylobate
