/// The synthetic excitations of a study file: what is read, and what is refused with which words.

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stylobate {
namespace {

const std::string structure = R"([structure]
blocks = 7
fixed_blocks = 1
drum_width_m = 0.048
drum_height_m = 0.029
depth_m = 0.048
drum_mass_kg = 0.1355
[contact]
normal_stiffness_n_m2 = 1e8
friction = 0.68
)";

/// A study with [excitation] in line 3.
std::string single(const std::string& excitation)
{
    return "[study]\nkind = \"single\"\n[excitation]\n" + excitation + "\n" + structure;
}

/// A surface with [excitation] in line 4, of 15 cells with one realization each; its axis of frequencies is in the
/// second line after the excitation.
std::string surface(const std::string& excitation, const std::string& to = "to = 8")
{
    return "[study]\nkind = \"surface\"\nrealizations = 1\n[excitation]\n" + excitation +
           "\n[surface]\nfrequency_hz = { from = 0.5, count = 5, " + to +
           " }\npga_m_s2 = { from = 1, to = 9, count = 3 }\n" + structure;
}

/// Expects a refusal in a line whose message has all the words.
void expect_refused(const std::string& text, int line, const std::vector<std::string>& words)
{
    try {
        parse_study(text, "temple.toml");
        ADD_FAILURE() << "accepted; expected a refusal in line " << line << "\n" << text;
    } catch (const InputError& error) {
        const std::string message = error.what(), place = "temple.toml:" + std::to_string(line) + ": ";
        EXPECT_EQ(message.substr(0, place.size()), place) << message;
        for (const std::string& word : words)
            EXPECT_NE(message.find(word), std::string::npos) << "no '" << word << "' in:\n" << message;
    }
}

TEST(StudyExcitation, ReadsTheSyntheticExcitations)
{
    const std::string at = "frequency_hz = 2\npga_m_s2 = 3\n";
    const auto e = [&](const std::string& text) { return parse_study(single(text), "temple.toml").excitation; };
    EXPECT_EQ(e("kind = \"ricker\"\n" + at).kind, ExcitationKind::ricker);

    const auto pulse = e("kind = \"pulse\"\n" + at + "gamma = 1.7\nphase_rad = 1.2");
    EXPECT_EQ(pulse.kind, ExcitationKind::pulse);
    EXPECT_EQ(pulse.frequency_hz, 2);
    EXPECT_EQ(pulse.pga_m_s2, 3);
    EXPECT_EQ(pulse.gamma, 1.7);
    EXPECT_EQ(pulse.phase_rad, 1.2);
    EXPECT_EQ(e("kind = \"pulse\"\n" + at).gamma, 2);

    const auto tapered = e("kind = \"tapered\"\n" + at + "ramp_cycles = 1.5\ncycles = 3");
    EXPECT_EQ(tapered.kind, ExcitationKind::tapered);
    EXPECT_EQ(tapered.ramp_cycles, 1.5);
    EXPECT_EQ(tapered.cycles, 3);

    const auto sweep =
        e("kind = \"sweep\"\nfrom_hz = 1\nto_hz = 16\nduration_s = 30\npga_m_s2 = 3\nspacing = \"linear\"");
    EXPECT_EQ(sweep.from_hz, 1);
    EXPECT_EQ(sweep.to_hz, 16);
    EXPECT_EQ(sweep.duration_s, 30);
    EXPECT_EQ(sweep.spacing, Spacing::linear);
    EXPECT_EQ(sweep.central_frequency_hz(), 4);

    const auto noise = e("kind = \"noise\"\n" + at +
                         "pga_of = \"mean\"\nground_damping_ratio = 0.4\nlow_cut_ratio = 0.2\n"
                         "low_cut_damping_ratio = 0.5\nrise_s = 1\nstrong_s = 0\ndecay_s = 2");
    EXPECT_EQ(noise.pga_of, PgaOf::mean);
    EXPECT_EQ(noise.ground_damping_ratio, 0.4);
    EXPECT_EQ(noise.low_cut_ratio, 0.2);
    EXPECT_EQ(noise.low_cut_damping_ratio, 0.5);
    EXPECT_EQ(noise.rise_s, 1);
    EXPECT_EQ(noise.strong_s, 0);
    EXPECT_EQ(noise.decay_s, 2);
    EXPECT_EQ(e("kind = \"noise\"\n" + at).pga_of, PgaOf::realization);

    const auto record = e("kind = \"record\"\nfile = \"a\"\nband_pass_hz = [0.1, 25]");
    ASSERT_TRUE(record.band_pass);
    EXPECT_EQ(record.band_pass->low_hz, 0.1);
    EXPECT_EQ(record.band_pass->high_hz, 25);
    EXPECT_FALSE(e("kind = \"record\"\nfile = \"a\"").band_pass);
    EXPECT_EQ(
        parse_study(single("kind = \"record\"\nfile = \"a\""), "temple.toml", {"excitation.band_pass_hz=[0.2, 30.5]"})
            .excitation.band_pass->high_hz,
        30.5);
}

TEST(StudyExcitation, RefusesSyntheticExcitationsThatMakeNoSense)
{
    const auto refused = [](const std::string& excitation, int line, const std::vector<std::string>& words) {
        expect_refused(single(excitation), 3 + line, words);
    };
    const std::string at = "frequency_hz = 2\npga_m_s2 = 3\n"; // lines 2 and 3
    const std::string pulse = "kind = \"pulse\"\n" + at, tapered = "kind = \"tapered\"\n" + at,
                      noise = "kind = \"noise\"\n" + at, record = "kind = \"record\"\nfile = \"a\"\n",
                      sweep = "kind = \"sweep\"\npga_m_s2 = 3\n";
    refused("kind = \"ricker\"\npga_m_s2 = 3", 0, {"excitation.frequency_hz is missing"});
    refused("kind = \"ricker\"\n" + at + "cycles = 3", 4, {"not used by excitation.kind = \"ricker\""});
    refused(pulse + "gamma = 0.5", 4, {"excitation.gamma = 0.5 is outside [1, 20]", "envelope"});
    refused(pulse + "gama = 2", 4, {"unknown key excitation.gama", "Did you mean gamma?"});
    refused(tapered + "ramp_cycles = 0.5", 4, {"outside [1, 5000]", "abrupt start"});
    refused(tapered + "cycles = 3", 4, {"two ramps of 2 cycles each in 3 cycles", "shorter ramps."});
    refused(tapered + "start = \"smooth\"", 4, {"not used by excitation.kind = \"tapered\""});
    refused(sweep + "from_hz = 1\nduration_s = 9", 0, {"excitation.to_hz is missing"});
    refused(sweep + "from_hz = 2\nto_hz = 2\nduration_s = 9", 4, {"is from_hz too", "harmonic"});
    refused(sweep + "from_hz = 1\nto_hz = 2\nduration_s = 2", 5, {"does not fit", "longer duration_s"});
    refused(sweep + "from_hz = 100\nto_hz = 900\nduration_s = 100", 5, {"cycles, more than 10000"});
    refused(sweep + "from_hz = 1\nto_hz = 2\nramp_cycles = 1e-9\nduration_s = 0.01", 6, {"makes 0.014 cycles"});
    refused("kind = \"harmonic\"\nstart = \"abrupt\"\nend = \"abrupt\"\n" + at + "cycles = 0.01", 6,
            {"excitation.cycles = 0.01 is outside [0.1, 10000]", "no motion"});
    refused(sweep + "frequency_hz = 1", 3, {"not used by excitation.kind = \"sweep\"", "from_hz"});
    refused("kind = \"noise\"\nfrequency_hz = 40\npga_m_s2 = 1", 2, {"outside [0.05, 25]", "ground"});
    refused(noise + "ground_damping_ratio = 60", 4, {"outside [0.05, 0.95]", "Did you mean 0.600 (60 %)?"});
    // a burst without a sample, and one of less than 20
    refused(noise + "strong_s = 0\nrise_s = 1e-9\ndecay_s = 1e-9", 4, {"strong_s = 0 gives noise of 6e-09 s", "0.1 s"});
    refused(noise + "rise_s = 0.01\ndecay_s = 0.005\nstrong_s = 0.06", 6, {"noise of 0.095 s", "too few samples"});
    refused(noise + "rise_s = 0", 4, {"outside (0, 60]"});
    refused(noise + "pga_of = \"median\"", 4, {"\"realization\", \"mean\""});
    refused(noise + "phase_rad = 1", 4, {"not used by excitation.kind = \"noise\""});
    refused(record + "band_pass_hz = 0.1", 3, {"is not two numbers in brackets", "[LOW, HIGH]"});
    refused(record + "band_pass_hz = [0.1]", 3, {"is not two numbers in brackets"});
    refused(record + "band_pass_hz = [0.1, \"x\"]", 3, {"contains \"x\", which is a string, not a number"});
    refused(record + "band_pass_hz = [0, 20]", 3, {"contains 0, which is outside [0.01, 1000]"});
    refused(record + "band_pass_hz = [20, 0.1]", 3, {"has 20 before 0.1", "the smaller one first"});
    refused(record + "band_pass_hz = [0.1, 20]\nbaseline = false", 3, {"excitation.baseline = false"});
}

TEST(StudyExcitation, RefusesAxesThatTheNoiseCannotHave)
{
    expect_refused(surface("kind = \"noise\"\nfrequency_hz = 2"), 6, {"[surface]"});
    expect_refused(surface("kind = \"sweep\"\nfrom_hz = 1\nto_hz = 9\nduration_s = 30\npga_m_s2 = 2"), 9,
                   {"excitation.pga_m_s2", "[surface]"});
    EXPECT_EQ(parse_study(surface("kind = \"noise\""), "temple.toml").total(), 15u);
    expect_refused(surface("kind = \"noise\"", "to = 80"), 7, {"surface.frequency_hz", "outside [0.05, 25]", "noise"});
    EXPECT_EQ(parse_study(surface("kind = \"ricker\"", "to = 80"), "temple.toml").total(), 15u);
}

TEST(StudyExcitation, PulsesHaveQuantitiesOfTheirOwn)
{
    const auto of = [](const std::string& text) { return parse_study(text, "temple.toml").perturbations.at(0); };
    const std::string at = "frequency_hz = 2\npga_m_s2 = 3", pulse = "kind = \"pulse\"\n" + at;
    const std::string gamma = "[perturbation]\npulse_gamma = { distribution = \"uniform\", from = 1, to = 3 }\n",
                      phase = "[perturbation]\nphase = { distribution = \"uniform\" }\n",
                      frequency = "[perturbation]\npulse_frequency = { distribution = \"normal\", sd_hz = 0.1 }\n";
    EXPECT_EQ(of(gamma + single(pulse)).quantity, Quantity::pulse_gamma);
    EXPECT_EQ(of(phase + single(pulse)).quantity, Quantity::phase);
    EXPECT_EQ(of(phase + single("kind = \"tapered\"\n" + at)).quantity, Quantity::phase);
    EXPECT_EQ(of(frequency + single(pulse)).sd, 0.1);
    EXPECT_EQ(of(gamma + surface("kind = \"pulse\"")).quantity, Quantity::pulse_gamma);

    expect_refused(gamma + single("kind = \"ricker\"\n" + at), 2,
                   {"perturbation.pulse_gamma", "\"ricker\"", "\"pulse\""});
    expect_refused(phase + single("kind = \"ricker\"\n" + at), 2, {"perturbation.phase", "\"ricker\""});
    expect_refused(frequency + single("kind = \"noise\"\n" + at), 2, {"perturbation.pulse_frequency", "\"noise\""});
    expect_refused(frequency + surface("kind = \"pulse\""), 2, {"perturbation.pulse_frequency", "axis"});
    expect_refused("[perturbation]\npulse_gamma = { distribution = \"normal\", sd = 0.5 }\n" + single(pulse), 2,
                   {"perturbation.pulse_gamma.min is missing"});
}

} // namespace
} // namespace stylobate
