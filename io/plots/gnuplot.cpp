#include "io/plots/gnuplot.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/temporary_folder.hpp"
#include "io/files/utf8.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <optional>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace stylobate {
namespace {

namespace fs = std::filesystem;

constexpr double points_per_inch = 72;

bool is_program(const fs::path& file)
{
    std::error_code ignored;
    return fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

std::optional<fs::path> find_program(const char* name)
{
    const char* folders = std::getenv("PATH");
    std::string_view rest = folders ? folders : "";
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        const fs::path candidate = fs::path(rest.substr(0, end)) / name;
        if (end > 0 && is_program(candidate))
            return fs::absolute(candidate);
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return std::nullopt;
}

std::string content_of(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Runs a program in `folder`, without a shell, its output and its errors in `log`. The status is the program's exit
/// status, or 128 + the signal that ended it.
/// @throws InputError if it cannot be started
int run_program(const fs::path& program, std::vector<std::string> arguments, const fs::path& folder,
                const fs::path& log)
{
    std::string name = program.string();
    std::vector<char*> argv{name.data()};
    for (std::string& argument : arguments)
        argv.push_back(argument.data());
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    pid_t pid = 0;
    const int error = ::posix_spawn(&pid, name.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        throw InputError(fmt::format("cannot start '{}': {}.\n  Install it again: apt install gnuplot-nox.", name,
                                     std::generic_category().message(error)));
    int status = 0;
    while (::waitpid(pid, &status, 0) < 0)
        if (errno != EINTR)
            throw std::system_error(errno, std::generic_category(), "waitpid");
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Without any font gnuplot draws a picture without text and reports nothing, so fontconfig is asked before.
void check_fonts(const TemporaryFolder& folder)
{
    const std::optional<fs::path> lister = find_program("fc-list");
    if (!lister)
        return;
    const fs::path log = folder / "fonts.log";
    if (run_program(*lister, {}, folder.path(), log) == 0 && content_of(log).empty())
        throw InputError("no picture can be drawn: this machine has no fonts, so the text would be missing.\n"
                         "  Install some: apt install fonts-dejavu-core.");
}

/// What gnuplot draws with, and how the picture begins.
struct Terminal {
    std::string commands;
    std::string_view begins;
};

Terminal terminal_of(const fs::path& picture, PictureSize size)
{
    std::string ending = picture.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    constexpr char text[] = "font 'DejaVu Sans,24' noenhanced";
    const std::string pixels = fmt::format("size {},{} {}", size.width, size.height, text);
    // Type and lines as large as in PNG, where a point of type is 4/3 of a pixel.
    if (ending == ".svg")
        return {"set terminal svg " + pixels + " background '#ffffff' linewidth 2 fontscale 1.3333\n", "<?xml"};
    if (ending == ".pdf") // a point for each pixel
        return {fmt::format("set terminal pdfcairo size {}in,{}in {} background '#ffffff' linewidth 4 fontscale 1\n",
                            size.width / points_per_inch, size.height / points_per_inch, text),
                "%PDF"};
    // Some builds of gnuplot lack cairo; their plain PNG is a little coarser.
    return {"if (strstrt(GPVAL_TERMINALS, ' pngcairo ') > 0) {\n    set terminal pngcairo " + pixels +
                " background '#ffffff' linewidth 2 fontscale 1\n} else {\n    set terminal png truecolor " + pixels +
                " linewidth 2\n}\n",
            "\x89PNG"};
}

} // namespace

fs::path find_gnuplot()
{
    const char* named = std::getenv("STYLOBATE_GNUPLOT");
    if (named != nullptr && *named != '\0') {
        if (is_program(named))
            return fs::absolute(named);
        throw InputError(fmt::format("STYLOBATE_GNUPLOT = '{}' is not an executable program.\n  Unset it, or set it to "
                                     "the path of gnuplot.",
                                     named));
    }
    if (const std::optional<fs::path> found = find_program("gnuplot"))
        return *found;
    throw InputError(
        "no picture can be drawn: gnuplot was not found in PATH.\n  Install it: apt install gnuplot-nox. Or "
        "set STYLOBATE_GNUPLOT to its path.");
}

std::string gnuplot_text(std::string_view text)
{
    // In single quotes gnuplot interprets nothing; a quote is written twice.
    std::string literal = "'";
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0)
            literal += '?';
        else if (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7f)
            literal += ' ';
        else if (text[0] == '\'')
            literal += "''";
        else
            literal += text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return literal + "'";
}

std::string gnuplot_heading(std::string_view title, std::string_view subtitle, PictureSize size)
{
    const auto points = [](std::string_view text, double largest, double room) {
        const auto letters = static_cast<double>(std::count_if(
            text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
        return std::max(6.0, std::min(largest, largest * room / std::max(letters, 1.0)));
    };
    const auto below_top = [&](double pixels) { return 1 - pixels / size.height; };
    return fmt::format("set label {} at screen 0.5, screen {} center font ',{:.1f}'\n"
                       "set label {} at screen 0.5, screen {} center font ',{:.1f}' textcolor rgb '#505050'\n",
                       gnuplot_text(title), below_top(58), points(title, 32, 60), gnuplot_text(subtitle),
                       below_top(123), points(subtitle, 21, 98));
}

void run_gnuplot(const std::string& script, PictureSize size, const fs::path& file)
{
    const fs::path gnuplot = find_gnuplot();
    AtomicFile target(file); // refuses before any work is done
    const TemporaryFolder folder;
    check_fonts(folder);

    const Terminal terminal = terminal_of(file, size);

    // Only names without a folder are in the script, so that no path needs to be escaped.
    std::ofstream(folder / "plot.gp") << terminal.commands << "set encoding utf8\nset output 'picture'\n"
                                      << script << "\nunset output\n";
    const fs::path log = folder / "gnuplot.log";
    // -d: nobody's settings (~/.gnuplot) change the picture.
    const int status = run_program(gnuplot, {"-d", "plot.gp"}, folder.path(), log);
    const std::string picture = content_of(folder / "picture");
    if (status != 0 || !picture.starts_with(terminal.begins)) {
        std::string said = content_of(log);
        while (!said.empty() && (said.back() == '\n' || said.back() == ' '))
            said.pop_back();
        throw InputError(fmt::format("gnuplot could not draw '{}' (exit status {}): {}\n  Check that '{}' is a working "
                                     "gnuplot 5.4 or newer: apt install gnuplot-nox.",
                                     file.string(), status, said.empty() ? "no message" : said.substr(0, 600),
                                     gnuplot.string()));
    }
    target.write(picture);
    target.commit();
}

std::string viridis_palette()
{
    std::string colours;
    for (std::size_t i = 0; i < viridis.size(); ++i)
        colours += fmt::format("{}{} '{}'", i > 0 ? ", " : "", i, viridis[i]);
    return "set palette defined (" + colours + ")\n";
}

} // namespace stylobate
