#include "kernels/instantiate.hpp"
#include "kernels/wide.hpp"

namespace stylobate {

namespace {
struct Here {};
} // namespace

extern const KernelTable neon_kernels = kernel_table<Wide<xsimd::neon64>, Here>(Isa::neon);

} // namespace stylobate
