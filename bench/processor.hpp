#pragma once
/// The processor's name, as the system says it: a result without it says little.

#include <fstream>
#include <string>

namespace stylobate {

inline std::string processor()
{
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name"))
            return line.substr(line.find(':') + 2);
    return "unknown";
}

} // namespace stylobate
