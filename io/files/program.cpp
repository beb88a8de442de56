#include "io/files/program.hpp"

#include "ensemble/model/input_error.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

extern char** environ;

namespace stylobate {

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
