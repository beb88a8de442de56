#include "ensemble/planar/device/device.hpp"

#include "ensemble/model/input_error.hpp"

namespace stylobate {

std::vector<int> devices_of_rank(int devices, int local_rank, int local_size)
{
    if (devices <= 0)
        return {};
    std::vector<int> own;
    for (int device = local_rank % devices; device < devices; device += local_size)
        own.push_back(device);
    return own;
}

#if !defined(STYLOBATE_CUDA)
CudaDevices cuda_devices()
{
    return {{}, "this program was built without CUDA (cmake -DSTYLOBATE_CUDA=ON builds it with)"};
}

std::vector<std::shared_ptr<Device>> open_cuda_devices(int, int, DeviceStep)
{
    throw InputError("--backend cuda: " + cuda_devices().reason);
}
#endif

} // namespace stylobate
