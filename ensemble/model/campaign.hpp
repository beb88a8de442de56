#pragma once
/// A measured campaign: one specimen, put on a shaking table and shaken several times. Plain data, SI units; y up,
/// angles counter-clockwise; (x, y) is a block's geometric centre in the frame of the laboratory.
///
/// What was not measured is empty. Values that are missing in a series (a block not seen, or after a collapse) are NaN.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace stylobate {

/// How much a finding weighs. What cannot be used at all is no finding: it is refused (InputError).
enum class Severity {
    note,   ///< worth knowing: a conversion, an assumption
    warning ///< contradicts other data of the campaign, or spoils a part of them
};

/// What the checks of a campaign found: a plain sentence and where.
struct Finding {
    Severity severity = Severity::note;
    std::string place; ///< "run 004, blocks/x_m, block 2"
    std::string text;
    friend bool operator==(const Finding&, const Finding&) = default;
};

/// Samples at the clock of their run, with the standard deviation of their noise.
struct Series {
    std::vector<double> values;     ///< (nt), or (nt x n_block) row by row; empty: not measured
    std::optional<double> noise_sd; ///< in the unit of the values; nothing: not known
    bool empty() const { return values.empty(); }
};

/// x, y and rotation of one or several bodies, as cameras see them.
struct SeenMotion {
    Series x_m;
    Series y_m;
    Series theta_rad;
    bool empty() const { return x_m.empty() && y_m.empty() && theta_rad.empty(); }
};

/// Where a base motion comes from.
enum class BaseSource {
    table_sensor, ///< measured on the table
    command       ///< the command of the table
};

/// What is done to a specimen in a run. All but `shake` and `rest` are tests of single joints: the blocks below the
/// joint are clamped to the table, those above the tested body are removed (`docs/diagnosis.md`).
enum class RunKind {
    shake, ///< the table shakes what stands free on it
    pull,  ///< a rod to the laboratory holds what is above the joint, by a force gauge, while the table cycles
    board, ///< one block on the joint, tilted until it slides
    tilt,  ///< the tested body, tilted until it turns about a corner
    push,  ///< a rod pushes the tested body at its top, by a force gauge, until it turns
    drop,  ///< the tested body is dropped onto the joint
    slide, ///< one block on the joint, the table shakes it so that it slides
    rest   ///< what callipers, level and scales give; nothing moves
};
inline constexpr std::array run_kinds = {RunKind::shake, RunKind::pull, RunKind::board, RunKind::tilt,
                                         RunKind::push,  RunKind::drop, RunKind::slide, RunKind::rest};
/// The word of a kind in files and messages: "pull".
constexpr const char* to_string(RunKind kind)
{
    constexpr const char* words[] = {"shake", "pull", "board", "tilt", "push", "drop", "slide", "rest"};
    return words[static_cast<int>(kind)];
}

/// A force gauge at the end of a rod that touches one block.
struct ForceGauge {
    std::string name;          ///< of its group
    Series value_n;            ///< (nt) horizontal force on the block, positive to the right [N]
    int block = 0;             ///< that it acts on
    double height_m = 0;       ///< of its point above the block's lower face
    double gain_sd = 0;        ///< 1 sigma of its gain, relative
    bool to_laboratory = true; ///< where the other end of the rod is: in the laboratory, else on the table
    double speed_m_s = 0;      ///< of that end, positive to the right; 0: held
    double stiffness_n_m = 0;  ///< of rod and gauge; 0: not known
};

/// A body of known mass that is taped onto a block, so that the same body stands on every joint.
struct Dummy {
    int block = 0; ///< that it is taped on
    double mass_kg = 0;
    double half_width_m = 0;
    double half_height_m = 0;
    double x_m = 0; ///< its centre, from that of the block
    double y_m = 0;
    friend bool operator==(const Dummy&, const Dummy&) = default;
};

struct MeasuredRun {
    std::string name; ///< of its group or row: "004"
    RunKind test = RunKind::shake;
    std::optional<int> joint;            ///< under test; nullopt: none, or all
    std::vector<int> present;            ///< blocks on the table; empty: all
    std::vector<int> clamped;            ///< joints that cannot move
    std::vector<std::vector<int>> taped; ///< groups of blocks that move as one
    std::vector<Dummy> dummies;
    std::optional<double> released_s; ///< hands hold the blocks until then; nullopt: they are free from the start
    Series base_tilt_rad;             ///< (nt) of the table, counter-clockwise; (x, y) then turn with it
    std::vector<ForceGauge> forces;   ///< in the order of their names
    int motion_id = 0; ///< runs with the same one repeat one commanded motion, the specimen put back by hand
    int repeat = 0;    ///< which of the repeats
    std::optional<std::string> kind; ///< of motion: "harmonic", "sweep", "quake", ...; nullopt: not given
    double rate_hz = 0;              ///< nominal, of the cameras
    std::optional<int> run_order;    ///< when it was run among the others
    std::optional<bool> collapsed;   ///< nothing: not given
    double collapse_time_s = -1;     ///< -1: none, or not known
    std::vector<double> time_s;      ///< (nt) the cameras' clock

    BaseSource base_source = BaseSource::table_sensor;
    Series base_acceleration_m_s2;         ///< (nt)
    Series base_displacement_m;            ///< (nt)
    std::optional<std::string> base_clock; ///< name of its clock; nullopt: the cameras'
    SeenMotion table;                      ///< (nt) the table, seen by the same cameras
    SeenMotion blocks;                     ///< (nt x n_block)

    /// Whether the motion of the base is known.
    bool has_base() const { return !base_acceleration_m_s2.empty() || !base_displacement_m.empty(); }
    /// Whether x, y and rotation of the blocks were measured.
    bool has_blocks() const
    {
        return !blocks.x_m.empty() && !blocks.y_m.empty() && !blocks.theta_rad.empty() && time_s.size() > 1;
    }
    /// When it collapsed; nothing where it did not, or that is not known.
    std::optional<double> fell_at_s() const
    {
        return collapsed.value_or(false) && collapse_time_s >= 0 ? std::optional(collapse_time_s) : std::nullopt;
    }
    /// Whether the block is on the table.
    bool has(int block) const { return present.empty() || std::ranges::find(present, block) != present.end(); }
};

/// The specimen as planned. Blocks and joints are counted from 0.
struct Specimen {
    std::string name;
    double gravity_m_s2 = 9.81;
    std::optional<double> friction_nominal;
    double mass_tolerance = 0.003;                 ///< 1 sigma, relative
    double width_tolerance = 0.001;                ///< 1 sigma, relative
    double placement_tolerance_m = 0;              ///< 1 sigma
    std::optional<double> base_block_half_width_m; ///< a block fixed to the table, on which the lowest ones stand
    double base_block_top_m = 0;                   ///< its top face above the table
    std::vector<double> half_width_m;              ///< (n_block)
    std::vector<double> half_height_m;             ///< (n_block)
    std::vector<double> depth_m;                   ///< (n_block)
    std::vector<double> mass_kg;                   ///< (n_block)
    std::vector<double> rest_x_m;                  ///< (n_block) centre
    std::vector<double> rest_y_m;                  ///< (n_block) centre, above the table
    std::vector<std::pair<int, int>> joints;       ///< lower block (-1: the base), upper block
    // measured at rest by callipers, level and scales
    std::vector<double> centre_of_mass_m; ///< (n_block) from the geometric centre, to the right
    std::vector<double> bearing_left_m; ///< (n_joint) where the joint begins to carry, from the upper block's left edge
    std::vector<double> bearing_right_m; ///< (n_joint) from its right edge

    int blocks() const { return static_cast<int>(half_width_m.size()); }
};

/// What the laboratory can do, and what it costs. Nothing: not stated.
struct Laboratory {
    std::optional<double> stroke_m;               ///< of the table, to either side
    std::optional<double> speed_m_s;              ///< of the table
    std::optional<double> acceleration_m_s2;      ///< of the table
    std::optional<double> tilt_rad;               ///< of a board
    std::optional<double> force_n;                ///< of the force gauge; 0: there is none
    bool may_dismantle = true;                    ///< whether blocks may be removed, clamped and taped
    std::vector<std::pair<RunKind, double>> cost; ///< of one test of a kind, in any unit; not listed: a default
};

struct Campaign {
    std::string source; ///< file, for messages
    Specimen specimen;
    Laboratory laboratory;
    std::vector<MeasuredRun> runs;  ///< the table shakes the whole specimen, which stands free; in the order of names
    std::vector<MeasuredRun> tests; ///< all others, in the order of their names; no shake runs, whatever reads them
    std::vector<Finding> findings;  ///< of reading and checking it; not part of the file
};

/// What shook a specimen, and whether it fell: an outcome without a history.
struct MeasuredOutcome {
    long line = 0;                          ///< of the file, for messages
    std::optional<std::string> motion_file; ///< the base motion's record; nullopt: not given
    std::optional<double> amplitude_m;      ///< of a harmonic displacement
    std::optional<double> frequency_hz;     ///< of it
    std::optional<double> pga_m_s2;         ///< peak acceleration of the base
    std::optional<double> pgv_over_pga_s;   ///< peak velocity over peak acceleration
    int motion_id = 0;                      ///< rows with the same one had one motion
    int repeat = 0;                         ///< which of them, from 0
    bool fell = false;

    /// What a motion is known by: rows in which it is equal repeat one motion.
    auto motion() const
    {
        return std::tuple(motion_file, amplitude_m.value_or(0), frequency_hz.value_or(0), pga_m_s2.value_or(0),
                          pgv_over_pga_s.value_or(0));
    }
};

struct OutcomeTable {
    std::string source; ///< file, for messages
    std::vector<MeasuredOutcome> rows;
    std::vector<Finding> findings;
};

} // namespace stylobate
