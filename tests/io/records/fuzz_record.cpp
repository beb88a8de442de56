/// Feeds any bytes to the readers of ground motions, under libFuzzer: option STYLOBATE_FUZZ, scripts/fuzz.sh.
///
/// The first byte says what unit is given with the file: with none, the formats that state their own are reached, with
/// one, the others. Whatever the bytes are, they are refused with an InputError or are records with the promised
/// properties.

#include "ensemble/model/input_error.hpp"
#include "io/records/record.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace stylobate;
    if (size == 0)
        return 0;
    const std::string unit = data[0] % 2 == 0 ? "" : "g";
    const std::string_view content(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        for (const Record& record : read_records(content, "fuzz", unit)) {
            bool sound = record.dt_s > 0 && std::isfinite(record.dt_s) && record.acceleration_m_s2.size() >= 2;
            for (const double a : record.acceleration_m_s2)
                sound = sound && std::fabs(a) <= largest_pga_m_s2;
            if (record.header_pga_m_s2)
                sound = sound && std::isfinite(*record.header_pga_m_s2) && *record.header_pga_m_s2 > 0;
            if (!sound)
                std::abort();
        }
    } catch (const InputError&) {
        // refused
    }
    return 0;
}
