// The kernel that steps single stacks with a lane for every block, for some numbers of blocks: six sums by fewer lanes
// than six, by as many, and by more; and a warp whose lanes all but one would be used.

#include "ensemble/planar/device/slot_kernel.cuh"

namespace stylobate {

template __global__ void step_slots<1, false>(SlotMemory, int, int);
template __global__ void step_slots<2, false>(SlotMemory, int, int);
template __global__ void step_slots<4, false>(SlotMemory, int, int);
template __global__ void step_slots<6, false>(SlotMemory, int, int);
template __global__ void step_slots<9, false>(SlotMemory, int, int);
template __global__ void step_slots<12, false>(SlotMemory, int, int);

} // namespace stylobate
