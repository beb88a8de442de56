#include "studies/app/output_path.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

namespace stylobate {

namespace fs = std::filesystem;

fs::path beside(const std::string& input, const std::string& ending)
{
    const fs::path path(input);
    return path.parent_path() / (path.stem().string() + ending);
}

void check_not_input(const std::string& input, const fs::path& output)
{
    std::error_code none;
    if (fs::equivalent(input, output, none))
        throw InputError(fmt::format("-o {}: is the input file; choose another output", output.string()));
}

void check_output(const std::string& input, const fs::path& output, bool force)
{
    check_not_input(input, output);
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
