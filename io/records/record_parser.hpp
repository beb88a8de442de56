#pragma once
/// What a parser of ground-motion files is, and what all of them share. One parser, one file.

#include "io/records/record.hpp"

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

/// A text file, cut into lines. Lines end with LF, CR LF, CR CR LF or CR.
struct RecordText {
    std::string file;
    std::vector<std::string_view> lines; ///< without their ends; views into a text that the reader keeps alive
    bool ended = true;                   ///< the last line has a line end

    /// "file:line: text" of line `i` of `lines`, which is line i + 1 for people.
    [[noreturn]] void refuse(std::size_t i, const std::string& what) const;
    /// "file: text"
    [[noreturn]] void refuse(const std::string& what) const;
};

/// The bytes of a file of text.
/// @param what it should be, for messages: "a ground-motion record"
/// @throws InputError if there is no such file, or it is too large or cannot be read
std::string content_of(const std::filesystem::path& path, const std::string& what);

/// Cuts it into lines; the text is gone with its content.
/// @throws InputError if it is empty or has bytes that no text has
RecordText lines_of(const std::string& file, std::string_view content);

/// Refuses a file most of whose rows of numbers have decimal commas: where the comma may also stand between columns,
/// "0,25" would be read as 0 and 25.
/// @throws InputError, naming the first such line
void refuse_decimal_commas(const RecordText& text);

/// What the name of a column says.
struct ColumnMeaning {
    enum class Quantity { unnamed, acceleration, velocity, displacement, time, other };
    Quantity of_words = Quantity::unnamed; ///< of its words, or of its letter
    Quantity of_unit = Quantity::unnamed;
    std::optional<std::string> unit; ///< as it is spelled; nullopt if it has none
    bool plain = false;              ///< its quantity is a word, "velocity", and not a letter, which may be a direction
};
ColumnMeaning meaning_of_column(std::string_view name);

/// "an acceleration", "a velocity" and so on.
const char* to_string(ColumnMeaning::Quantity quantity);

/// The unit of acceleration that a line of text above the rows spells, as in "# unit: cm/s2" or "% Acceleration (g)";
/// nullopt if there is none.
std::optional<std::string> unit_in_line(std::string_view line);

/// Plain columns of numbers, as record_columns.cpp describes them.
struct ColumnTable {
    std::vector<std::string> names;           ///< "column 2" where the file names none, or two alike
    std::vector<std::string> headings;        ///< as the file names them; empty where they do not fit the columns
    std::optional<std::size_t> heading_line;  ///< the line of names, if there is one
    std::vector<std::vector<double>> columns; ///< as they stand; the first one is the time unless it is alone
    std::vector<std::size_t> line;            ///< of each row
    std::optional<double> stated_dt_s;        ///< in a comment
    double dt_s = 0;                          ///< of the times; 0 of a single column
    std::string title;                        ///< the first comment
};
/// @throws InputError for rows that differ in length or are no numbers, and for times that are not uniform
ColumnTable read_columns(const RecordText& text);

/// One entry of the table in record.cpp.
struct RecordParser {
    const char* format; ///< of `Record::format`
    /// Whether the content is of this format, even if it is damaged further on.
    bool (*recognise)(const RecordText& text);
    /// Every component, its values in `Record::unit`: the reader converts them, and fills in file, format and
    /// direction.
    /// @param unit canonical name ("g", "g/10", "m/s2", "cm/s2", "mm/s2"); nullopt: the file must say it
    /// @throws InputError
    std::vector<Record> (*parse)(const RecordText& text, const std::optional<std::string>& unit);
};

extern const RecordParser at2_parser;
extern const RecordParser bhrc_parser;
extern const RecordParser columns_parser;
extern const RecordParser cosmos_parser;
extern const RecordParser csmip_parser;
extern const RecordParser esm_parser;
extern const RecordParser geonet_parser;
extern const RecordParser headed_parser;
extern const RecordParser knet_parser;
extern const RecordParser npts_dt_parser;
extern const RecordParser smc_parser;
extern const RecordParser unam_parser;
extern const RecordParser usc_parser;

/// A sampling interval outside these is taken for an error of unit or a damaged header [s].
inline constexpr double shortest_dt_s = 1e-5;
inline constexpr double longest_dt_s = 0.5;

/// m/s2 in one unit of acceleration; g is the standard gravity 9.80665 m/s2.
/// @pre canonical name
double unit_m_s2(std::string_view unit);

/// A unit in lower case without blanks and marks of powers, "sec" as "s": "CM/SEC^2" is "cm/s2".
std::string plain_unit(std::string_view spelling);

/// "g", "g/10", "m/s2", "cm/s2" or "mm/s2" for any usual spelling ("gal", "cm/sec/sec", "M/S^2"); nullopt if it is
/// none.
std::optional<std::string> canonical_unit(std::string_view spelling);

/// What to do about a missing unit, for messages.
inline constexpr const char* unit_remedy = "Give it (unit = \"...\" beside the file in the study, or --unit): "
                                           "\"m/s2\", \"cm/s2\", \"gal\", \"mm/s2\" or \"g\".";

/// The unit that line `i` spells, where none was given or the given one is the same.
/// @throws InputError if it is no unit of acceleration, or another than the one given
std::string unit_of_file(const RecordText& text, std::size_t i, std::string_view spelling,
                         const std::optional<std::string>& given);

/// The size of a peak that a header states, in m/s2; none for 0, which stands in headers that do not know it, and for
/// what is 0 or infinite in m/s2.
/// @pre canonical name
std::optional<double> stated_peak_m_s2(double peak, std::string_view unit);

/// Of a component whose header was read; `record.direction` where the parser knows it already.
Direction direction_of(const Record& record);

/// Without blanks at its ends.
std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);
bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words);

/// The words of a line with one blank between them.
std::string squeezed(std::string_view line);

/// The runs of letters and digits of a name, in lower case and without accents: "a (N-S)" is a, n, s.
std::vector<std::string> words_of(std::string_view name);

/// The parts of a line between blanks, tabs, commas and semicolons; two separators with nothing between them other
/// than blanks leave an empty part. `commas` false: blanks and tabs only.
std::vector<std::string_view> parts_of(std::string_view line, bool commas);

/// Whether the whole of it is a decimal number or one of inf and nan.
bool is_number(std::string_view token);

/// A line of numbers and nothing else.
bool is_row(std::string_view line);

/// @throws InputError, naming line `i`, if `token` is not a finite decimal number
double number(const RecordText& text, std::size_t i, std::string_view token);

/// Appends the numbers of a row to the columns.
/// @throws InputError, naming line `i`, if they are not as many, or not finite
void add_row(const RecordText& text, std::size_t i, std::vector<std::vector<double>>& columns);

/// Refuses a file whose line `i`, about its values, names a velocity, a displacement or a spectrum.
void refuse_other_quantity(const RecordText& text, std::size_t i);

/// Refuses a file that stops inside its last number. Such a number may still look like one (".123E-0"), but its end is
/// not in line with the ends of those above it, or it has fewer digits where all others have equally many. Where the
/// numbers above agree in neither, or the last line has its line end, nothing is refused.
/// @param first, last first and last line of data
/// @throws InputError
void refuse_cut_number(const RecordText& text, std::size_t first, std::size_t last, bool commas);

/// The first line of [first, last) that holds `phrase`, where `phrase` is in lower case and single blanks stand for any
/// number of them; `last` if none does.
std::size_t find_line(const RecordText& text, std::size_t first, std::size_t last, std::string_view phrase);

/// The line that holds `phrase` in a component's header of `lines` lines from `top` on.
/// @throws InputError if none of them holds it: the component is truncated or damaged
std::size_t header_line(const RecordText& text, std::size_t top, std::size_t lines, std::string_view phrase);

/// The word behind `key` in a line, an "=" or ":" between them or not; empty if the line lacks the key or ends there.
/// `key` is in lower case, single blanks in it stand for any number of them; the word keeps its case.
std::string word_after(std::string_view line, std::string_view key);

/// A whole number of samples.
/// @throws InputError, naming line `i`, if it is none or below two
std::size_t sample_count(const RecordText& text, std::size_t i, std::string_view token);

/// Whether a line below all values says that they end: "*** End Data ***", "EOF", "/&", "-----".
bool is_end_mark(std::string_view line);

/// @throws InputError, naming the line, if anything but blank lines and end marks follows from line `i` on
void refuse_more(const RecordText& text, std::size_t i);

/// How Fortran lays out numbers: so many to a line, in columns of one width.
struct FortranFormat {
    int per_line = 1, width = 0;
};

/// "(8f9.6)", "3F10.3", "(1E15.6)" or "(10I8)".
/// @throws InputError, naming line `i`
FortranFormat fortran_format(const RecordText& text, std::size_t i, std::string_view spelling);

/// The layout of a line of numbers that may touch, by their decimal points, which are one width apart.
/// @return none if they are not, or the line does not end with a column
std::optional<FortranFormat> layout_of(std::string_view line);

/// The lines that so many values take.
std::size_t lines_of_values(std::size_t count, int per_line);

/// `count` numbers in columns of `width` characters, `per_line` to a line, as Fortran writes them: they may touch.
/// Each line is full but the last, and nothing but blanks follows. Line first_line + lines_of_values(count, per_line)
/// is the one below them.
/// @param indent columns before the first number, which are not looked at
/// @throws InputError, naming the line, if a value is missing, cut, or no number, or if the file ends too early
/// @pre width, per_line > 0
std::vector<double> fixed_width_numbers(const RecordText& text, std::size_t first_line, std::size_t count, int width,
                                        int per_line, int indent = 0);

/// Fills in a record from pairs of time and value in lines of fixed width. The grid: the times are printed in whole
/// milliseconds, and the record is given on the widest even grid that has every one of them on it (their greatest
/// common divisor, 1 ms where they are as uneven as film). Values between are linear. So each sample stays at its time
/// with its value, the PGA is that of the file to the last bit, and nothing is smoothed, which a grid as wide as the
/// mean spacing would do to a peak between two of its points.
/// @param first_value line of the first pair
/// @param pairs time [s] and value [record.unit] in turn, `per_line` numbers to a line
/// @return the last time [s]
/// @throws InputError, naming the line, if the times do not increase, or leave a gap
double fill_from_pairs(const RecordText& text, std::size_t first_value, int per_line, const std::vector<double>& pairs,
                       Record& record);

/// `count` numbers between blanks, any number of them to a line, empty lines skipped; the last of them ends its line.
/// @param[out] next_line (may be null) the line below the last of them
/// @throws InputError, naming the line, if one is no number, if the file ends too early or inside its last number, or
///         if the line of the last one goes on
std::vector<double> read_numbers(const RecordText& text, std::size_t first_line, std::size_t count,
                                 std::size_t* next_line = nullptr);

/// The components of a file in which they follow one another, with blank lines between them or not.
/// @param read takes the one that begins at line `line` and moves `line` behind it
std::vector<Record> one_after_another(const RecordText& text, const std::optional<std::string>& given,
                                      Record (*read)(const RecordText& text, std::size_t& line,
                                                     const std::optional<std::string>& given));

/// @throws InputError, naming line `i`, if dt is outside [shortest_dt_s, longest_dt_s]
void check_dt(const RecordText& text, std::size_t i, double dt_s);

} // namespace stylobate
