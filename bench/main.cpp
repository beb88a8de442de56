/// Benchmarks say which code ran on which processor.

#include "studies/version.hpp"
#include "studies/workflow/machine_facts.hpp"

#include <benchmark/benchmark.h>

int main(int argc, char** argv)
{
    benchmark::AddCustomContext("stylobate", stylobate::code_version());
    benchmark::AddCustomContext("processor", stylobate::processor());
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 1;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
