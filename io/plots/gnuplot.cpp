#include "io/plots/gnuplot.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/utf8.hpp"
#include "io/store/surface_axis.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

extern char** environ;

namespace stylobate {

namespace {

namespace fs = std::filesystem;

constexpr double points_per_inch = 72;

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

/// Tics of a logarithmic axis: 1, 2, 5 of each decade, all digits if that gives fewer than three labels.
std::string log_tics(char letter, double from, double to)
{
    std::string tics;
    const auto add = [&](std::array<bool, 10> labelled) {
        int labels = 0;
        tics.clear();
        for (int exponent = static_cast<int>(std::floor(std::log10(from))); std::pow(10.0, exponent) <= to; ++exponent)
            for (std::size_t digit = 1; digit <= 9; ++digit) {
                // From its text, so that 0.3 is 0.3.
                const double value = std::stod(fmt::format("{}e{}", digit, exponent));
                if (value < from || value > to)
                    continue;
                labels += labelled[digit] ? 1 : 0;
                tics += labelled[digit] ? fmt::format("{}'{}' {}", tics.empty() ? "" : ", ", value, value)
                                        : fmt::format("{}'' {} 1", tics.empty() ? "" : ", ", value);
            }
        return labels;
    };
    if (add({false, true, true, false, false, true, false, false, false, false}) < 3)
        add({false, true, true, true, true, true, true, true, true, true});
    // An axis within one digit has no such tic: gnuplot's own then.
    return tics.empty() ? std::string() : fmt::format("set {}tics ({})\n", letter, tics);
}

} // namespace

fs::path find_gnuplot()
{
    return find_tool("gnuplot", "STYLOBATE_GNUPLOT", "no picture can be drawn", "gnuplot-nox");
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
    // -d: the user's settings (~/.gnuplot) do not change the picture.
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

std::string gnuplot_axis(char letter, const CellAxis& axis)
{
    const double from = axis.edges.front(), to = axis.edges.back();
    const std::string range = fmt::format("set {}range [{}:{}]\n", letter, from, to);
    return axis.log ? fmt::format("set logscale {}\n", letter) + range + log_tics(letter, from, to) : range;
}

std::string viridis_colour(double value)
{
    const double at = std::clamp(value, 0.0, 1.0) * static_cast<double>(viridis.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
    const double share = at - static_cast<double>(i);
    const auto part = [](const char* colour, std::size_t k) { // of "#rrggbb"
        return static_cast<double>(std::stoi(std::string(colour).substr(1 + 2 * k, 2), nullptr, 16));
    };
    std::string mixed = "#";
    for (std::size_t k = 0; k < 3; ++k)
        mixed +=
            fmt::format("{:02x}", std::lround((1 - share) * part(viridis[i], k) + share * part(viridis[i + 1], k)));
    return mixed;
}

std::string viridis_palette()
{
    std::string colours;
    for (std::size_t i = 0; i < viridis.size(); ++i)
        colours += fmt::format("{}{} '{}'", i > 0 ? ", " : "", i, viridis[i]);
    return "set palette defined (" + colours + ")\n";
}

namespace {

namespace fs = std::filesystem;

bool is_program(const fs::path& file)
{
    std::error_code ignored;
    return fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

/// Writes until nothing is left, or until the reader has closed its end.
void feed(int descriptor, const std::function<std::string()>& input)
{
    // a program that ends early must not end this one
    void (*const before)(int) = std::signal(SIGPIPE, SIG_IGN);
    for (std::string piece = input(); !piece.empty(); piece = input()) {
        std::string_view rest = piece;
        while (!rest.empty()) {
            const ssize_t written = ::write(descriptor, rest.data(), rest.size());
            if (written < 0 && errno != EINTR)
                break;
            rest.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
        }
        if (!rest.empty())
            break;
    }
    ::close(descriptor);
    std::signal(SIGPIPE, before);
}

} // namespace

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

fs::path find_tool(const char* name, const char* variable, const std::string& lacking, const std::string& package)
{
    const char* named = std::getenv(variable);
    if (named != nullptr && *named != '\0') {
        if (is_program(named))
            return fs::absolute(named);
        throw InputError(
            fmt::format("{} = '{}' is not an executable program.\n  Unset it, or set it to the path of {}.", variable,
                        named, name));
    }
    if (const std::optional<fs::path> found = find_program(name))
        return *found;
    throw InputError(fmt::format("{}: {} was not found in PATH.\n  Install it: apt install {}. Or set {} to its path.",
                                 lacking, name, package, variable));
}

std::string content_of(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

int run_program(const fs::path& program, std::vector<std::string> arguments, const fs::path& folder,
                const fs::path& log, const std::function<std::string()>& input)
{
    std::string name = program.string();
    std::vector<char*> argv{name.data()};
    for (std::string& argument : arguments)
        argv.push_back(argument.data());
    argv.push_back(nullptr);

    std::array<int, 2> pipe{-1, -1};
    if (input && ::pipe2(pipe.data(), O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "pipe2");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    if (input)
        posix_spawn_file_actions_adddup2(&actions, pipe[0], STDIN_FILENO);
    else
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    pid_t pid = 0;
    const int error = ::posix_spawn(&pid, name.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (input)
        ::close(pipe[0]);
    if (error != 0) {
        if (input)
            ::close(pipe[1]);
        throw InputError(
            fmt::format("cannot start '{}': {}.\n  Install it again.", name, std::generic_category().message(error)));
    }
    if (input)
        feed(pipe[1], input);
    int status = 0;
    while (::waitpid(pid, &status, 0) < 0)
        if (errno != EINTR)
            throw std::system_error(errno, std::generic_category(), "waitpid");
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

} // namespace stylobate
