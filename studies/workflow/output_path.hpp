#pragma once
/// Where a verb writes.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace stylobate {

/// "folder/name.h5" -> "folder/name" + `ending`.
std::filesystem::path beside(const std::string& input, const std::string& ending);

/// The file extension, without its dot and in small letters.
std::string ending_of(const std::filesystem::path& output);

/// Whether it is an ending of pictures: png, svg, pdf.
bool is_picture_format(std::string_view format);

/// @throws InputError if a drawing of a structure cannot have that ending
void check_drawing(const std::filesystem::path& output);

/// @throws InputError if the output is the input
void check_not_input(const std::string& input, const std::filesystem::path& output);

/// An existing file is kept unless --force is given: a mistyped output loses nothing.
///
/// @param input nullopt: the verb reads no file   @param output a file; checked before the work is done
/// @param force whether a file that is there may be replaced
/// @throws InputError if the output is the input, or if it exists and is not to be replaced
void check_output(const std::optional<std::string>& input, const std::filesystem::path& output, bool force);

/// Checks a folder of several files before they are written: it may be there, but empty.
/// @throws InputError as `check_output`
void check_output_folder(const std::string& input, const std::filesystem::path& folder, bool force);

} // namespace stylobate
