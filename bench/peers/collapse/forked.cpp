#include "bench/peers/collapse/forked.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <stdexcept>

namespace stylobate::peers {

namespace {

struct Child {
    pid_t id = -1;
    int from = -1; ///< where it writes its draws
    std::uint64_t draws = 0;
};

bool write_all(int to, const void* data, std::size_t bytes)
{
    const char* at = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t done = ::write(to, at, bytes);
        if (done <= 0)
            return false;
        at += done;
        bytes -= static_cast<std::size_t>(done);
    }
    return true;
}

bool read_all(int from, void* data, std::size_t bytes)
{
    char* at = static_cast<char*>(data);
    while (bytes > 0) {
        const ssize_t done = ::read(from, at, bytes);
        if (done <= 0)
            return false;
        at += done;
        bytes -= static_cast<std::size_t>(done);
    }
    return true;
}

Child start(const CellContender& contender, const Cell& cell, int level, std::uint64_t begin, std::uint64_t end)
{
    int ends[2];
    if (::pipe(ends) != 0)
        throw std::runtime_error("no pipe to a process could be made");
    std::fflush(nullptr); // or the child would print it again
    const pid_t id = ::fork();
    if (id < 0)
        throw std::runtime_error("no process could be started");
    if (id == 0) {
        bool sent = false;
        try {
            const Draws draws = contender.run(cell, level, begin, end);
            const std::array<double, 2> times{draws.simulated_s, draws.processor_s};
            sent = write_all(ends[1], times.data(), sizeof times) &&
                   write_all(ends[1], draws.collapsed.data(), draws.collapsed.size());
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s\n", error.what());
        }
        ::_exit(sent ? 0 : 1);
    }
    ::close(ends[1]);
    return {id, ends[0], end - begin};
}

} // namespace

Draws run_forked(const CellContender& contender, const Cell& cell, int level, std::uint64_t begin, std::uint64_t end,
                 int processes)
{
    if (processes == 1)
        return contender.run(cell, level, begin, end);
    std::vector<Child> children;
    const auto parts = static_cast<std::uint64_t>(processes);
    for (std::uint64_t part = 0; part < parts; ++part) {
        const std::uint64_t first = begin + (end - begin) * part / parts,
                            last = begin + (end - begin) * (part + 1) / parts;
        if (first < last)
            children.push_back(start(contender, cell, level, first, last));
    }
    Draws all;
    bool whole = true;
    for (const Child& child : children) {
        std::array<double, 2> times{};
        std::vector<char> collapsed(child.draws);
        whole = read_all(child.from, times.data(), sizeof times) &&
                read_all(child.from, collapsed.data(), collapsed.size()) && whole;
        ::close(child.from);
        ::waitpid(child.id, nullptr, 0);
        all.simulated_s += times[0];
        all.processor_s += times[1];
        all.collapsed.insert(all.collapsed.end(), collapsed.begin(), collapsed.end());
    }
    if (!whole)
        throw std::runtime_error(contender.engine + " (" + contender.setting +
                                 ") gave no result in a process of its own");
    return all;
}

} // namespace stylobate::peers
