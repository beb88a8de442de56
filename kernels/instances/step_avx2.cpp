#include "kernels/instances/instantiate.hpp"
#include "kernels/twice.hpp"

namespace stylobate {

namespace {
struct Here {};
using Arch = xsimd::fma3<xsimd::avx2>;
} // namespace

extern const KernelTable avx2_kernels =
    kernel_table<Wide<Arch>, Wide<Arch, float>, Here, Twice<Wide<Arch>>>(Isa::avx2, 1);

} // namespace stylobate
