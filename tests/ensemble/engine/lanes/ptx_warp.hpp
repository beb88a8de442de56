#pragma once
/// Runs the PTX of a CUDA kernel on the processor, after `ptx_to_cpp.py` has made C++ of it.
///
/// Every lane of a warp is a fiber with its own registers and its own control flow. An instruction of the whole warp
/// (bar.warp.sync, shfl.sync, vote.sync) waits for all 32 lanes. Between two of these the lanes run one after another,
/// in an order that is drawn anew each time: where a barrier is missing, a lane reads before or after another one has
/// written, and a number is wrong in some order.

#include "tests/ensemble/engine/lanes/fiber.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ptx {

constexpr int warp_lanes = 32;

/// A mistake of the kernel that the hardware would answer with a hang, a fault or an undefined number.
struct Error : std::runtime_error {
    using runtime_error::runtime_error;
};
[[noreturn]] void fail(const std::string& what);

struct Warp;
struct Lane;

struct Kernel {
    const char* name; ///< mangled
    void (*lane)(Lane&);
    std::size_t parameters_bytes; ///< without what pads the last one
    std::size_t static_shared_bytes;
};

using Kernels = std::span<const Kernel>;

// ---- what the generated code uses -----------------------------------------------------------------------------------

enum class Shuffle { idx, up, down, bfly };

struct Source {
    std::uint32_t lane;
    bool inside; ///< of the part of the warp that the instruction names; else the lane has its own value
};

struct Lane {
    std::uint32_t tid = 0, ntid = 0, ctaid = 0, nctaid = 0;
    std::uint32_t number = 0; ///< in the warp
    const char* parameters = nullptr;
    std::span<char> shared_memory;
    Warp* warp = nullptr;
    int line = 0; ///< of the PTX, where it waits; 0: it has ended

    void meet(std::uint32_t mask, int at_line);
    std::uint32_t ballot(bool vote, std::uint32_t mask, int at_line); ///< bit k: of lane k
    std::uint32_t shuffle(std::uint32_t value, std::uint32_t from, std::uint32_t mask, int at_line);
    Source source(Shuffle way, std::uint32_t b, std::uint32_t c) const; ///< the PTX ISA's formulas

    /// Place of a number of so many bytes in shared memory: inside, and aligned, or a fault.
    char* shared(std::uint32_t offset, std::uint32_t bytes) const
    {
        if (offset % bytes != 0 || std::uint64_t{offset} + bytes > shared_memory.size())
            outside_shared(offset, bytes);
        return shared_memory.data() + offset;
    }
    std::uint64_t generic_of_shared(std::uint64_t offset) const
    {
        return reinterpret_cast<std::uintptr_t>(shared_memory.data()) + offset;
    }
    std::uint64_t shared_of_generic(std::uint64_t address) const
    {
        return address - reinterpret_cast<std::uintptr_t>(shared_memory.data());
    }

private:
    [[noreturn]] void outside_shared(std::uint32_t offset, std::uint32_t bytes) const;
};

template <class T>
T load(const char* place)
{
    T value;
    std::memcpy(&value, place, sizeof value);
    return value;
}

template <class T>
void store(char* place, T value)
{
    std::memcpy(place, &value, sizeof value);
}

/// Place of a number of so many bytes in any other memory: addresses are those of the processor.
inline char* at(std::uint64_t address, std::uint32_t bytes)
{
    if (address % bytes != 0)
        fail("a number of " + std::to_string(bytes) + " bytes at an address that is no multiple of it");
    return reinterpret_cast<char*>(address); // NOLINT(performance-no-int-to-ptr)
}
inline std::uint64_t address(const char* place)
{
    return reinterpret_cast<std::uintptr_t>(place);
}

/// What is in a register before anything is written into it: no number that could be right by chance.
template <class T>
constexpr T unwritten = std::floating_point<T> ? std::numeric_limits<T>::quiet_NaN()
                                               : static_cast<T>(0xdead'beef'dead'beefULL);

template <std::integral T>
T quotient(T a, T b)
{
    if (b == 0)
        fail("a whole number is divided by 0");
    if constexpr (std::is_signed_v<T>)
        if (b == -1)
            return static_cast<T>(0 - static_cast<std::make_unsigned_t<T>>(a));
    return static_cast<T>(a / b);
}
template <std::integral T>
T remainder(T a, T b)
{
    return static_cast<T>(static_cast<std::make_unsigned_t<T>>(a) -
                          static_cast<std::make_unsigned_t<T>>(quotient(a, b)) *
                              static_cast<std::make_unsigned_t<T>>(b));
}

/// By as much as the type has bits, or more: nothing is left but the sign.
template <std::integral T>
T left(T a, std::uint32_t by)
{
    return by < 8 * sizeof a ? static_cast<T>(a << by) : T{0};
}
template <std::integral T>
T right(T a, std::uint32_t by)
{
    const std::uint32_t most = 8 * sizeof a - 1;
    return by <= most ? static_cast<T>(a >> by) : static_cast<T>(a >> most >> 1);
}

/// The lowest bit becomes the highest.
template <std::unsigned_integral T>
T reversed(T a)
{
    T result = 0;
    for (std::size_t i = 0; i < 8 * sizeof a; ++i, a = static_cast<T>(a >> 1))
        result = static_cast<T>(result << 1 | (a & 1));
    return result;
}

/// By how much the highest bit that is 1 is shifted to the top; all ones if there is none.
inline std::uint32_t to_top(std::uint32_t a)
{
    return a == 0 ? ~std::uint32_t{0} : static_cast<std::uint32_t>(std::countl_zero(a));
}

/// Towards zero; what does not fit becomes the nearest number that does, and no number what the PTX ISA has for it.
template <std::integral To, std::floating_point From>
To whole(From a)
{
    if (std::isnan(a)) {
        constexpr bool wide = sizeof(From) == 8 || sizeof(To) == 8;
        return wide ? static_cast<To>(std::make_unsigned_t<To>{1} << (8 * sizeof(To) - 1)) : To{0};
    }
    // as powers of two: the largest whole number is none that a double has
    const From end = std::ldexp(From{1}, std::numeric_limits<To>::digits);
    if (a >= end)
        return std::numeric_limits<To>::max();
    if (a <= (std::is_signed_v<To> ? -end : From{0}))
        return std::numeric_limits<To>::min();
    return static_cast<To>(a);
}

// ---- what tests use -------------------------------------------------------------------------------------------------

/// The kernel whose name is that, with its template arguments: "sums<3>". Error: there is none, or more than one.
const Kernel& kernel_named(Kernels kernels, std::string_view name);

/// Parameters of a kernel, one after another, each aligned by its type.
template <class... Parameter>
std::vector<char> packed(const Parameter&... parameter)
{
    std::vector<char> bytes;
    const auto add = [&](const auto& p) {
        static_assert(std::is_trivially_copyable_v<std::remove_cvref_t<decltype(p)>>);
        const std::size_t place =
            (bytes.size() + alignof(decltype(p)) - 1) / alignof(decltype(p)) * alignof(decltype(p));
        bytes.resize(place + sizeof p);
        std::memcpy(bytes.data() + place, &p, sizeof p);
    };
    (add(parameter), ...);
    return bytes;
}

/// A device that runs the blocks of threads one after another, and the warps of a block, too: for kernels in which the
/// warps of a block do not wait for each other. It is used by one thread at a time.
class Machine {
public:
    explicit Machine(std::size_t stack_bytes = std::size_t{256} << 10);
    ~Machine();

    /// The shared memory of a block is filled with random bytes before it begins. The seed draws these, and the order
    /// of the lanes. Pointers among the parameters are those of the processor; `bytes` may contain what pads the last
    /// one.
    ///
    /// Error, with a text: the lanes of a warp wait at different instructions; some have ended while others wait; an
    /// instruction does not name all 32 lanes; an address in shared memory lies outside of it, or any address is not
    /// aligned; parameters have another size than those of the kernel; a block is no number of warps.
    void run(const Kernel& kernel, const void* parameters, std::size_t bytes, int blocks, int threads_per_block,
             std::size_t dynamic_shared_bytes, unsigned seed);

    /// How often the lanes of a warp have met, since the machine exists.
    long long meetings() const { return meetings_; }

private:
    void run_warp(const Kernel& kernel, Warp& warp);
    std::unique_ptr<Warp> warp_;
    long long meetings_ = 0;
};

} // namespace ptx
