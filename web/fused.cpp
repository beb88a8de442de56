/// The steps for browsers whose WebAssembly has the fused multiply-add (its relaxed instructions): a module of its own,
/// because others refuse a module that contains it. The page asks `is_fused` first: the standard allows a browser to
/// round twice (web/README.md).

#include "kernels/instances/instantiate.hpp"
#include "kernels/planar/rigid/rigid_step.hpp"
#include "kernels/planar/step.hpp"
#include "kernels/soft_wide.hpp"

namespace stylobate {
namespace {

struct Here {};

struct Relaxed {
    STYLOBATE_INLINE static soft::Register multiply_add(soft::Register a, soft::Register b, soft::Register c)
    {
        return __builtin_wasm_fma_f64x2(a, b, c);
    }
};
using FusedWide = SoftWideBy<Relaxed>;

} // namespace
} // namespace stylobate

using namespace stylobate;

#define STYLOBATE_EXPORT extern "C" __attribute__((visibility("default")))

STYLOBATE_EXPORT void fused_planar(const Topology* topology, const Bundle* bundle, int first, int last)
{
    run_model<FusedWide, Here>(*topology, *bundle, first, last);
}

STYLOBATE_EXPORT void fused_spatial(const spatial::Topology* topology, const spatial::Bundle* bundle, int first,
                                    int last)
{
    spatial::run_steps<FusedWide, Here>(*topology, *bundle, first, last);
}

/// Whether the products of (1 + 2^-30) (1 - 2^-30) - 1 and the like keep their last bits.
/// @param two pairs of numbers in memory, so that no compiler computes them: {1 + 2^-30, 3}, {1 - 2^-30, 1/3}, {-1, -1}
STYLOBATE_EXPORT int is_fused(const double* two)
{
    const FusedWide result =
        fma(Lanes<FusedWide>::load(two), Lanes<FusedWide>::load(two + 2), Lanes<FusedWide>::load(two + 4));
    return result.v[0] == -0x1p-60 && result.v[1] == -0x1p-54;
}
