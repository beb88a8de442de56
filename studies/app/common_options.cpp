/// The options that several verbs share: what to run on.

#include "ensemble/model/input_error.hpp"
#include "studies/app/command.hpp"

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
    throw InputError(fmt::format("--simd {}: not available on this machine; available: {}", simd, names));
}

int CommonOptions::thread_count() const
{
    return threads > 0 ? threads : std::max(1, tbb::info::default_concurrency() / (ranks ? ranks->sharing() : 1));
}

RunOptions CommonOptions::run_options() const
{
    RunOptions options{isa(), thread_count()};
    if (backend == "cuda")
        options.devices = ranks ? open_cuda_devices(ranks->local_rank(), ranks->local_size()) : open_cuda_devices();
    options.ranks = ranks;
    return options;
}

} // namespace stylobate
