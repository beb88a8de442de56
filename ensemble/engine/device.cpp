#include "ensemble/engine/device.hpp"

#include "ensemble/model/input_error.hpp"

namespace stylobate {

#if !defined(STYLOBATE_CUDA)
CudaDevices cuda_devices()
{
    return {{}, "this program was built without CUDA (cmake -DSTYLOBATE_CUDA=ON builds it with)"};
}

std::vector<std::shared_ptr<Device>> open_cuda_devices()
{
    throw InputError("--backend cuda: " + cuda_devices().reason);
}
#endif

} // namespace stylobate
