#include "studies/output_path.hpp"

#include "ensemble/input_error.hpp"

#include <fmt/format.h>

namespace stylobate {

namespace fs = std::filesystem;

fs::path beside(const std::string& input, const std::string& ending)
{
    const fs::path path(input);
    return path.parent_path() / (path.stem().string() + ending);
}

void check_output(const std::string& input, const std::string& output)
{
    std::error_code none;
    if (!output.empty() && fs::equivalent(input, output, none))
        throw InputError(fmt::format("-o {}: is the file that is read; choose another output", output));
}

} // namespace stylobate
