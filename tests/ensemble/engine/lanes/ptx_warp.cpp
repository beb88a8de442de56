#include "tests/ensemble/engine/lanes/ptx_warp.hpp"

#include <algorithm>
#include <cstdlib>
#include <cxxabi.h>
#include <exception>
#include <numeric>

namespace ptx {

void fail(const std::string& what)
{
    throw Error(what);
}

/// The lanes, and what they exchange. `giving` and `voting` are of the lanes that have come to an instruction; the rest
/// of the round may run before a lane reads the answer, which is therefore another number.
struct Warp {
    explicit Warp(std::size_t stack_bytes)
    {
        for (int i = 0; i < warp_lanes; ++i) {
            lanes[i].number = static_cast<std::uint32_t>(i);
            lanes[i].warp = this;
            fibers.push_back(std::make_unique<Fiber>(stack_bytes));
        }
        std::iota(order.begin(), order.end(), 0);
    }

    /// To the lane that is next in the order; after the last one home.
    void hand_over(Fiber& from) { from.change_to(next < warp_lanes ? *fibers[order[next++]] : home); }

    std::array<Lane, warp_lanes> lanes;
    std::vector<std::unique_ptr<Fiber>> fibers;
    Fiber home;
    std::array<int, warp_lanes> order;
    int next = 0;
    void (*code)(Lane&) = nullptr;
    std::array<std::uint32_t, warp_lanes> giving{}, given{};
    std::uint32_t voting = 0, votes = 0;
    std::mt19937 random;
    std::exception_ptr error;
};

namespace {

std::string at_line(int line)
{
    return "line " + std::to_string(line) + " of the PTX";
}

/// "lanes 0 to 3, 5", of numbers in ascending order.
std::string numbers_of(const std::vector<int>& lanes)
{
    std::string text = "lanes";
    for (std::size_t i = 0; i < lanes.size(); ++i) {
        text += (i == 0 ? " " : ", ") + std::to_string(lanes[i]);
        const std::size_t first = i;
        while (i + 1 < lanes.size() && lanes[i + 1] == lanes[i] + 1)
            ++i;
        if (i > first)
            text += " to " + std::to_string(lanes[i]);
    }
    return text;
}

/// What a fiber does: the whole kernel for one lane. No exception may leave it.
void run_lane(void* argument)
{
    Lane& lane = *static_cast<Lane*>(argument);
    Warp& warp = *lane.warp;
    try {
        warp.code(lane);
    } catch (...) {
        warp.error = std::current_exception();
    }
    lane.line = 0;
    Fiber& fiber = *warp.fibers[lane.number];
    if (warp.error)
        fiber.change_to(warp.home);
    else
        warp.hand_over(fiber);
    std::abort(); // nobody continues what has ended
}

/// Do all lanes wait at the same instruction? False if all have ended.
bool all_wait(const Warp& warp)
{
    const int line = warp.lanes[0].line;
    if (std::all_of(warp.lanes.begin(), warp.lanes.end(), [=](const Lane& lane) { return lane.line == line; }))
        return line != 0;
    std::vector<int> first, others, ended;
    for (const Lane& lane : warp.lanes) {
        const int number = static_cast<int>(lane.number);
        if (lane.line == 0)
            ended.push_back(number);
        else if (first.empty() || lane.line == warp.lanes[first[0]].line)
            first.push_back(number);
        else
            others.push_back(number);
    }
    const std::string waiting = numbers_of(first) + " in " + at_line(warp.lanes[first[0]].line);
    if (!others.empty())
        fail("lanes wait at different instructions: " + waiting + ", " + numbers_of(others) + " in " +
             at_line(warp.lanes[others[0]].line));
    if (!ended.empty())
        fail("some lanes wait: " + waiting + "; others have ended: " + numbers_of(ended));
    return true;
}

std::string demangled(const char* name)
{
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> text(abi::__cxa_demangle(name, nullptr, nullptr, &status), &std::free);
    return status == 0 ? text.get() : name;
}

} // namespace

// ---- the lanes ------------------------------------------------------------------------------------------------------

void Lane::meet(std::uint32_t mask, int at_line_)
{
    if (mask != ~std::uint32_t{0})
        fail("not all lanes are named in " + at_line(at_line_));
    line = at_line_;
    warp->hand_over(*warp->fibers[number]);
}

std::uint32_t Lane::ballot(bool vote, std::uint32_t mask, int at_line_)
{
    warp->voting |= std::uint32_t{vote} << number;
    meet(mask, at_line_);
    return warp->votes;
}

std::uint32_t Lane::shuffle(std::uint32_t value, std::uint32_t from, std::uint32_t mask, int at_line_)
{
    warp->giving[number] = value;
    meet(mask, at_line_);
    return warp->given[from];
}

Source Lane::source(Shuffle way, std::uint32_t b, std::uint32_t c) const
{
    const std::uint32_t segment = c >> 8 & 31, clamp = c & 31;
    b &= 31;
    const std::uint32_t least = number & segment, most = least | (clamp & ~segment);
    std::int64_t from = 0;
    bool inside = false;
    switch (way) {
    case Shuffle::idx:
        from = least | (b & ~segment);
        inside = from <= most;
        break;
    case Shuffle::up:
        from = std::int64_t{number} - b;
        inside = from >= most;
        break;
    case Shuffle::down:
        from = number + b;
        inside = from <= most;
        break;
    case Shuffle::bfly:
        from = number ^ b;
        inside = from <= most;
        break;
    }
    return {inside ? static_cast<std::uint32_t>(from) : number, inside};
}

void Lane::outside_shared(std::uint32_t offset, std::uint32_t bytes) const
{
    fail("lane " + std::to_string(number) + " asks for " + std::to_string(bytes) + " bytes at " +
         std::to_string(offset) + " of a shared memory of " + std::to_string(shared_memory.size()) +
         ": outside, or not aligned");
}

// ---- the machine ----------------------------------------------------------------------------------------------------

const Kernel& kernel_named(Kernels kernels, std::string_view name)
{
    const Kernel* found = nullptr;
    std::string known;
    for (const Kernel& kernel : kernels) {
        const std::string text = demangled(kernel.name);
        known += "\n" + text;
        const std::size_t place = text.find(std::string(name) + "(");
        if (place == std::string::npos || (place > 0 && text[place - 1] != ':' && text[place - 1] != ' '))
            continue;
        if (found)
            fail("more than one kernel is named " + std::string(name));
        found = &kernel;
    }
    if (!found)
        fail("no kernel is named " + std::string(name) + "; there are:" + known);
    return *found;
}

Machine::Machine(std::size_t stack_bytes) : warp_(std::make_unique<Warp>(stack_bytes)) {}
Machine::~Machine() = default;

void Machine::run(const Kernel& kernel, const void* parameters, std::size_t bytes, int blocks, int threads_per_block,
                  std::size_t dynamic_shared_bytes, unsigned seed)
{
    if (bytes < kernel.parameters_bytes || bytes >= kernel.parameters_bytes + 16)
        fail("the kernel has " + std::to_string(kernel.parameters_bytes) + " bytes of parameters, not " +
             std::to_string(bytes));
    if (threads_per_block <= 0 || threads_per_block % warp_lanes != 0)
        fail(std::to_string(threads_per_block) + " threads are no number of warps");
    Warp& warp = *warp_;
    warp.random.seed(seed);
    // aligned as on a device; the end is the vector's, which AddressSanitizer knows
    constexpr std::size_t alignment = 128;
    const std::size_t shared_bytes = kernel.static_shared_bytes + dynamic_shared_bytes;
    std::vector<char> memory(shared_bytes + alignment), copy(bytes + 16);
    const auto aligned = [](std::vector<char>& v, std::size_t to) {
        return v.data() + (to - reinterpret_cast<std::uintptr_t>(v.data()) % to) % to;
    };
    char* const shared = aligned(memory, alignment);
    char* const own_parameters = aligned(copy, 16);
    std::memcpy(own_parameters, parameters, bytes);
    std::vector<int> warps(static_cast<std::size_t>(threads_per_block / warp_lanes));
    std::iota(warps.begin(), warps.end(), 0);
    for (int block = 0; block < blocks; ++block) {
        std::generate_n(shared, shared_bytes, [&] { return static_cast<char>(warp.random()); });
        std::shuffle(warps.begin(), warps.end(), warp.random);
        for (const int number : warps) {
            for (Lane& lane : warp.lanes) {
                lane.tid = static_cast<std::uint32_t>(number * warp_lanes) + lane.number;
                lane.ntid = static_cast<std::uint32_t>(threads_per_block);
                lane.ctaid = static_cast<std::uint32_t>(block);
                lane.nctaid = static_cast<std::uint32_t>(blocks);
                lane.parameters = own_parameters;
                lane.shared_memory = {shared, shared_bytes};
            }
            run_warp(kernel, warp);
        }
    }
}

void Machine::run_warp(const Kernel& kernel, Warp& warp)
{
    warp.code = kernel.lane;
    warp.error = nullptr;
    warp.voting = 0;
    for (int i = 0; i < warp_lanes; ++i)
        warp.fibers[i]->begin(&run_lane, &warp.lanes[i]);
    while (true) {
        std::shuffle(warp.order.begin(), warp.order.end(), warp.random);
        warp.next = 0;
        warp.hand_over(warp.home);
        if (warp.error)
            std::rethrow_exception(warp.error);
        if (!all_wait(warp))
            break;
        ++meetings_;
        warp.given = warp.giving;
        warp.votes = warp.voting;
        warp.voting = 0;
    }
    for (const auto& fiber : warp.fibers)
        if (fiber->overrun())
            fail("the stack of a lane is too small");
}

} // namespace ptx
