#include "kernels/instances/instantiate.hpp"
#include "kernels/wide.hpp"

namespace stylobate {

namespace {
struct Here {};
using Arch = xsimd::neon64;
} // namespace

extern const KernelTable neon_kernels = kernel_table<Wide<Arch>, Wide<Arch, float>, Here>(Isa::neon);

} // namespace stylobate
