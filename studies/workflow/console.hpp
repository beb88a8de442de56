#pragma once
/// The observer of programs with a command line: what the user sees while a study runs, and how the user stops it.

#include "studies/workflow/workflow.hpp"

#include <chrono>
#include <string>

namespace stylobate {

/// Exit statuses of programs.
enum Exit : int { exit_done = 0, exit_failed = 1, exit_bad_input = 2, exit_invalid = 3, exit_interrupted = 130 };

/// Writes to standard error. Where that is closed or full the text is lost, and the work goes on.
void say(const std::string& text);

/// Prints an error message. Control characters are replaced: names in it come from files, and a terminal would execute
/// them.
void say_error(std::string message);

/// Progress on standard error: one line that is rewritten on a terminal, a plain line every ten seconds otherwise.
class Console : public WorkObserver {
public:
    /// @param quiet whether it prints nothing
    explicit Console(bool quiet);
    ~Console() override;
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    /// From here on an interrupt (Ctrl-C) is noticed; before it ends the process.
    void begin() override;
    void note(const std::string& line) override;
    /// A line every ten seconds.
    void counted(const std::string& line, const Progress& progress) override;
    void progress(const Progress& progress) override;
    void warn(const std::string& text) override;
    /// True after an interrupt or a request to terminate. A second one ends the process at once.
    bool stop_requested() override;

private:
    void clear_line();

    const bool quiet_;
    const bool terminal_;
    bool line_open_ = false;
    double next_s_ = 10; ///< of the next line of `counted`
    std::chrono::steady_clock::time_point last_line_{};
};

} // namespace stylobate
