#include "studies/workflow/workflow.hpp"

#include "ensemble/model/input_error.hpp"
#include "studies/report/words.hpp"

#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

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
    if (backend == "cuda") {
        const char* const step = std::getenv("STYLOBATE_DEVICE_STEP"); // to compare the two (scripts/gpu.sh)
        const bool threads = step != nullptr && std::string_view(step) == "threads";
        options.devices = open_cuda_devices(ranks ? ranks->local_rank() : 0, ranks ? ranks->local_size() : 1,
                                            threads ? DeviceStep::by_threads : DeviceStep::by_lanes);
    }
    options.ranks = ranks;
    return options;
}

std::string progress_line(const Progress& p)
{
    const std::optional<std::uint64_t> end = p.end();
    std::string line =
        fmt::format("{}{} realizations", p.done, end ? fmt::format(" of {}{}", p.open_end ? "about " : "", *end) : "");
    if (p.rate > 0)
        line += ", " + rate_text(p.rate) + "/s";
    if (p.simulates_first())
        line += fmt::format(", {:.3g} of at most {:.3g} s simulated", p.furthest.reached_s, p.furthest.latest_end_s);
    if (const std::optional<double> left = p.seconds_left())
        line += fmt::format(", {}{} left",
                            p.simulates_first() ? "at most "
                            : p.open_end        ? "about "
                                                : "",
                            duration_text(*left));
    if (!std::isnan(p.share))
        line += fmt::format(", {:.1f} % collapsed ({:.1f} to {:.1f})", 100 * p.share, 100 * p.share_lower,
                            100 * p.share_upper);
    if (p.invalid > 0)
        line += fmt::format(", {} invalid", p.invalid);
    return line;
}

Json& add_progress(Json& json, const Progress& p)
{
    json.member("done", p.done);
    add_member(json, "total", p.end());
    json.member("total_estimated", p.open_end && p.end())
        .member("rate_per_s", p.rate > 0 ? p.rate : std::nan(""))
        .member("seconds", p.seconds);
    add_member(json, "seconds_left", p.seconds_left());
    if (std::isnan(p.share))
        json.member_as_is("estimate", "null");
    else
        json.member("estimate", Json::object()
                                    .member("collapse_probability", p.share)
                                    .member("lower", p.share_lower)
                                    .member("upper", p.share_upper));
    json.member("invalid", p.invalid);
    return json.member("simulated_s", p.simulates_first() ? p.furthest.reached_s : std::nan(""))
        .member("simulated_most_s", p.simulates_first() ? p.furthest.latest_end_s : std::nan(""));
}

} // namespace stylobate
