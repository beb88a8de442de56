/// Readers of ground motions. The first byte of an input says what unit is given with the file: with none, the formats
/// that state their own are reached, with one, the others.

#include "io/records/record.hpp"
#include "tests/fuzz/text_mutation.hpp"

#include <cmath>

namespace stylobate::fuzz {
namespace {

Verdict judge(std::string_view input)
{
    if (input.empty())
        return Verdict::refused;
    return judged([&] {
        for (const Record& record : read_records(input.substr(1), "fuzz", std::string(input[0] % 2 == 0 ? "" : "g"))) {
            promise(record.dt_s > 0 && std::isfinite(record.dt_s), "a record has no sampling interval");
            promise(record.acceleration_m_s2.size() >= 2, "a record has no samples");
            for (const double a : record.acceleration_m_s2)
                promise(std::fabs(a) <= largest_pga_m_s2, "a sample is larger than the limit");
            promise(!record.header_pga_m_s2 || (std::isfinite(*record.header_pga_m_s2) && *record.header_pga_m_s2 > 0),
                    "the peak of a header is none");
        }
    });
}

std::string mutated(std::string_view input, Random& random)
{
    return mutated_text(input, random, {});
}

} // namespace

const Target record_target = {"record", judge, mutated, 4096, 10000};

} // namespace stylobate::fuzz
