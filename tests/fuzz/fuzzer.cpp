/// libFuzzer's entry to one target (STYLOBATE_FUZZ_TARGET): option STYLOBATE_FUZZ, scripts/fuzz.sh.

#include "tests/fuzz/target.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {
const stylobate::fuzz::Target& target = stylobate::fuzz::STYLOBATE_FUZZ_TARGET;
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        target.judge({reinterpret_cast<const char*>(data), size});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "finding: %s\n", error.what());
        std::abort();
    }
    return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed)
{
    stylobate::fuzz::Random random(seed);
    if (random() % 4 == 0) // libFuzzer knows which bytes were compared with which
        return LLVMFuzzerMutate(data, size, most);
    const std::string made = target.mutated({reinterpret_cast<const char*>(data), size}, random);
    const std::size_t kept = std::min({made.size(), most, target.most_bytes});
    std::copy_n(made.data(), kept, reinterpret_cast<char*>(data));
    return kept;
}
