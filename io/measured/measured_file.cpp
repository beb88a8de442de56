#include "io/measured/measured_file.hpp"

#include "io/measured/measured_layout.hpp"
#include "io/store/result_seal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>
#include <system_error>
#include <vector>

namespace stylobate {

Campaign read_campaign(const std::filesystem::path& path)
{
    std::error_code ignored;
    Campaign campaign = std::filesystem::is_directory(path, ignored) ? read_measured_csv(path)
                        : path.extension() == ".toml"                ? read_measured_csv(path.parent_path())
                                                                     : read_measured_hdf5(path);
    check_shapes(campaign);
    check_campaign(campaign);
    return campaign;
}

std::string fingerprint(const std::filesystem::path& path)
{
    std::uint32_t sum = 0;
    const auto add = [&](const std::filesystem::path& file) {
        std::ifstream in(file, std::ios::binary);
        const std::string content{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
        sum = crc32_of(std::as_bytes(std::span(content)), sum);
    };
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path, error))
            if (entry.is_regular_file(error))
                files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const auto& file : files)
            add(file);
    } else {
        add(path);
    }
    return fmt::format("crc32 {:08x}", sum);
}

} // namespace stylobate
