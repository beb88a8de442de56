#include "kernels/instantiate.hpp"
#include "kernels/wide.hpp"

namespace stylobate
{
extern const KernelTable neon_kernels = kernel_table<Wide<xsimd::neon64>>(Isa::neon);
}
