#pragma once
/// A measured campaign: one specimen, put on a shaking table and shaken several times. Plain data, SI units; y up,
/// angles counter-clockwise; (x, y) is a block's geometric centre in the frame of the laboratory.
///
/// What was not measured is empty. Values that are missing in a series (a block not seen, or after a collapse) are NaN.

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

struct MeasuredRun {
    std::string name;  ///< of its group or row: "004"
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

    int blocks() const { return static_cast<int>(half_width_m.size()); }
};

struct Campaign {
    std::string source; ///< file, for messages
    Specimen specimen;
    std::vector<MeasuredRun> runs; ///< in the order of their names
    std::vector<Finding> findings; ///< of reading and checking it; not part of the file
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
