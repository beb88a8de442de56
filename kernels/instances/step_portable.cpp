#include "kernels/instances/instantiate.hpp"

namespace stylobate {

namespace {
struct Here {};
} // namespace

// For processors without a fused multiply-add: the C library's, slow, with the same bits.
extern const KernelTable portable_kernels = kernel_table<double, float, Here>(Isa::scalar);

} // namespace stylobate
