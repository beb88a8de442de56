#include "io/files/hdf5_label.hpp"

#include "io/files/hdf5.hpp"

namespace stylobate {

Hdf5Label hdf5_label(const std::filesystem::path& file)
{
    try {
        const hdf5::Handle open = hdf5::open_file(file, false);
        const auto text = [&](const char* name) {
            return hdf5::has_attribute(open.id(), name) ? hdf5::read_any_text(open.id(), name) : std::string();
        };
        return {text("format"), text("kind")};
    } catch (const hdf5::Error&) { // its reader reports the error
        return {};
    }
}

} // namespace stylobate
