#include "io/files/atomic_folder.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"

#include <cerrno>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <system_error>
#include <utility>

namespace stylobate {

namespace fs = std::filesystem;

AtomicFolder::AtomicFolder(fs::path folder) : folder_(std::move(folder))
{
    if (folder_.filename().empty()) // "name/"
        folder_ = folder_.parent_path();
    std::error_code ignored;
    if (fs::exists(folder_, ignored) && (!fs::is_directory(folder_, ignored) || !fs::is_empty(folder_, ignored)))
        fail(fs::is_directory(folder_, ignored) ? "it holds files already" : "it is a file");
    std::string name = (folder_.parent_path() / fmt::format(".{}.XXXXXX", folder_.filename().string())).string();
    if (::mkdtemp(name.data()) == nullptr)
        fail(why_not_written(folder_, errno));
    temporary_ = name;
}

AtomicFolder::~AtomicFolder()
{
    std::error_code ignored;
    if (!temporary_.empty())
        fs::remove_all(temporary_, ignored);
}

void AtomicFolder::write(const std::string& name, std::string_view content)
{
    std::ofstream file(temporary_ / name, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file)
        fail(fmt::format("{}: {}", name, std::generic_category().message(errno)));
}

void AtomicFolder::commit()
{
    // mkdtemp makes the folder private; a new one has the permissions that the umask leaves
    std::error_code error;
    const fs::path like = temporary_ / ".permissions";
    fs::create_directory(like, error);
    const fs::perms permissions = fs::status(like, error).permissions();
    fs::remove(like, error);
    fs::permissions(temporary_, permissions, error);
    fs::rename(temporary_, folder_, error); // takes the place of an empty folder
    if (error)
        fail(error.message());
    temporary_.clear();
}

void AtomicFolder::fail(const std::string& reason) const
{
    throw InputError(fmt::format("cannot write the folder '{}': {}.\n  Name a new folder, in one that exists, can be "
                                 "written and has room; nothing was written.",
                                 folder_.string(), reason));
}

} // namespace stylobate
