#include "kernels/isa.hpp"

#include <array>
#include <cassert>

namespace stylobate {

extern const KernelTable scalar_kernels;
#if defined(STYLOBATE_X86)
extern const KernelTable portable_kernels, avx2_kernels, avx512_kernels;
#elif defined(STYLOBATE_NEON)
extern const KernelTable neon_kernels;
#elif defined(__wasm_simd128__)
extern const KernelTable wasm_kernels;
#endif

namespace {

constexpr std::array names{"scalar", "avx2", "avx512", "neon", "wasm"};

bool usable(Isa isa)
{
    switch (isa) {
    case Isa::scalar:
        return true;
#if defined(STYLOBATE_X86)
    case Isa::avx2:
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case Isa::avx512:
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
#elif defined(STYLOBATE_NEON)
    case Isa::neon:
        return true;
#elif defined(__wasm_simd128__)
    case Isa::wasm:
        return true;
#endif
    default:
        return false;
    }
}

} // namespace

const char* to_string(Isa isa)
{
    return names[static_cast<std::size_t>(isa)];
}

bool parse_isa(std::string_view name, Isa& isa)
{
    for (std::size_t i = 0; i < names.size(); ++i)
        if (name == names[i]) {
            isa = static_cast<Isa>(i);
            return true;
        }
    return false;
}

std::vector<Isa> usable_isas()
{
    std::vector<Isa> found;
    for (Isa isa : {Isa::scalar, Isa::neon, Isa::wasm, Isa::avx2, Isa::avx512})
        if (usable(isa))
            found.push_back(isa);
    return found;
}

const KernelTable& kernels(Isa isa)
{
    assert(usable(isa) && "kernels() is asked for an instruction set that this processor lacks");
    switch (isa) {
#if defined(STYLOBATE_X86)
    case Isa::avx2:
        return avx2_kernels;
    case Isa::avx512:
        return avx512_kernels;
#elif defined(STYLOBATE_NEON)
    case Isa::neon:
        return neon_kernels;
#elif defined(__wasm_simd128__)
    case Isa::wasm:
        return wasm_kernels;
#endif
    default:
#if defined(STYLOBATE_X86)
        if (!__builtin_cpu_supports("fma"))
            return portable_kernels;
#endif
        return scalar_kernels;
    }
}

} // namespace stylobate
