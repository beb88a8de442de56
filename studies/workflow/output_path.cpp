#include "studies/workflow/output_path.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace stylobate {

namespace fs = std::filesystem;

fs::path beside(const std::string& input, const std::string& ending)
{
    const fs::path path(input);
    return path.parent_path() / (path.stem().string() + ending);
}

std::string ending_of(const fs::path& output)
{
    std::string ending = output.extension().string();
    ending.erase(0, ending.empty() ? 0 : 1);
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending;
}

bool is_picture_format(std::string_view format)
{
    return format == "png" || format == "svg" || format == "pdf";
}

void check_drawing(const fs::path& output)
{
    if (!is_picture_format(ending_of(output)))
        throw InputError(
            fmt::format("-o {}: the drawing of the structure is a .png, .svg or .pdf file", output.string()));
}

void check_not_input(const std::string& input, const fs::path& output)
{
    std::error_code none;
    if (fs::equivalent(input, output, none))
        throw InputError(fmt::format("-o {}: is the input file; choose another output", output.string()));
}

void check_output(const std::optional<std::string>& input, const fs::path& output, bool force)
{
    if (input)
        check_not_input(*input, output);
    std::error_code none;
    if (!force && fs::exists(output, none) && !fs::is_directory(output, none)) // no folder can become a file
        throw InputError(output.string(), 0,
                         "exists already, and nothing was written.\n  Give --force to replace it, or name another "
                         "file by -o.");
}

void check_output_folder(const std::string& input, const fs::path& folder, bool force)
{
    check_not_input(input, folder);
    std::error_code none;
    if (!force && fs::is_directory(folder, none) && !fs::is_empty(folder, none))
        throw InputError(folder.string(), 0,
                         "holds files already, and nothing was written.\n  Give --force to replace those of the same "
                         "names, or name another folder by -o.");
}

} // namespace stylobate
