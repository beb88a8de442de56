#include "kernels/instantiate.hpp"

namespace stylobate
{
extern const KernelTable scalar_kernels = kernel_table<double>(Isa::scalar);
}
