#include "kernels/instantiate.hpp"
#include "kernels/wide.hpp"

namespace stylobate
{
extern const KernelTable avx2_kernels = kernel_table<Wide<xsimd::fma3<xsimd::avx2>>>(Isa::avx2);
}
