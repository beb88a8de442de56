#pragma once
/// Ground-motion records: files of any known format in, acceleration in m/s2 out.

#include "ensemble/model/motion.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

struct Study;

/// Of a component's axis.
enum class Direction {
    unknown, ///< the file does not contain it, or in no known words
    horizontal,
    vertical
};

/// One component as it stands in the file, converted to m/s2, nothing corrected; what else was done is in the note.
struct Record {
    std::string file;
    std::string format;    ///< "peer-at2", "csmip", "columns" and so on, as the table of io/records/record.cpp has them
    std::string component; ///< its name in the file, or "column 2"
    std::string title;     ///< event and station, as given in the file
    std::string unit;      ///< the file's unit: "g", "g/10", "m/s2", "cm/s2", "mm/s2"
    std::string station;   ///< the text of the file, which may have no character: a name, a code or a number
    std::string orientation; ///< the text of the file, which may have no character: "N10W", "360", "UP", "HNE"
    /// By the words that agencies use in the header, the name of the column, the title or the name of the file
    /// (io/records/record_names.cpp). A vertical component is no horizontal base motion.
    Direction direction = Direction::unknown;
    /// The largest |acceleration| that the file's own header states; none if it states none.
    std::optional<double> header_pga_m_s2;
    std::size_t column = 0;          ///< of a table, counted from 1; 0 in other formats
    std::optional<std::string> note; ///< what the reader had to do to the samples, for people; nullopt: nothing
    double dt_s = 0;
    std::vector<double> acceleration_m_s2;
};

/// A record with a PGA outside these is refused, unless its reader allows any: its unit is wrong [m/s2].
inline constexpr double smallest_pga_m_s2 = 1e-4;
inline constexpr double largest_pga_m_s2 = 50;

/// Which peak accelerations a record may have: those of ground motions, or any.
enum class PgaRange { usual, any };
/// `any` where the study allows the plausibility check of its PGA to fail.
PgaRange pga_range(const Study& study);

/// Reads every component of a file; the format is recognised from its content, never from its name. What each format
/// is stands on top of its io/records/record_NAME.cpp.
///
/// @param unit of the acceleration: "g" (9.80665 m/s2), "g/10", "m/s2", "cm/s2" (or "gal"), "mm/s2"; nullopt, or an
///        empty text, where the file must say it
/// @throws InputError if it cannot be read, is truncated, contradicts its own header, is of no known format,
///         says no unit and none is given, or says another unit than the one given, or if a PGA is outside
///         [smallest_pga_m_s2, largest_pga_m_s2]
std::vector<Record> read_records(const std::filesystem::path& file, const std::optional<std::string>& unit,
                                 PgaRange pga = PgaRange::usual);

/// Reads every component of a text in memory.
/// @param file name of the text, for messages and `Record::file`
std::vector<Record> read_records(std::string_view content, const std::string& file,
                                 const std::optional<std::string>& unit, PgaRange pga = PgaRange::usual);

/// The one component that is asked for: by name ("chan 1", "column 2"), by an orientation that only one has ("360"), or
/// by column number ("2"); nullopt, or an empty text, for the only one there is. Upper and lower case are one.
/// @throws InputError as above (the PGA of this component only), and if there is no such component or none was named
///         among several
Record read_record(const std::filesystem::path& file, const std::optional<std::string>& component,
                   const std::optional<std::string>& unit, PgaRange pga = PgaRange::usual);

/// "horizontal", "vertical" or "unknown".
const char* to_string(Direction direction);

/// What the name of a component says of its direction: "UP", "N-S", "HNZ", "090", "acc_z".
Direction direction_of_name(std::string_view name);

/// The format that a file is recognised as, by its content alone; nullopt if it is none of them, or no text.
std::optional<std::string> record_format(const std::filesystem::path& file);

} // namespace stylobate
