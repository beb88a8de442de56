/// `stylobate info`, and the options that say what to run on.

#include "ensemble/input_error.hpp"
#include "studies/command.hpp"
#include "studies/json.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>

namespace stylobate {

Isa CommonOptions::isa() const
{
    if (simd == "auto")
        return best_isa();
    Isa isa{};
    const std::vector<Isa> usable = usable_isas();
    if (parse_isa(simd, isa) && std::find(usable.begin(), usable.end(), isa) != usable.end())
        return isa;
    std::string names;
    for (const Isa other : usable)
        names += std::string(names.empty() ? "" : ", ") + to_string(other);
    throw InputError(fmt::format("--simd {}: not on this machine; it has {}", simd, names));
}

int CommonOptions::thread_count() const
{
    return threads > 0 ? threads : tbb::info::default_concurrency();
}

int info_command(const CommonOptions& options)
{
    const std::vector<Isa> usable = usable_isas();
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
                               .member("gpu", false)
                               .member("mpi", false)
                               .text());
        return exit_done;
    }
    fmt::print("stylobate {}\n", code_version());
    fmt::print("instruction sets: ");
    for (const Isa isa : usable)
        fmt::print("{} ", to_string(isa));
    fmt::print("(used: {}, {} realizations in a register)\n", to_string(options.isa()), kernels(options.isa()).lanes);
    fmt::print("threads: {}\n", options.thread_count());
    fmt::print("GPU: not in this version\nMPI: not in this version\n");
    return exit_done;
}

} // namespace stylobate
