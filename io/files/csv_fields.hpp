#pragma once
/// Lines and fields of CSV files that people and other programs write.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

struct CsvLine {
    long number = 0;                      ///< from 1
    std::vector<std::string_view> fields; ///< without blanks and quotes around them
};

/// The text of a file. @throws InputError if it cannot be read, or is larger than `largest` bytes
std::string csv_content(const std::filesystem::path& path, std::uint64_t largest);

/// Every line but empty ones and comments (#), cut at its commas; one in quotation marks belongs to its field.
/// @param text must outlive the calls
void for_each_csv_line(std::string_view text, const std::function<void(const CsvLine&)>& take);

/// A field as a number; NaN of an empty one, or of "nan". @throws InputError with file, line and column
double csv_number(const std::string& file, const CsvLine& line, std::size_t field, std::string_view column);

} // namespace stylobate
