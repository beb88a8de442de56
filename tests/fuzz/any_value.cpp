#include "tests/fuzz/any_value.hpp"

#include <limits>

namespace stylobate::fuzz {

double any_double(ByteSource& recipe)
{
    constexpr double inf = std::numeric_limits<double>::infinity();
    constexpr double values[] = {
        0,   -0.0, 1,    -1,   0.5,   2,      3,      100, 1000, 1e6,
        1e9, 1e19, 1e-9, 1e-3, 1e300, 5e-324, -1e300, inf, -inf, std::numeric_limits<double>::quiet_NaN(),
        255, 256,  4e9,  9e15};
    const std::uint8_t which = recipe.byte();
    return which < std::size(values) ? values[which] : recipe.number<std::int16_t>() * (which % 2 == 0 ? 1.0 : 0.001);
}

std::uint64_t any_count(ByteSource& recipe)
{
    const std::uint8_t which = recipe.byte();
    if (which < 64)
        return std::uint64_t{1} << which;
    if (which < 128)
        return (std::uint64_t{1} << (which - 64)) - 1;
    return which < 192 ? which - 128u : ~std::uint64_t{0} - (which - 192u);
}

std::string any_text(const std::string& before, ByteSource& recipe)
{
    static const char* const texts[] = {"",
                                        " ",
                                        "\n",
                                        "a\nb",
                                        "a\n\nb",
                                        "stylobate",
                                        "stylobate-measured",
                                        "surface",
                                        "replay",
                                        "fragility",
                                        "rare",
                                        "friction[0] friction[0]",
                                        "friction[999999]",
                                        "a[",
                                        "a[]",
                                        "a[1]x",
                                        "1/2",
                                        "3/2",
                                        "999999999999/1",
                                        "mm",
                                        "deg",
                                        "kg",
                                        "m/s2",
                                        "command",
                                        "table sensor",
                                        "[study]\nseed = 1\n"};
    std::string text = before;
    switch (recipe.below(4)) {
    case 0:
        return texts[recipe.below(std::size(texts))];
    case 1:
        return recipe.text(12);
    case 2:
        text.resize(recipe.below(text.size() + 1));
        return text;
    default:
        text.insert(recipe.below(text.size() + 1), recipe.text(4));
        return text;
    }
}

} // namespace stylobate::fuzz
