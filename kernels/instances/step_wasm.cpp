#include "kernels/instances/instantiate.hpp"
#include "kernels/soft_wide.hpp"

namespace stylobate {

namespace {
struct Here {};
} // namespace

extern const KernelTable wasm_kernels = kernel_table<SoftWide, float, Here>(Isa::wasm);

} // namespace stylobate
