/// Benchmarks say which code ran on which processor.

#include "studies/version.hpp"

#include <benchmark/benchmark.h>

#include <fstream>
#include <string>

namespace {

std::string processor()
{
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name"))
            return line.substr(line.find(':') + 2);
    return "unknown";
}

} // namespace

int main(int argc, char** argv)
{
    benchmark::AddCustomContext("stylobate", stylobate::code_version());
    benchmark::AddCustomContext("processor", processor());
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 1;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
