#pragma once
/// What the user sees while a study runs, and how the user stops it.

#include "ensemble/model/observer.hpp"

#include <chrono>
#include <string>

namespace stylobate {

/// Writes to standard error. Where that is closed or full the text is lost, and the work goes on.
void say(const std::string& text);

/// A line on standard error, unless --quiet is given.
void note(bool quiet, const std::string& line);

/// Prints an error message. Control characters are replaced: names in it come from files, and a terminal would execute
/// them.
void say_error(std::string message);

/// Progress on standard error: one line that is rewritten on a terminal, a plain line every ten seconds otherwise.
class Console : public Observer {
public:
    explicit Console(bool quiet);
    ~Console() override;
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    void progress(const Progress& progress) override;
    void warn(const std::string& text) override;
    /// True after an interrupt (Ctrl-C) or a request to terminate. A second one ends the process at once.
    bool stop_requested() override;

private:
    void clear_line();

    const bool quiet_;
    const bool terminal_;
    bool line_open_ = false;
    std::chrono::steady_clock::time_point last_line_{};
};

/// The line itself: done, rate, time left (an estimate, or nothing, where the total is open), the share that collapses
/// in the whole study with its 95 % interval, and what is invalid.
std::string progress_line(const Progress& progress);

} // namespace stylobate
