#include "io/measured/measured_file.hpp"

#include "io/measured/measured_layout.hpp"

#include <system_error>

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

} // namespace stylobate
