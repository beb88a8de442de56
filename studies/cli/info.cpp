/// `stylobate info`.

#include "ensemble/model/input_error.hpp"
#include "studies/cli/command.hpp"
#include "studies/report/json.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

namespace stylobate {

int info_command(const CommonOptions& options, const std::string& file, bool all, const std::string& mpi)
{
    if (!file.empty()) {
        print_file(options, file, all);
        return exit_done;
    }
    const std::vector<Isa> usable = usable_isas();
    const CudaDevices gpus = cuda_devices();
    if (options.json) {
        Json sets = Json::list();
        for (const Isa isa : usable)
            sets.item(to_string(isa));
        fmt::print("{}\n", Json::object()
                               .member("version", code_version())
                               .member("simd", sets)
                               .member("simd_used", to_string(options.isa()))
                               .member("lanes", kernels(options.isa()).lanes)
                               .member("threads", options.thread_count())
                               .member("gpu", !gpus.names.empty())
                               .member("gpus", Json::list(gpus.names))
                               .member("mpi", !mpi.empty())
                               .member("mpi_library", mpi)
                               .text());
        return exit_done;
    }
    fmt::print("stylobate {}\n", code_version());
    fmt::print("instruction sets: ");
    for (const Isa isa : usable)
        fmt::print("{} ", to_string(isa));
    fmt::print("(used: {}, {} realizations in a register)\n", to_string(options.isa()), kernels(options.isa()).lanes);
    fmt::print("threads: {}\n", options.thread_count());
    for (const std::string& name : gpus.names)
        fmt::print("GPU: {}\n", name);
    if (gpus.names.empty())
        fmt::print("GPU: none ({})\n", gpus.reason);
    fmt::print("MPI: {}\n", mpi.empty() ? "none (this program was built without it)" : mpi);
    return exit_done;
}

} // namespace stylobate
