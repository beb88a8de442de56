#pragma once
/// The kernel that steps structures with a lane for every bed. Compiled by nvcc only: for the program
/// (`device_cuda.cu`), and for the test that runs its PTX on the processor.

#include "ensemble/planar/device/slot_warp.hpp"
#include "kernels/lanes/cuda_warp.cuh"

namespace stylobate {

/// Blocks of a multiprocessor for which registers must suffice: three warps for each of its four schedulers.
inline constexpr int block_residents = 3;

/// Steps slots 0 .. count - 1 by up to `chunks` chunks. @pre lanes_serve(m), as `with_lanes` has it
template <int width, bool lists>
__global__ void __launch_bounds__(warp_lanes* block_warps, block_residents)
    step_slots(const SlotMemory m, int chunks, int count)
{
    using Warp = SlotWarp<CudaWarp, width, lists>;
    extern __shared__ double2 memory[];
    const int number = static_cast<int>(threadIdx.x) / warp_lanes;
    const int first = (static_cast<int>(blockIdx.x) * block_warps + number) * Warp::Memory::groups;
    if (first >= count)
        return;
    const CudaWarp warp{static_cast<int>(threadIdx.x) % warp_lanes};
    Warp(warp, m, reinterpret_cast<WarpMemory<width, lists>*>(memory)[number], first, count).run(chunks);
}

} // namespace stylobate
