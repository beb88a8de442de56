#pragma once
/// Lines and fields of CSV files that people and other programs write.

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

struct CsvLine {
    long number = 0;                      ///< from 1
    std::vector<std::string_view> fields; ///< without blanks and quotes around them
};

/// std::from_chars of a whole token, with what people and Fortran write besides: a plus sign, and exponents such as
/// "1.5D-03" and "1.5-103". `ec` is invalid_argument if anything follows the number.
std::from_chars_result decimal_number(std::string_view token, double& value);

/// Whether a token is a number with a decimal comma: "-0,25", "1,5E-03".
bool has_decimal_comma(std::string_view token);

/// Why the content of a file is no text that can be read, and the remedy: UTF-16, a compressed file, a binary format.
/// Nullopt if it is none of those that are known.
std::optional<std::string> unreadable_encoding(std::string_view content);

/// The text of a file. @throws InputError if it cannot be read, is no text, or is larger than `largest` bytes
std::string csv_content(const std::filesystem::path& path, std::uint64_t largest);

/// Every line but empty ones and comments (#), cut at its separators; one in quotation marks belongs to its field. The
/// separator is a comma; a semicolon or a tab if the first such line has that and no comma.
/// @param text must outlive the calls
void for_each_csv_line(std::string_view text, const std::function<void(const CsvLine&)>& take);

/// A field as a number; NaN of an empty one, or of "nan". @throws InputError with file, line and column
double csv_number(const std::string& file, const CsvLine& line, std::size_t field, std::string_view column);

} // namespace stylobate
