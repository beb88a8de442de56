#include "studies/workflow/console.hpp"

#include "io/files/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
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

Console::Console(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}

Console::~Console()
{
    clear_line();
}

void Console::begin()
{
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}

void Console::note(const std::string& line)
{
    if (quiet_)
        return;
    clear_line();
    say(line + "\n");
}

void Console::counted(const std::string& line, const Progress& p)
{
    constexpr double between_lines_s = 10;
    if (p.done == 0 || (p.seconds < next_s_ && p.done < p.total))
        return;
    next_s_ = p.seconds + between_lines_s;
    note(line);
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

} // namespace stylobate
