/// The instructions of a block-step, counted by running it one instruction at a time (ptrace) and naming each by the
/// disassembly: all instruction sets alike, AVX-512 too, which callgrind does not know. x86-64 and Linux only.

#include "studies/workflow/bench/warm_kernel.hpp"

#include <fmt/format.h>

#include <elf.h>
#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

/// The linker's: where this program's file begins in memory.
extern "C" const Elf64_Ehdr __ehdr_start;

using namespace stylobate;

namespace {

constexpr int free_blocks = 6;

/// Times that each instruction was met, by its address in the file.
using Visits = std::map<std::uint64_t, long>;

std::uint64_t load_address()
{
    return __ehdr_start.e_type == ET_DYN ? reinterpret_cast<std::uint64_t>(&__ehdr_start) : 0;
}

void await_stop(pid_t child)
{
    int status = 0;
    if (waitpid(child, &status, 0) != child || !WIFSTOPPED(status))
        throw std::runtime_error("the counted process ended early");
}

/// Steps the child until it stops itself, and counts.
Visits count_until_stop(pid_t child, std::uint64_t base)
{
    Visits visits;
    for (;;) {
        const long at = ptrace(PTRACE_PEEKUSER, child, offsetof(user, regs.rip), nullptr);
        ++visits[static_cast<std::uint64_t>(at) - base];
        if (ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr) != 0)
            throw std::runtime_error("the system does not allow single-stepping of a process (ptrace)");
        int status = 0;
        if (waitpid(child, &status, 0) != child || !WIFSTOPPED(status))
            throw std::runtime_error("the counted process ended early");
        if (WSTOPSIG(status) == SIGSTOP)
            return visits;
    }
}

/// What one chunk executes, without the calls around it.
Visits visits_of_chunk(const WarmKernel& warm)
{
    warm.restart();
    const pid_t child = fork();
    if (child < 0)
        throw std::runtime_error("no process can be made");
    if (child == 0) {
        ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
        std::raise(SIGSTOP);
        std::raise(SIGSTOP);
        warm.run();
        std::raise(SIGSTOP);
        _exit(0);
    }
    const std::uint64_t base = load_address();
    await_stop(child);
    const Visits around = count_until_stop(child, base);
    Visits visits = count_until_stop(child, base);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    for (const auto& [address, times] : around)
        if ((visits[address] -= times) == 0)
            visits.erase(address);
    return visits;
}

/// "vaddpd (%rax),%zmm0,%zmm1" by address, of this program.
std::map<std::uint64_t, std::string> disassembly()
{
    std::map<std::uint64_t, std::string> found;
    const std::string command = fmt::format("objdump -d --no-show-raw-insn /proc/{}/exe", getpid());
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::array<char, 4096> line;
    while (pipe && std::fgets(line.data(), line.size(), pipe.get()) != nullptr) {
        unsigned long address = 0;
        int at = 0;
        if (std::sscanf(line.data(), " %lx:%n", &address, &at) == 1 && at > 0) {
            std::string text(line.data() + at);
            text.erase(0, text.find_first_not_of(" \t"));
            found[address] = text.substr(0, text.find_first_of("#\n<"));
        }
    }
    if (found.empty())
        throw std::runtime_error("objdump (package binutils) cannot disassemble this program");
    return found;
}

struct Kinds {
    long multiply = 0, add = 0, divide = 0, select = 0, move = 0, rest = 0;
    long load = 0, store = 0; ///< of these, with an operand in memory
    long all() const { return multiply + add + divide + select + move + rest; }
};

bool any_of(std::string_view name, std::initializer_list<const char*> parts)
{
    for (const char* part : parts)
        if (name.find(part) != std::string_view::npos)
            return true;
    return false;
}

void count(const std::string& instruction, long times, Kinds& kinds)
{
    const std::string_view text = instruction;
    const std::string_view name = text.substr(0, text.find_first_of(" \t"));
    const bool floating = text.find("mm") != std::string_view::npos; // xmm, ymm or zmm
    if (!floating) {
        kinds.rest += times;
        return;
    }
    const std::size_t memory = text.find('(');
    if (memory != std::string_view::npos) {
        // in this notation the operand that is written comes last
        const bool written = text.find(',', text.find(')', memory)) == std::string_view::npos;
        (written && any_of(name, {"mov"}) ? kinds.store : kinds.load) += times;
    }
    if (any_of(name, {"fmadd", "fmsub", "fnmadd", "fnmsub", "mulp", "muls"}))
        kinds.multiply += times;
    else if (any_of(name, {"divp", "divs", "sqrt"}))
        kinds.divide += times;
    else if (any_of(name, {"addp", "adds", "subp", "subs", "minp", "mins", "maxp", "maxs", "cmp", "comis", "rndscale",
                           "roundp", "rounds", "cvt"}))
        kinds.add += times;
    else if (any_of(name, {"blend", "and", "or", "tern"}))
        kinds.select += times;
    else
        kinds.move += times;
}

} // namespace

int main()
{
    try {
        const auto code = disassembly();
        std::vector<Kinds> columns;
        std::string head = "| instructions of a block-step and register |", line = "|---|";
        for (const Isa isa : usable_isas()) {
            const WarmKernel warm(isa, free_blocks + 1);
            Kinds kinds;
            for (const auto& [address, times] : visits_of_chunk(warm)) {
                const auto found = code.find(address);
                if (found == code.end())
                    throw std::runtime_error("the step leaves this program: it calls a shared library");
                count(found->second, times, kinds);
            }
            columns.push_back(kinds);
            head += fmt::format(" {} |", to_string(isa));
            line += "---:|";
        }
        fmt::print("{}\n{}\n", head, line);
        const auto row = [&](const char* name, const auto& value) {
            fmt::print("| {} |", name);
            for (const Kinds& kinds : columns)
                fmt::print(" {:.1f} |", static_cast<double>(value(kinds)) / (free_blocks * chunk_steps));
            fmt::print("\n");
        };
        row("multiplications and multiply-adds", [](const Kinds& k) { return k.multiply; });
        row("additions, minima, comparisons, roundings", [](const Kinds& k) { return k.add; });
        row("divisions and roots", [](const Kinds& k) { return k.divide; });
        row("selections and signs", [](const Kinds& k) { return k.select; });
        row("moves of registers, loads and stores alone", [](const Kinds& k) { return k.move; });
        row("whole numbers, branches, masks", [](const Kinds& k) { return k.rest; });
        row("**all**", [](const Kinds& k) { return k.all(); });
        row("of these, with a load", [](const Kinds& k) { return k.load; });
        row("of these, stores", [](const Kinds& k) { return k.store; });
    } catch (const std::exception& error) {
        fmt::print(stderr, "instructions: {}\n", error.what());
        return 1;
    }
    return 0;
}
