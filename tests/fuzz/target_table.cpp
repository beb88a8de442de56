/// CSV tables. The first byte of an input chooses the reader: an odd one that of measured outcomes, an even one that of
/// base motions.

#include "io/measured/measured_file.hpp"
#include "io/measured/measured_motion.hpp"
#include "tests/fuzz/text_mutation.hpp"

#include <cmath>

namespace stylobate::fuzz {
namespace {

void check_outcomes(const OutcomeTable& table, std::size_t bytes)
{
    promise(table.rows.size() <= bytes, "there are more outcomes than bytes");
    for (const MeasuredOutcome& row : table.rows) {
        for (const auto& number : {row.amplitude_m, row.frequency_hz, row.pga_m_s2, row.pgv_over_pga_s})
            promise(!number || (std::isfinite(*number) && *number > 0), "a number of an outcome is not above 0");
        promise(row.motion_file || row.pga_m_s2 || (row.amplitude_m && row.frequency_hz), "an outcome has no motion");
        promise(row.line > 0, "an outcome is of no line");
    }
}

void check_motion(const Motion& motion)
{
    promise(motion.dt_s > 0 && std::isfinite(motion.dt_s), "a base motion has no sampling interval");
    promise(motion.acceleration_m_s2.size() >= 2 && motion.velocity_m_s.size() == motion.acceleration_m_s2.size() &&
                motion.displacement_m.size() == motion.acceleration_m_s2.size(),
            "the lists of a base motion differ in length");
    for (const auto* list : {&motion.acceleration_m_s2, &motion.velocity_m_s, &motion.displacement_m})
        for (const double value : *list)
            promise(std::isfinite(value), "a base motion is not finite");
    promise(motion.pga_m_s2 > 0 && motion.pga_m_s2 <= 1000, "a base does not move, or faster than any");
}

Verdict judge(std::string_view input)
{
    if (input.empty())
        return Verdict::refused;
    const std::filesystem::path file = folder() / "table.csv";
    write_file(file, input.substr(1));
    return judged([&] {
        if (input[0] % 2 != 0)
            check_outcomes(read_outcomes(file), input.size());
        else
            check_motion(read_base_table(file));
    });
}

std::string mutated(std::string_view input, Random& random)
{
    static const std::vector<std::string> words = {
        "fell",
        "collapsed",
        "overturned",
        "toppled",
        "motion_file",
        "amplitude_m",
        "pga_m_s2",
        "amplitude_cm",
        "amplitude_mm",
        "frequency_hz",
        "pga_cm_s2",
        "pga_g",
        "pgv_m_s",
        "pgv_cm_s",
        "pgv_over_pga_s",
        "motion_id",
        "repeat",
        "yes",
        "stood",
        "true",
        "0",
        "1",
        "\"a, b\"",
        "#",
        "time_s",
        "acceleration_m_s2",
        "displacement_m",
        ",",
        ";",
        "\t",
    };
    return mutated_text(input, random, words);
}

} // namespace

const Target table_target = {"table", judge, mutated, 1024, 5000};

} // namespace stylobate::fuzz
