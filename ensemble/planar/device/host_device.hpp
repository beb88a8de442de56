#pragma once
/// The processor in the place of a device, for tests.

#include "ensemble/planar/device/device.hpp"

#include <memory>

namespace stylobate {

/// A device that is the processor: it runs the tasks in a loop. With it, all of the devices' code but the launches is
/// tested where there is no device; it is slower than the processor's own lanes.
std::shared_ptr<Device> host_device();

} // namespace stylobate
