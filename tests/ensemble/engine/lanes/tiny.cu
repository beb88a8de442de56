// Small kernels whose PTX `test_ptx_warp.cpp` runs on the processor: one that is right, and some with one mistake each.
#include "tests/ensemble/engine/lanes/tiny.hpp"

namespace tiny {

namespace {

constexpr int lanes = 32;

struct WithTable {
    double values[lanes + 1]; // one more than the lanes: the last one has a neighbour, too
};

// not inline: a call with parameters, one of them a struct, and a result in the memory of the caller
__device__ __noinline__ double weighed(const Weights w, double a, double b)
{
    const double sum = w.of_a * a + w.of_b * b;
    return w.times == 0 ? sum : weighed({w.of_b, w.of_a, w.times - 1}, sum, a);
}

__device__ __noinline__ void smaller_first(double& a, double& b)
{
    if (b < a) {
        const double kept = a;
        a = b;
        b = kept;
    }
}

__device__ double dynamic_index(double x, int which)
{
    double powers[4] = {1, x, x * x, x * x * x}; // in memory, as `which` is unknown
    powers[which >> 2 & 3] += 0.5;
    return powers[which & 3];
}

} // namespace

/// n values a lane. The values of the lanes below are read after a barrier, through shared memory.
template <int n>
__global__ void sums(const Input in, Output* out, int rounds)
{
    extern __shared__ double2 dynamic[];
    __shared__ WithTable fixed[2]; // of a block: two warps
    const int lane = static_cast<int>(threadIdx.x & 31), warp = static_cast<int>(threadIdx.x / 32);
    const int thread = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    double2* const pairs = dynamic + warp * lanes;
    double* const table = fixed[warp].values;
    double x[n];
    for (int i = 0; i < n; ++i)
        x[i] = in.values[thread * n + i];
    if (lane == 0)
        table[lanes] = 0;
    for (int k = 0; k < rounds; ++k) {
        table[lane] = x[k % n];
        pairs[lane] = make_double2(x[0], x[n - 1]);
        __syncwarp();
        const double above = table[lane + 1];
        const double2 below = pairs[lane == 0 ? 0 : lane - 1];
        __syncwarp();
        for (int i = 0; i < n; ++i)
            x[i] = fma(x[i], 0.75, above) - below.x * below.y;
    }
    Output& o = out[thread];
    o.sum = x[0];
    for (int i = 1; i < n; ++i)
        o.sum = o.sum + x[i];
    o.quotient = x[0] / in.divisor;
    o.root = sqrt(fabs(x[n - 1]));
    o.fused = fma(x[0], x[n - 1], -(x[0] * x[n - 1]));
    o.from_other = __shfl_sync(~0U, o.sum, lane * 7 + 3);
    o.from_above = __shfl_down_sync(~0U, lane * lane, 2);
    o.votes = __ballot_sync(~0U, o.sum > 0);
    o.any = __any_sync(~0U, o.sum > 1e300) ? 1 : 0;
    o.bits = __popc(o.votes) + 100 * __ffs(static_cast<int>(o.votes)) + 10000 * __clz(static_cast<int>(o.votes));
    o.weighed = weighed({0.3, 0.9, lane & 3}, x[0], o.quotient);
    o.small = x[0];
    o.large = x[n - 1];
    smaller_first(o.small, o.large);
    o.power = dynamic_index(1.25, thread);
    o.whole = static_cast<long long>(o.root * 1e6);
    o.divided = (thread * 1000003 - 77777) / 7 - thread % 5 + (o.whole << 3 >> 1);
}

template __global__ void sums<2>(Input, Output*, int);
template __global__ void sums<3>(Input, Output*, int);

/// The barrier between writing and reading is missing.
__global__ void forgets(const double* in, double* out)
{
    extern __shared__ double values[];
    values[threadIdx.x] = in[threadIdx.x];
    out[threadIdx.x] = values[(threadIdx.x + 1) % lanes];
}

/// As `forgets`, with the barrier.
__global__ void remembers(const double* in, double* out)
{
    extern __shared__ double values[];
    values[threadIdx.x] = in[threadIdx.x];
    __syncwarp();
    out[threadIdx.x] = values[(threadIdx.x + 1) % lanes];
}

/// The lower and the upper half wait at different instructions.
__global__ void parts(const double* in, double* out)
{
    if (threadIdx.x < lanes / 2) {
        __syncwarp();
        out[threadIdx.x] = in[0];
    } else
        out[threadIdx.x] = __shfl_sync(~0U, in[threadIdx.x], 3);
}

/// Some lanes end, and the others wait for them.
__global__ void leaves(const double* in, double* out)
{
    if (in[threadIdx.x] < 0)
        return;
    __syncwarp();
    out[threadIdx.x] = in[threadIdx.x];
}

/// Not all lanes are waited for.
__global__ void few(const double* in, double* out)
{
    out[threadIdx.x] = __shfl_sync(0xffffU, in[threadIdx.x], 3);
}

} // namespace tiny
