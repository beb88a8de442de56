/// Fragility functions in NRML. What was read is written again and read again: it must be the same.

#include "io/tables/fragility_exchange.hpp"
#include "tests/fuzz/text_mutation.hpp"

#include <cmath>

namespace stylobate::fuzz {
namespace {

/// But for the conversion of units and of a mean and a standard deviation, there and back.
bool near(double a, double b)
{
    return a == b || std::fabs(a - b) <= 1e-9 * std::max(std::fabs(a), std::fabs(b));
}

void check_same(const FragilityModel& a, const FragilityModel& b)
{
    promise(a.limit_states == b.limit_states, "limit states change when they are written");
    promise(a.functions.size() == b.functions.size(), "functions are lost when they are written");
    for (std::size_t f = 0; f < a.functions.size(); ++f) {
        const FragilityFunction &x = a.functions[f], &y = b.functions[f];
        promise(x.measure == y.measure && x.discrete == y.discrete, "a function changes when it is written");
        promise(near(x.least, y.least) && near(x.most, y.most), "a range changes when it is written");
        promise(x.intensity.size() == y.intensity.size() && x.states.size() == y.states.size(),
                "a function changes its length when it is written");
        for (std::size_t i = 0; i < x.intensity.size(); ++i)
            promise(near(x.intensity[i], y.intensity[i]), "an intensity changes when it is written");
        for (std::size_t s = 0; s < x.states.size(); ++s) {
            promise(near(x.states[s].median.value, y.states[s].median.value), "a median changes when it is written");
            // a small dispersion is what is left of 1 + its square
            promise(std::fabs(x.states[s].dispersion.value - y.states[s].dispersion.value) <=
                        1e-7 * std::max(1.0, x.states[s].dispersion.value),
                    "a dispersion changes when it is written");
            promise(x.states[s].probability.size() == y.states[s].probability.size(),
                    "probabilities are lost when they are written");
            for (std::size_t i = 0; i < x.states[s].probability.size(); ++i)
                promise(x.states[s].probability[i].value == y.states[s].probability[i].value,
                        "a probability changes when it is written");
        }
    }
}

Verdict judge(std::string_view input)
{
    const std::filesystem::path file = folder() / "fragility.xml", again = folder() / "again.xml";
    write_file(file, input);
    FragilityModel model;
    const Verdict verdict = judged([&] { model = read_fragility_nrml(file); });
    if (verdict == Verdict::accepted) {
        write_file(again, fragility_nrml(model));
        check_same(model, read_fragility_nrml(again));
    }
    return verdict;
}

std::string mutated(std::string_view input, Random& random)
{
    static const std::vector<std::string> words = {
        "<poes ls=\"a\">0.1 0.2</poes>",
        "<params ls=\"a\" mean=\"1\" stddev=\"0.5\"/>",
        "</fragilityFunction>",
        "format=\"discrete\"",
        "format=\"continuous\"",
        "shape=\"logncdf\"",
        "imt=\"SA(0.5)\"",
        "imt=\"PGV\"",
        "PGA",
        "IA",
        "CAV",
        "<!-- -->",
        "&amp;",
        "&#0;",
        "<![CDATA[a]]>",
        "minIML",
        "maxIML",
        "noDamageLimit",
    };
    return mutated_text(input, random, words);
}

} // namespace

const Target nrml_target = {"nrml", judge, mutated, 2048, 5000};

} // namespace stylobate::fuzz
