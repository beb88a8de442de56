#include "studies/kinds/fragility/fragility.hpp"

#include <fmt/format.h>

#include <utility>

namespace stylobate {

std::string describe_measure(const std::string& name)
{
    if (name == "pga_m_s2")
        return "peak ground acceleration [m/s²]";
    if (name == "pgv_m_s")
        return "peak ground velocity [m/s]";
    if (name == "pgd_m")
        return "peak ground displacement [m]";
    if (name == "arias_m_s")
        return "Arias intensity [m/s]";
    if (name == "cav_m_s")
        return "cumulative absolute velocity [m/s]";
    if (name == "d5_95_s")
        return "duration from 5 to 95 % of the Arias intensity [s]";
    if (name == "pgv_per_pga_s")
        return "PGV / PGA [s]";
    if (name == "mean_frequency_hz")
        return "mean frequency [Hz]";
    if (name.starts_with("sa_"))
        return fmt::format("spectral acceleration at {} s [m/s²]", name.substr(3, name.find("s_m") - 3));
    return name;
}

std::string short_measure(const std::string& name)
{
    for (const auto& [known, symbol] : {std::pair{"pga_m_s2", "PGA"},
                                        {"pgv_m_s", "PGV"},
                                        {"pgd_m", "PGD"},
                                        {"arias_m_s", "Arias intensity"},
                                        {"cav_m_s", "CAV"}})
        if (name == known)
            return symbol;
    return name.starts_with("sa_") ? fmt::format("Sa({} s)", name.substr(3, name.find("s_m") - 3)) : name;
}

std::string measure_unit(const std::string& name)
{
    return name.ends_with("_m_s2") ? "m/s2" : name.ends_with("_m_s") ? "m/s" : name.ends_with("_m") ? "m" : "";
}

} // namespace stylobate
