/// Functions of rooms that are not compiled for the page, because they need libraries that it does not have.

#include "ensemble/model/input_error.hpp"
#include "io/hazard/hazard_file.hpp"
#include "io/measured/measured_motion.hpp"
#include "studies/version.hpp"

namespace stylobate {

const char* code_version()
{
    return STYLOBATE_WEB_VERSION;
}

const char* code_build()
{
    return "Emscripten, wasm32 with 128-bit registers";
}

Motion read_base_table(const std::filesystem::path& file, const std::optional<std::string>&, PgaRange)
{
    throw InputError(
        file.string(), 0,
        "excitation.kind = \"table\": the page does not read tables of the base's motion.\n  Run the study "
        "with the program, or give a record (excitation.kind = \"record\").");
}

HazardModel read_hazard(const std::vector<std::string>& given, const std::string&, const std::optional<std::string>&)
{
    throw InputError(given.front(), 0, "the page does not read hazard curves.\n  Run the study with the program.");
}

} // namespace stylobate
