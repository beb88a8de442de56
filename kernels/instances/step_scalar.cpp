#include "kernels/instances/instantiate.hpp"

namespace stylobate {

namespace {
struct Here {};
} // namespace

// Needs the fused multiply-add: every x86-64 processor since 2013, and all of arm64.
extern const KernelTable scalar_kernels = kernel_table<double, float, Here>(Isa::scalar);

} // namespace stylobate
