#include "studies/app/console.hpp"

#include "io/files/utf8.hpp"
#include "studies/report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <unistd.h>

namespace stylobate {

namespace {

std::atomic<bool> interrupted = false;

extern "C" void on_signal(int signal)
{
    interrupted = true;
    std::signal(signal, SIG_DFL); // the second one ends the process: results that are written stay good
}

} // namespace

void say(const std::string& text)
{
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

void note(bool quiet, const std::string& line)
{
    if (!quiet)
        say(line + "\n");
}

void say_error(std::string message)
{
    std::ranges::replace_if(
        message,
        [](char c) {
            return c != '\n' && c != '\t' && begins_with_control({&c, 1});
        },
        '?');
    say(fmt::format("stylobate: {}\n", message));
}

Console::Console(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1)
{
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}

Console::~Console()
{
    clear_line();
}

void Console::clear_line()
{
    if (line_open_)
        say("\r\033[K");
    line_open_ = false;
}

void Console::progress(const Progress& progress)
{
    if (quiet_)
        return;
    const auto now = std::chrono::steady_clock::now();
    if (terminal_) {
        say("\r\033[K" + progress_line(progress));
        line_open_ = true;
    } else if (now - last_line_ >= std::chrono::seconds(10)) {
        if (last_line_ != std::chrono::steady_clock::time_point{}) // not at the very start
            say(progress_line(progress) + "\n");
        last_line_ = now;
    }
}

void Console::warn(const std::string& text)
{
    if (quiet_)
        return;
    clear_line();
    say(fmt::format("warning: {}\n", text));
}

bool Console::stop_requested()
{
    return interrupted;
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
