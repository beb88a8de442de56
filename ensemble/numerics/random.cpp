#include "ensemble/numerics/random.hpp"

#include <Random123/philox.h>

namespace stylobate {

std::uint64_t random_bits(std::uint64_t seed, std::uint64_t index, Stream stream, std::uint64_t element)
{
    using Philox = r123::Philox4x64;
    const Philox::key_type key = {{seed, index}};
    const Philox::ctr_type counter = {{static_cast<std::uint64_t>(stream), element, 0, 0}};
    return Philox()(counter, key)[0];
}

double to_uniform01(std::uint64_t bits)
{
    // The highest 53 bits with the last one set: with 53 free bits one end of the interval would have to be in it.
    return static_cast<double>((bits >> 11) | 1U) * 0x1p-53;
}

double uniform01(std::uint64_t seed, std::uint64_t index, Stream stream, std::uint64_t element)
{
    return to_uniform01(random_bits(seed, index, stream, element));
}

} // namespace stylobate
