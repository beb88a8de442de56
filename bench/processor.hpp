#pragma once
/// The processor's name: a result without it says little.

#include <fstream>
#include <map>
#include <string>

namespace stylobate {

/// The microarchitecture of AMD's processors, whose model names often leave it out ("AMD EPYC"); empty: not known.
/// @param family, model as in /proc/cpuinfo. Source: Linux 6.7, arch/x86/kernel/cpu/amd.c, `bsp_init_amd`
inline std::string amd_microarchitecture(int family, int model)
{
    const auto within = [model](int from, int to) { return model >= from && model <= to; };
    if (family == 0x17)
        return within(0x00, 0x2f) || within(0x50, 0x5f) ? "Zen" : "Zen 2";
    if (family == 0x19)
        return within(0x00, 0x0f) || within(0x20, 0x5f) ? "Zen 3" : "Zen 4";
    if (family == 0x1a && (within(0x00, 0x2f) || within(0x40, 0x4f) || within(0x70, 0x7f)))
        return "Zen 5";
    return "";
}

/// As the system says it, with the microarchitecture where the name leaves it out: "AMD EPYC (Zen 3)".
inline std::string processor()
{
    std::map<std::string, std::string> said;
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line) && !line.empty();) // of the first core
        if (const auto colon = line.find(':'); colon != std::string::npos)
            said[line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1)] =
                colon + 2 < line.size() ? line.substr(colon + 2) : "";
    std::string name = said.contains("model name") ? said["model name"] : "unknown";
    if (said["vendor_id"] == "AuthenticAMD")
        if (const std::string kind = amd_microarchitecture(std::stoi(said["cpu family"]), std::stoi(said["model"]));
            !kind.empty())
            name += " (" + kind + ")";
    return name;
}

} // namespace stylobate
