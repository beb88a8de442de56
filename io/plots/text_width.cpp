#include "io/plots/text_width.hpp"

#include "io/files/utf8.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace stylobate {
namespace {

/// Advance widths of DejaVu Sans 2.37, in thousandths of the type's height, from the blank to the tilde.
constexpr std::array<std::uint16_t, 95> advance{
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361,  318, 337, 636, 636, 636,
    636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632,
    575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635,  611, 732, 684, 989, 685,
    611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352,  635, 634, 278, 278, 579,
    278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592,  525, 636, 337, 636, 838};
constexpr double letter = 0.62; ///< of an alphabet beyond ASCII, about
constexpr double sign = 0.838;  ///< ±, ×, ≤, ∞, →

} // namespace

double text_width(std::string_view text)
{
    double sum = 0;
    while (!text.empty()) {
        const std::size_t length = std::max<std::size_t>(utf8_length(text), 1);
        const std::string_view one = text.substr(0, length);
        if (length == 1) {
            const auto code = static_cast<unsigned char>(one[0]);
            sum += code >= 32 && code < 127 ? advance[code - 32U] / 1000.0 : letter;
        } else if (one == "·") {
            sum += 0.318;
        } else if (one == "²" || one == "³" || one == "°" || one == "–") {
            sum += 0.45;
        } else {
            sum += length == 2 && one != "±" && one != "×" ? letter : sign;
        }
        text.remove_prefix(length);
    }
    return sum;
}

} // namespace stylobate
