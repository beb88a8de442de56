#pragma once
/// The kernel that steps columns with a lane for every block. Compiled by nvcc only: for the program
/// (`device_cuda.cu`), and for the test that runs its PTX on the processor.

#include "ensemble/planar/device/column_warp.hpp"
#include "kernels/lanes/cuda_warp.cuh"

namespace stylobate {

/// Blocks of a multiprocessor for which registers must suffice: three warps for each of its four schedulers.
inline constexpr int column_residents = 3;

/// Steps slots 0 .. count - 1 by up to `chunks` chunks. @pre lanes_serve(m), with so many free blocks
template <int blocks>
__global__ void __launch_bounds__(warp_lanes* column_warps, column_residents)
    step_columns(const SlotMemory m, int chunks, int count)
{
    using Warp = ColumnWarp<CudaWarp, blocks>;
    extern __shared__ double2 memory[];
    const int number = static_cast<int>(threadIdx.x) / warp_lanes;
    const int first = (static_cast<int>(blockIdx.x) * column_warps + number) * Warp::Memory::groups;
    if (first >= count)
        return;
    const CudaWarp warp{static_cast<int>(threadIdx.x) % warp_lanes};
    Warp(warp, m, reinterpret_cast<WarpMemory<blocks>*>(memory)[number], first, count).run(chunks);
}

} // namespace stylobate
