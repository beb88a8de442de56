// The kernel that steps columns with a lane for every block, for some numbers of blocks: six sums by fewer lanes than
// six, by as many, and by more; and a warp whose lanes all but one would be used.

#include "ensemble/planar/device/column_kernel.cuh"

namespace stylobate {

template __global__ void step_columns<1>(SlotMemory, int, int);
template __global__ void step_columns<2>(SlotMemory, int, int);
template __global__ void step_columns<4>(SlotMemory, int, int);
template __global__ void step_columns<6>(SlotMemory, int, int);
template __global__ void step_columns<9>(SlotMemory, int, int);
template __global__ void step_columns<12>(SlotMemory, int, int);

} // namespace stylobate
