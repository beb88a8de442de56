#include "kernels/instantiate.hpp"
#include "kernels/wide.hpp"

namespace stylobate {

namespace {
struct Here {};
} // namespace

extern const KernelTable avx2_kernels = kernel_table<Wide<xsimd::fma3<xsimd::avx2>>, Here>(Isa::avx2);

} // namespace stylobate
