#include "studies/workflow/console.hpp"

#include "io/files/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <unistd.h>
#include <utility>

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

Console::Console(bool quiet, ProgressStyle style, std::string verb)
    : quiet_(quiet), style_(quiet && style == ProgressStyle::automatic ? ProgressStyle::none : style),
      verb_(std::move(verb)), terminal_(style == ProgressStyle::automatic && isatty(STDERR_FILENO) == 1)
{
}

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
    if (style_ == ProgressStyle::json)
        return say_object("note", line);
    clear_line();
    say(line + "\n");
}

void Console::stage(const std::string& what)
{
    if (style_ == ProgressStyle::json)
        say_object("stage", what);
}

void Console::counted(const char* unit, const std::string& line, const Progress& p)
{
    constexpr double between_lines_s = 10;
    if (style_ == ProgressStyle::json)
        return show_object({unit, line, p});
    if (style_ == ProgressStyle::none || p.done == 0 || (p.seconds < next_s_ && p.done < p.total))
        return;
    next_s_ = p.seconds + between_lines_s;
    clear_line();
    say(line + "\n");
}

void Console::clear_line()
{
    if (line_open_)
        say("\r\033[K");
    line_open_ = false;
}

void Console::progress(const Progress& progress)
{
    if (style_ == ProgressStyle::none)
        return;
    if (style_ == ProgressStyle::json)
        return show_object({"realizations", progress_line(progress), progress});
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
    if (style_ == ProgressStyle::json)
        return say_object("warning", text);
    clear_line();
    say(fmt::format("warning: {}\n", text));
}

bool Console::stop_requested()
{
    return interrupted;
}

int Console::end(int status, const std::optional<Progress>& last)
{
    if (style_ != ProgressStyle::json)
        return status;
    if (last)
        shown_ = Shown{"realizations", progress_line(*last), *last};
    say_progress(status != exit_interrupted);
    return status;
}

void Console::say_object(const char* event, const std::string& text) const
{
    say(Json::object().member("event", event).member("verb", verb_).member("text", text).text() + "\n");
}

void Console::show_object(Shown shown)
{
    const auto now = std::chrono::steady_clock::now();
    const bool first = !shown_;
    shown_ = std::move(shown);
    if (!first && now - last_line_ < std::chrono::seconds(1))
        return;
    last_line_ = now;
    say_progress(false);
}

void Console::say_progress(bool finished) const
{
    Progress nothing; // was told
    nothing.open_end = true;
    nothing.seconds = std::nan("");
    Json json = Json::object();
    json.member("event", "progress").member("verb", verb_);
    json.member("unit", shown_ ? shown_->unit : "realizations").member("line", shown_ ? shown_->line : "");
    add_progress(json, shown_ ? shown_->progress : nothing).member("finished", finished);
    say(json.text() + "\n");
}

} // namespace stylobate
