#include "kernels/instantiate.hpp"
#include "kernels/wide.hpp"

namespace stylobate {

namespace {
struct Here {};
} // namespace

extern const KernelTable avx512_kernels = kernel_table<Wide<xsimd::avx512dq>, Here>(Isa::avx512);

} // namespace stylobate
