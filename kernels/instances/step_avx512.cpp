#include "kernels/instances/instantiate.hpp"
#include "kernels/twice.hpp"

namespace stylobate {

namespace {
struct Here {};
using Arch = xsimd::avx512dq;
} // namespace

extern const KernelTable avx512_kernels =
    kernel_table<Wide<Arch>, Wide<Arch, float>, Here, Twice<Wide<Arch>>>(Isa::avx512, 2);

} // namespace stylobate
