#include "io/files/temporary_folder.hpp"

#include "ensemble/model/input_error.hpp"

#include <cerrno>
#include <cstdlib>
#include <fmt/format.h>
#include <string>
#include <system_error>

namespace stylobate {

TemporaryFolder::TemporaryFolder()
{
    std::error_code error;
    std::filesystem::path parent = std::filesystem::temp_directory_path(error);
    if (const char* const named = std::getenv("TMPDIR"); error && named != nullptr)
        parent = named;
    std::string name = (parent / "stylobate-XXXXXX").string();
    if (error || ::mkdtemp(name.data()) == nullptr)
        throw InputError(fmt::format("cannot make a temporary folder in '{}': {}.\n  Set TMPDIR to a folder that "
                                     "exists and can be written.",
                                     parent.string(),
                                     error ? error.message() : std::generic_category().message(errno)));
    path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace stylobate
