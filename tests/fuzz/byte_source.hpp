#pragma once
/// A recipe: the bytes of an input, taken one after the other. Where they end, there are zeros.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace stylobate::fuzz {

class ByteSource {
public:
    explicit ByteSource(std::string_view bytes) : bytes_(bytes) {}

    bool empty() const { return bytes_.empty(); }
    std::uint8_t byte() { return number<std::uint8_t>(); }
    template <class Number>
    Number number()
    {
        Number value = 0;
        const std::size_t n = std::min(sizeof value, bytes_.size());
        std::memcpy(&value, bytes_.data(), n);
        bytes_.remove_prefix(n);
        return value;
    }
    /// Below `n`; 0 where n is 0.
    std::size_t below(std::size_t n)
    {
        if (n <= 1)
            return 0;
        return n <= 256 ? byte() % n : number<std::uint32_t>() % n;
    }
    /// Up to `most` bytes.
    std::string text(std::size_t most)
    {
        const std::string taken(bytes_.substr(0, below(most + 1)));
        bytes_.remove_prefix(taken.size());
        return taken;
    }

private:
    std::string_view bytes_;
};

/// Some of the bytes of a file changed, cut off, or more behind the end.
inline std::string damaged_bytes(std::string bytes, ByteSource& recipe)
{
    do {
        const std::uint8_t how = recipe.byte();
        const std::size_t at = recipe.below(bytes.size());
        if (how % 8 == 0)
            bytes.resize(at);
        else if (how % 8 == 1)
            bytes += recipe.text(32);
        else if (at < bytes.size())
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << how % 8));
    } while (!recipe.empty() && !bytes.empty());
    return bytes;
}

} // namespace stylobate::fuzz
