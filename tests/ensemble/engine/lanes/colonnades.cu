// The kernel that steps structures with lists and watched pairs, for some widths of a group: five realizations in a
// warp, three, and one.

#include "ensemble/planar/device/slot_kernel.cuh"

namespace stylobate {

template __global__ void step_slots<6, true>(SlotMemory, int, int);
template __global__ void step_slots<10, true>(SlotMemory, int, int);
template __global__ void step_slots<31, true>(SlotMemory, int, int);

} // namespace stylobate
