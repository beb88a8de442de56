#include "studies/workflow/workflow.hpp"

#include "ensemble/model/input_error.hpp"
#include "studies/report/words.hpp"

#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

Isa Machine::isa() const
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

int Machine::thread_count() const
{
    return threads > 0 ? threads : std::max(1, tbb::info::default_concurrency() / (ranks ? ranks->sharing() : 1));
}

RunOptions Machine::run_options() const
{
    RunOptions options{isa(), thread_count()};
    if (backend == "cuda")
        options.devices = ranks ? open_cuda_devices(ranks->local_rank(), ranks->local_size()) : open_cuda_devices();
    options.ranks = ranks;
    return options;
}

std::string progress_line(const Progress& p)
{
    const std::string of = !p.open_end      ? fmt::format(" of {}", p.total)
                           : p.expected > 0 ? fmt::format(" of about {}", std::max(p.expected, p.done))
                                            : "";
    std::string line = fmt::format("{}{} realizations", p.done, of);
    if (p.rate > 0)
        line += ", " + rate_text(p.rate) + "/s";
    const std::uint64_t end = p.open_end ? p.expected : p.total; // 0: unknown
    if (p.rate > 0 && p.done < end)
        line += fmt::format(", {}{} left", p.open_end ? "about " : "",
                            duration_text(static_cast<double>(end - p.done) / p.rate));
    if (const SimulatedTime& t = p.furthest; p.done == 0 && t.reached_s > 0) { // a realization takes long
        line += fmt::format(", {:.3g} of at most {:.3g} s simulated", t.reached_s, t.latest_end_s);
        if (p.seconds > 0 && p.total == 1)
            line += fmt::format(", at most {} left", duration_text((t.latest_end_s / t.reached_s - 1) * p.seconds));
    }
    if (!std::isnan(p.share))
        line += fmt::format(", {:.1f} % collapsed ({:.1f} to {:.1f})", 100 * p.share, 100 * p.share_lower,
                            100 * p.share_upper);
    if (p.invalid > 0)
        line += fmt::format(", {} invalid", p.invalid);
    return line;
}

} // namespace stylobate
