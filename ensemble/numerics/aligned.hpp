#pragma once
/// Memory for the kernels: aligned to a cache line, initialized with zero.

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

namespace stylobate {

struct AlignedFree {
    void operator()(void* p) const { std::free(p); }
};
template <class Number>
using AlignedArray = std::unique_ptr<Number[], AlignedFree>;

template <class Number>
AlignedArray<Number> aligned_array(std::size_t numbers)
{
    const std::size_t bytes = (numbers * sizeof(Number) + 63) / 64 * 64;
    auto* memory = static_cast<Number*>(std::aligned_alloc(64, bytes));
    if (memory == nullptr)
        throw std::bad_alloc();
    std::fill(memory, memory + bytes / sizeof(Number), Number{0});
    return AlignedArray<Number>(memory);
}

} // namespace stylobate
