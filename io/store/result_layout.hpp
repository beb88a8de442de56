#pragma once
/// The names, types and units of everything in a results file, written once for the writer and the reader, and the
/// bytes of a chunk of rows.

#include "io/store/result_store.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace stylobate {

inline constexpr std::uint64_t result_format_version = 5;
inline constexpr std::uint8_t state_not_run = 255; ///< state of a row that is not written yet

/// Names in the file. Those of the columns follow from `visit_fields` below.
namespace result_names {
inline constexpr char format[] = "stylobate";
inline constexpr char realizations[] = "realizations";
inline constexpr char input[] = "realizations/input";
inline constexpr char input_order[] = "order"; ///< attribute of the group: `ResultHeader::input_names`, joined by ' '
inline constexpr char outcome[] = "realizations/outcome";
inline constexpr char fall_time[] = "outcome/fall_time_s";   ///< below /realizations
inline constexpr char bed_offset[] = "outcome/bed_offset_m"; ///< there, of a survival study
inline constexpr char rotation[] = "outcome/rotation_rad";   ///< the same
inline constexpr char beds[] = "beds";     ///< attribute of the outcomes of such a study: the names, one on each line
inline constexpr char blocks[] = "blocks"; ///< attribute of groups with values by block: the names, one on each line
inline constexpr char checksum[] = "realizations/chunk_checksum";
inline constexpr char rows_per_chunk[] = "rows_per_chunk"; ///< attribute of the checksums
inline constexpr char selected[] = "selected";       ///< attribute of / where the rows are some of the realizations
inline constexpr char shard[] = "shard";             ///< attribute of / of an unfinished file that is meant for a part
inline constexpr char build[] = "build";             ///< attribute of /: `ResultHeader::build`
inline constexpr char study_crc32[] = "study_crc32"; ///< attribute of /: `ResultHeader::study_crc32`
inline constexpr char warnings[] = "warnings";       ///< attribute of / where there are any: one on each line
inline constexpr char surface[] = "surface";
inline constexpr char surface_frequency[] = "surface/frequency_hz";
inline constexpr char surface_pga[] = "surface/pga_m_s2";
inline constexpr char motions[] = "motions";
inline constexpr char motion_names[] = "names";     ///< attribute of the group: `MotionTable::names`, one on each line
inline constexpr char measure_names[] = "measures"; ///< attribute: `MotionTable::measures`, one on each line
inline constexpr char motion_values[] = "motions/value";
inline constexpr char motion_exponents[] = "motions/exponent";
inline constexpr char shaking_ends[] = "motions/shaking_end_s";
inline constexpr char trajectories[] = "trajectories";
inline constexpr char tally[] = "tally";
inline constexpr char limit_states[] = "limit_states"; ///< attribute of the group: `ResultHeader::limit_states`
} // namespace result_names

/// Names of blocks as one text, and back.
/// @throws std::invalid_argument if a name is empty or has a line break
std::string joined_names(const std::vector<std::string>& names);
std::vector<std::string> split_names(const std::string& text);

/// Calls f(path below /realizations, unit, member) for every field of a row but the lists: fall times and inputs.
template <class Row, class F>
void visit_fields(Row& row, F&& f)
{
    f("index", "", row.index);
    f("cell", "", row.cell);
    f("frequency_hz", "Hz", row.frequency_hz);
    f("pga_m_s2", "m/s2", row.pga_m_s2);
    auto& o = row.outcome;
    f("outcome/state", "", o.state);
    f("outcome/invalid_reason", "", o.invalid_reason);
    f("outcome/collapse_time_s", "s", o.collapse_time_s);
    f("outcome/first_collapse_block", "", o.first_collapse_block);
    f("outcome/fallen_blocks", "", o.fallen_blocks);
    f("outcome/at_rest", "", o.at_rest);
    f("outcome/unseated_block", "", o.unseated_block);
    f("outcome/unseating_time_s", "s", o.unseating_time_s);
    f("outcome/total_collapse_time_s", "s", o.total_collapse_time_s);
    f("outcome/peak_top_displacement_m", "m", o.peak_top_displacement_m);
    f("outcome/residual_top_displacement_m", "m", o.residual_top_displacement_m);
    f("outcome/top_path_m", "m", o.top_path_m);
    f("outcome/total_sliding_m", "m", o.total_sliding_m);
    f("outcome/sliding_path_m", "m", o.sliding_path_m);
    f("outcome/residual_sliding_m", "m", o.residual_sliding_m);
    f("outcome/residual_dislocation", "", o.residual_dislocation);
    f("outcome/total_rocking_rad", "rad", o.total_rocking_rad);
    f("outcome/rocking_path_rad", "rad", o.rocking_path_rad);
    f("outcome/max_relative_rotation_rad", "rad", o.max_relative_rotation_rad);
    f("outcome/energy_kinetic_j", "J", o.energy_kinetic_j);
    f("outcome/energy_potential_j", "J", o.energy_potential_j);
    f("outcome/energy_spring_j", "J", o.energy_spring_j);
    f("outcome/energy_friction_j", "J", o.energy_friction_j);
    f("outcome/energy_damping_j", "J", o.energy_damping_j);
    f("outcome/energy_base_work_j", "J", o.energy_base_work_j);
    f("outcome/energy_residual", "", o.energy_residual);
    f("outcome/end_time_s", "s", o.end_time_s);
    f("outcome/step_s", "s", o.step_s);
    f("outcome/steps", "", o.steps);
}
static_assert(sizeof(Outcome) == 280,
              "a field that is added to or removed from Outcome must be so in visit_fields() too");

/// The last part of a column's path.
constexpr std::string_view name_of_column(std::string_view path)
{
    return path.substr(path.rfind('/') + 1); // all of it where there is no '/'
}
/// Whether a column has the time of what may not happen: in memory -1 is none, in files and tables NaN.
constexpr bool is_event_time(std::string_view path)
{
    const std::string_view name = name_of_column(path);
    return name == "collapse_time_s" || name == "unseating_time_s" || name == "total_collapse_time_s" ||
           name == "fall_time_s";
}
/// Whether a column has what remains of the motion: NaN of a structure that still moves.
constexpr bool is_residual(std::string_view path)
{
    const std::string_view name = name_of_column(path);
    return name == "residual_top_displacement_m" || name == "residual_sliding_m" || name == "residual_dislocation";
}

/// What stands for "none" in a column of a file or a table; empty: nothing does. (Of blocks, which are whole numbers,
/// -1 is none.)
constexpr std::string_view meaning_of_none(std::string_view path)
{
    if (is_event_time(path))
        return "NaN: it did not happen";
    if (is_residual(path))
        return "NaN: the structure still moved at the end";
    const std::string_view name = name_of_column(path);
    if (name == "first_collapse_block" || name == "unseated_block")
        return "-1: no block; -2: several blocks, together";
    return {};
}
/// A time as files and tables have it.
template <class Value>
Value without_none(std::string_view path, const Value& value)
{
    if constexpr (std::is_same_v<Value, double>)
        return value == -1 && is_event_time(path) ? std::numeric_limits<double>::quiet_NaN() : value;
    else
        return value;
}

/// `i64`: a number that is counted with, of which NumPy makes a place in an array.
enum class Stored { state, invalid_reason, i32, i64, u64, f64 };

template <class T>
constexpr Stored stored_as()
{
    if constexpr (std::is_same_v<T, State>)
        return Stored::state;
    else if constexpr (std::is_same_v<T, InvalidReason>)
        return Stored::invalid_reason;
    else if constexpr (std::is_same_v<T, std::int32_t>)
        return Stored::i32;
    else if constexpr (std::is_same_v<T, std::uint64_t>)
        return Stored::u64;
    else {
        static_assert(std::is_same_v<T, double>);
        return Stored::f64;
    }
}

/// One data set with one entry for each row.
struct Column {
    std::string path; ///< below /realizations
    std::string unit; ///< empty: none
    std::string none; ///< `meaning_of_none`
    Stored stored = Stored::f64;
    bool matrix = false;     ///< (n x width) instead of (n)
    std::uint64_t width = 1; ///< values for each row
    std::uint64_t bytes = 0; ///< for each row
};

/// The columns of a file, and how a chunk of rows becomes bytes: column by column in the order of `columns()`, each as
/// its rows lie in the file. The checksum of a chunk is over these bytes.
class ResultLayout {
public:
    ResultLayout() = default;
    /// @throws std::invalid_argument if there is no row or no block, if a block's name is malformed, or if an input
    /// name is malformed, comes twice or lacks a neighbour
    explicit ResultLayout(const ResultHeader& header);

    const std::vector<Column>& columns() const { return columns_; }
    std::uint64_t rows() const { return rows_; }
    /// Chunk of a row.
    std::uint64_t chunk_of(std::uint64_t row) const { return row / ResultWriter::rows_per_chunk; }
    std::uint64_t row_bytes() const { return row_bytes_; }
    std::size_t inputs() const { return inputs_.size(); }
    std::size_t blocks() const { return columns_[fall_time_].width; }
    /// 0 where rows do not hold the final state.
    std::size_t beds() const { return beds_; }
    /// Whether its lists are as long as the columns are wide.
    bool fits(const ResultRow& row) const;

    std::uint64_t chunks() const { return (rows_ + ResultWriter::rows_per_chunk - 1) / ResultWriter::rows_per_chunk; }
    std::uint64_t first_row(std::uint64_t chunk) const { return chunk * ResultWriter::rows_per_chunk; }
    std::uint64_t rows_in(std::uint64_t chunk) const
    {
        return std::min(ResultWriter::rows_per_chunk, rows_ - first_row(chunk));
    }
    /// Bytes of a column in a chunk: where they begin, and how many.
    std::uint64_t begin_in_chunk(std::size_t column, std::uint64_t chunk) const
    {
        return before_[column] * rows_in(chunk);
    }
    std::uint64_t bytes_in_chunk(std::size_t column, std::uint64_t chunk) const
    {
        return columns_[column].bytes * rows_in(chunk);
    }

    /// Puts row `k` of those that these bytes hold (a chunk, or a single one) into its place.
    /// @pre fits(row)
    void encode(std::uint64_t k, const ResultRow& row, std::span<std::byte> bytes) const;
    /// Takes row `k` of those that these bytes hold.
    /// @throws std::invalid_argument if a value is impossible
    ResultRow decode(std::uint64_t k, std::span<const std::byte> bytes) const;

private:
    struct Input {
        std::size_t column = 0;
        std::uint64_t component = 0;
    };
    std::uint64_t first_index_ = 0;
    bool selected_ = false;
    std::uint64_t rows_ = 0;
    std::uint64_t row_bytes_ = 0;
    std::vector<Column> columns_;
    std::vector<std::uint64_t> before_; ///< bytes for each row of the columns before this one
    std::size_t fall_time_ = 0;         ///< column of `Outcome::fall_time_s`; the final state follows it, if any
    std::size_t beds_ = 0;
    std::vector<Input> inputs_; ///< where `ResultRow::inputs` go
};

} // namespace stylobate
