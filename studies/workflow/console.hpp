#pragma once
/// The observer of programs with a command line: what the user sees while a study runs, and how the user stops it.

#include "studies/workflow/workflow.hpp"

#include <chrono>
#include <optional>
#include <string>

namespace stylobate {

/// Exit statuses of programs.
enum Exit : int { exit_done = 0, exit_failed = 1, exit_bad_input = 2, exit_invalid = 3, exit_interrupted = 130 };

/// Writes to standard error. Where that is closed or full the text is lost, and the work goes on.
void say(const std::string& text);

/// Prints an error message. Control characters are replaced: names in it come from files, and a terminal would execute
/// them.
void say_error(std::string message);

/// How progress is shown on standard error.
enum class ProgressStyle {
    automatic, ///< one line that is rewritten on a terminal, `plain` otherwise
    plain,     ///< a line every ten seconds
    json,      ///< an object a line, every second and at the end; notes and warnings are objects too
    none
};

/// What the user of a program sees of a workflow on standard error.
class Console : public WorkObserver {
public:
    /// @param quiet whether notes and warnings are not printed, nor progress of the automatic style
    /// @param verb of the program, for objects
    explicit Console(bool quiet, ProgressStyle style = ProgressStyle::automatic, std::string verb = "");
    ~Console() override;
    Console(const Console&) = delete;
    Console& operator=(const Console&) = delete;

    /// From here on an interrupt (Ctrl-C) is noticed; before it ends the process.
    void begin() override;
    void note(const std::string& line) override;
    void stage(const std::string& what) override;
    /// A line every ten seconds.
    void counted(const char* unit, const std::string& line, const Progress& progress) override;
    void progress(const Progress& progress) override;
    void warn(const std::string& text) override;
    /// True after an interrupt or a request to terminate. A second one ends the process at once.
    bool stop_requested() override;
    /// Prints the last object, which states whether the work was finished. @returns the exit status of the verb
    /// @param last the progress at the end; nullopt: that which was shown last
    int end(int status, const std::optional<Progress>& last = std::nullopt);

private:
    /// The progress in one of the units.
    struct Shown {
        std::string unit, line;
        Progress progress;
    };

    void clear_line();
    void say_object(const char* event, const std::string& text) const;
    void show_object(Shown shown);
    void say_progress(bool finished) const;

    const bool quiet_;
    const ProgressStyle style_;
    const std::string verb_;
    const bool terminal_;
    std::optional<Shown> shown_; ///< last, or to be shown next
    bool line_open_ = false;
    double next_s_ = 10; ///< of the next line of `counted`
    std::chrono::steady_clock::time_point last_line_{};
};

} // namespace stylobate
