#pragma once
/// The names, types and units of everything in a results file, written once for the writer and the reader, and the
/// bytes of a chunk of rows.

#include "io/store/result_store.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace stylobate {

inline constexpr std::uint64_t result_format_version = 5;         ///< of a structure in the plane
inline constexpr std::uint64_t spatial_result_format_version = 6; ///< of one in space
/// @param dimensions of the structure, 2 or 3
constexpr std::uint64_t format_version_of(int dimensions)
{
    return dimensions == 3 ? spatial_result_format_version : result_format_version;
}
inline constexpr std::uint8_t state_not_run = 255; ///< state of a row that is not written yet

/// Names in the file. Those of the columns follow from `visit_fields` below.
namespace result_names {
inline constexpr char format[] = "stylobate";
inline constexpr char realizations[] = "realizations";
inline constexpr char input[] = "realizations/input";
inline constexpr char input_order[] = "order"; ///< attribute of the group: `ResultHeader::input_names`, joined by ' '
inline constexpr char outcome[] = "realizations/outcome";
inline constexpr char beds[] = "beds"; ///< attribute of the outcomes of a survival study: the names, one on each line
inline constexpr char blocks[] = "blocks"; ///< attribute of groups with values by block: the names, one on each line
inline constexpr char checksum[] = "realizations/chunk_checksum";
inline constexpr char rows_per_chunk[] = "rows_per_chunk"; ///< attribute of the checksums
inline constexpr char selected[] = "selected";       ///< attribute of / where the rows are some of the realizations
inline constexpr char shard[] = "shard";             ///< attribute of / of an unfinished file that is meant for a part
inline constexpr char dimensions[] = "dimensions";   ///< attribute of / of a structure in space: 3
inline constexpr char build[] = "build";             ///< attribute of /: `ResultHeader::build`
inline constexpr char study_crc32[] = "study_crc32"; ///< attribute of /: `ResultHeader::study_crc32`
inline constexpr char warnings[] = "warnings";       ///< attribute of / where there are any: one on each line
inline constexpr char surface[] = "surface";
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

/// The channels of the trajectories of a model. @param dimensions of the structure, 2 or 3
std::span<const TrajectoryChannel> trajectory_channels(int dimensions);

/// The numbers of rows that a model has, in the order of the file: f(group below /realizations, name, facts, value of
/// each row...). @param dimensions of the structure, 2 or 3
template <class F, class... Row>
void visit_numbers(int dimensions, F&& f, Row&&... row)
{
    visit_fields(std::type_identity<ResultRow>(),
                 [&](const char* name, auto field, const FieldFacts& facts) { f("", name, facts, row.*field...); });
    visit_fields(std::type_identity<Outcome>(), [&](const char* name, auto field, const FieldFacts& facts) {
        if (has_model(facts.models, dimensions))
            f("outcome/", name, facts, row.outcome.*field...);
    });
}

/// The lists of an outcome that a file has: f(name, field, how many values they have, facts). The final state of the
/// structure is there in a survival study.
template <class F>
void visit_lists(const ResultHeader& header, F&& f)
{
    visit_lists(std::type_identity<Outcome>(),
                [&](const char* name, auto field, std::string_view of, const FieldFacts& facts) {
                    if (!header.bed_names.empty() || field == &Outcome::fall_time_s)
                        f(name, field, (of == "bed" ? header.bed_names : header.block_names).size(), facts);
                });
}

/// The end of the name that an input has in tables, which is its unit: "_n_m2". Empty: it is not known here.
std::string_view unit_ending_of_input(std::string_view name);

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
    std::string path;                     ///< below /realizations
    std::string unit;                     ///< "" of a number without one
    std::optional<std::string_view> none; ///< what stands for "none", and its meaning; nullopt: nothing does
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
    /// name is malformed, comes twice or lacks a neighbour, or if the structure is neither in the plane nor in space
    explicit ResultLayout(const ResultHeader& header);

    const std::vector<Column>& columns() const { return columns_; }
    std::uint64_t rows() const { return rows_; }
    /// Chunk of a row.
    std::uint64_t chunk_of(std::uint64_t row) const { return row / ResultWriter::rows_per_chunk; }
    std::uint64_t row_bytes() const { return row_bytes_; }
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
    struct List {
        std::vector<double> Outcome::*field;
        std::size_t column = 0;
        FieldFacts facts;
    };
    std::uint64_t first_index_ = 0;
    bool selected_ = false;
    int dimensions_ = 2;
    std::uint64_t rows_ = 0;
    std::uint64_t row_bytes_ = 0;
    std::vector<Column> columns_;
    std::vector<std::uint64_t> before_; ///< bytes for each row of the columns before this one
    std::vector<List> lists_;           ///< of the outcome: those that the file has
    std::vector<Input> inputs_;         ///< where `ResultRow::inputs` go
};

} // namespace stylobate
