#include "kernels/instantiate.hpp"
#include "kernels/wide.hpp"

namespace stylobate
{
extern const KernelTable avx512_kernels = kernel_table<Wide<xsimd::avx512dq>>(Isa::avx512);
}
