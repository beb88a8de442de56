/// Hazard curves. An input is the measure that is asked for and a site, in its first line, and then files with a line
/// "@" before each, or power laws. What was accepted is written as a table and read again: it must be the same.

#include "ensemble/estimators/risk/hazard_curve.hpp"
#include "io/hazard/hazard_file.hpp"
#include "tests/fuzz/text_mutation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace stylobate::fuzz {
namespace {

bool is_curve(const HazardModel& hazard, const std::vector<double>& frequency)
{
    if (frequency.size() != hazard.intensity.size())
        return false;
    for (std::size_t i = 0; i < frequency.size(); ++i)
        if (!(frequency[i] > 0) || !std::isfinite(frequency[i]) || (i > 0 && frequency[i] > frequency[i - 1]))
            return false;
    return frequency.back() < frequency[frequency.size() - 2];
}

void check(const HazardModel& hazard, const std::string& measure)
{
    promise(hazard.measure == measure, "a hazard of another measure is taken");
    const std::vector<double>& x = hazard.intensity;
    promise(x.size() >= 2, "a hazard curve has no two points");
    for (std::size_t i = 0; i < x.size(); ++i)
        promise(x[i] > (i == 0 ? 0 : x[i - 1]) && std::isfinite(x[i]), "intensities do not ascend from above 0");
    promise(is_curve(hazard, hazard.frequency), "a hazard curve does not decrease");
    for (std::size_t f = 0; f < hazard.fractiles.size(); ++f) {
        const double p = hazard.fractiles[f].probability;
        promise(p > (f == 0 ? 0 : hazard.fractiles[f - 1].probability) && p < 1, "fractiles do not ascend in (0, 1)");
        promise(is_curve(hazard, hazard.fractiles[f].frequency), "a fractile does not decrease");
    }
    const HazardCurve curve(x, hazard.frequency); // what a risk estimate asks of it
    for (std::size_t i = 0; i < x.size(); ++i)
        promise(std::fabs(std::log(curve.frequency(std::log(x[i])) / hazard.frequency[i])) < 1e-3,
                "the curve does not pass through a point");
}

std::string table_of(const HazardModel& hazard)
{
    std::string text = hazard.measure + ",annual_frequency";
    for (const HazardFractile& f : hazard.fractiles)
        text += fmt::format(",fractile_{}", f.probability);
    for (std::size_t i = 0; i < hazard.intensity.size(); ++i) {
        text += fmt::format("\n{},{}", hazard.intensity[i], hazard.frequency[i]);
        for (const HazardFractile& f : hazard.fractiles)
            text += fmt::format(",{}", f.frequency[i]);
    }
    return text + "\n";
}

void check_written_again(const HazardModel& hazard)
{
    const std::filesystem::path file = folder() / "again.csv";
    write_file(file, table_of(hazard));
    HazardModel again;
    try {
        again = read_hazard({file.string()}, hazard.measure);
    } catch (const InputError& error) {
        throw Finding(std::string("the table of a hazard is refused: ") + error.what());
    }
    promise(again.intensity == hazard.intensity && again.frequency == hazard.frequency,
            "a hazard changes when it is written");
    promise(again.fractiles.size() == hazard.fractiles.size(), "fractiles are lost when they are written");
    for (std::size_t f = 0; f < again.fractiles.size(); ++f)
        promise(again.fractiles[f].probability == hazard.fractiles[f].probability &&
                    again.fractiles[f].frequency == hazard.fractiles[f].frequency,
                "a fractile changes when it is written");
}

Verdict judge(std::string_view input)
{
    const auto line_of = [&] {
        const std::string_view line = input.substr(0, input.find('\n'));
        input.remove_prefix(std::min(line.size() + 1, input.size()));
        return line;
    };
    std::string_view first = line_of();
    first = first.substr(0, first.find('\0')); // on the command line there is no zero byte
    const std::size_t blank = std::min(first.find(' '), first.size());
    const std::string measure(first.substr(0, blank)), site(first.substr(std::min(blank + 1, first.size())));
    std::vector<std::string> given;
    while (!input.empty() && given.size() < 3) {
        if (input.front() != '@') { // a power law
            const std::string law(line_of());
            if (law.find('=') != std::string::npos && law.find('\0') == std::string::npos)
                given.push_back(law);
            continue;
        }
        line_of();
        const std::size_t end = input.starts_with('@') ? 0 : std::min(input.find("\n@"), input.size() - 1) + 1;
        given.push_back((folder() / fmt::format("hazard{}", given.size()).c_str()).string());
        write_file(given.back(), input.substr(0, input.empty() ? 0 : end));
        input.remove_prefix(std::min(end, input.size()));
    }
    HazardModel hazard;
    const Verdict verdict = judged([&] { hazard = read_hazard(given, measure, site); });
    if (verdict == Verdict::accepted) {
        check(hazard, measure);
        check_written_again(hazard);
    }
    return verdict;
}

std::string mutated(std::string_view input, Random& random)
{
    static const std::vector<std::string> words = {
        "@\n",
        "pga_g",
        "pga_m_s2",
        "pga_cm_s2",
        "pgv_m_s",
        "pgv_cm_s",
        "pgd_m",
        "arias_m_s",
        "cav_m_s",
        "sa_1s_g",
        "sa_0.5s_m_s2",
        "annual_frequency",
        "low",
        "high",
        "fractile_0.16",
        "fractile_0.5",
        "fractile_1e-300",
        "k0=1e-4,k=2.5,measure=pga_g\n",
        ",sigma_ln=0.5",
        "#,,\"kind='mean', investigation_time=50.0, imt='PGA'\"\n",
        "kind='quantile-0.16'",
        "SA(0.5)",
        "PGV",
        "lon,lat,depth,poe-0.1,poe-0.2\n",
        "<hazardCurve><gml:Point><gml:pos>0 0</gml:pos></gml:Point><poEs>0.5 0.1</poEs></hazardCurve>\n",
        "statistics=\"quantile\" quantileValue=\"0.16\"",
        "investigationTime=\"50\"",
        "IMT=\"SA\" saPeriod=\"0.5\"",
        "<IMLs>0.1 0.2</IMLs>",
        "&#0;",
        "1e-320",
        "0,0\n",
    };
    return mutated_text(input, random, words);
}

} // namespace

const Target hazard_target = {"hazard", judge, mutated, 2048, 2000};

} // namespace stylobate::fuzz
