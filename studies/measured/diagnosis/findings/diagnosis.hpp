#pragma once
/// The result of a diagnosis, as plain data: the content of its file, its JSON object and its pages. SI units.
///
/// What is not known or could not be estimated is `std::nullopt`, never a number that stands for it. Texts are plain
/// UTF-8 sentences without markup. Blocks and joints are counted from 0, as in the measured file; block -1 is the base.

#include "io/plots/figure.hpp"
#include "studies/measured/diagnosis/findings/test_story.hpp"
#include "studies/measured/windows/window_motion.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

using MaybeReal = std::optional<double>;

enum class Verdict {
    none,       ///< the simulation agrees with the measurement within what repeats and sensors allow
    named,      ///< one mechanism, or a set that these data do not distinguish, explains the error
    unexplained ///< something is wrong that no known mechanism explains
};

enum class TestOutcome {
    passed,    ///< nothing found
    failed,    ///< found: beyond its threshold
    not_judged ///< the data do not allow the test; the sentence gives the reason
};

/// One test of the base motion or of a sensor, made before any simulation is blamed.
struct DataTest {
    std::string name;  ///< "time_offset", "sensor_gain", ...
    std::string place; ///< "run 004", "base", "block 2 x", ...
    MaybeReal value;
    MaybeReal sd;        ///< of the value
    MaybeReal threshold; ///< beyond which it is a finding
    std::string unit;    ///< of all three; "" for a ratio
    TestOutcome outcome = TestOutcome::not_judged;
    std::string sentence; ///< the result in words
    friend bool operator==(const DataTest&, const DataTest&) = default;
};

/// A parameter of the baseline, calibrated before a mechanism is sought.
struct CalibratedParameter {
    std::string name; ///< key of the study file, or what it is: "contact.friction"
    std::string unit;
    MaybeReal value; ///< in use, also where it was not determined
    MaybeReal low;   ///< 95 % interval
    MaybeReal high;
    bool determined = true; ///< false: the data do not determine it; `value` is the nominal one or an assumption
    std::string note;
    friend bool operator==(const CalibratedParameter&, const CalibratedParameter&) = default;
};

/// A stretch of a run in which the baseline, started from the measured state, is farther off than noise and a short lag
/// make.
struct WrongStretch {
    std::string run;
    int block = 0;          ///< -1: the base
    std::string coordinate; ///< "x", "y" or "theta"
    double from_s = 0;      ///< the cameras' clock
    double to_s = 0;
    double excess = 0; ///< error over what those make, root mean square of the worst window; 2 or more
    friend bool operator==(const WrongStretch&, const WrongStretch&) = default;
};

/// The contribution of one run to the evidence for a candidate.
struct Evidence {
    std::string run;
    MaybeReal gain_nats;             ///< log likelihood with the candidate less that without it
    std::optional<std::string> text; ///< nullopt: the number is sufficient
    friend bool operator==(const Evidence&, const Evidence&) = default;
};

enum class Decision {
    named,     ///< a cause of the verdict
    in_set,    ///< not distinguished from a named one by these data
    not_shown, ///< judged, and neither named nor in the set
    not_judged ///< the data do not allow it; `why` gives what is missing
};

/// A mechanism that was tried as the cause.
struct Candidate {
    std::string mechanism; ///< as in study files: "joint_friction"
    std::string place;     ///< "joint 0", "block 2", "base", "all joints"
    std::string parameter; ///< its parameter: "ratio", "velocity_m_s"
    std::string unit;      ///< of the five numbers that follow; "" for a ratio
    MaybeReal size;        ///< best fit
    MaybeReal low;         ///< 95 % interval
    MaybeReal high;
    MaybeReal neutral;   ///< value at which the baseline is recovered
    MaybeReal gain_nats; ///< log likelihood gained over the calibrated baseline
    MaybeReal null95;    ///< 95 % quantile of that gain where the mechanism is absent [nats]
    MaybeReal p;         ///< probability of such a gain where it is absent
    /// Of being the cause, among the candidates judged, given that one of them is. Nothing where none was computed: it
    /// is computed for causes that are named or in the set, and for a best one that is too improbable to be named.
    MaybeReal probability;
    std::vector<Evidence> evidence; ///< by run
    Decision decision = Decision::not_judged;
    std::string why; ///< of the decision
    friend bool operator==(const Candidate&, const Candidate&) = default;
};

/// Simulated campaigns without any mechanism, to learn how large a gain chance alone gives.
struct NullEnsemble {
    std::string form; ///< contact form
    std::uint64_t campaigns = 0;
    std::string what; ///< what was drawn and refitted in each
    friend bool operator==(const NullEnsemble&, const NullEnsemble&) = default;
};

/// A feature of the motion on which the remaining error was regressed.
struct RegressionFeature {
    std::string name;    ///< "velocity", "amplitude", "cycle", ...
    MaybeReal gain;      ///< share of the remaining variance that it explains on runs left out, 0 to 1
    MaybeReal threshold; ///< share that chance explains at most (95 %)
    friend bool operator==(const RegressionFeature&, const RegressionFeature&) = default;
};

/// What no candidate explains: where it is, and on what it depends.
struct Unexplained {
    int block = 0;                         ///< -1: the base
    std::string coordinate;                ///< "x", "y" or "theta"
    std::optional<std::string> depends_on; ///< name of the leading feature; nullopt: none found
    std::string text;
    std::vector<RegressionFeature> features; ///< most telling first
    friend bool operator==(const Unexplained&, const Unexplained&) = default;
};

/// How well it was known beforehand which runs collapse.
struct CollapsePrediction {
    std::uint64_t runs = 0;         ///< left out, with a known end
    MaybeReal score_before;         ///< mean squared error of the probability of collapse (Brier), calibrated baseline
    MaybeReal score_after;          ///< mean squared error of the extended model
    std::uint64_t right_before = 0; ///< runs whose end was predicted (probability on its side of 1/2)
    std::uint64_t right_after = 0;
    std::optional<std::string> text;
    friend bool operator==(const CollapsePrediction&, const CollapsePrediction&) = default;
};

/// Gain of the extended model on runs that were not used to find or to fit it. Errors are relative to the baseline
/// (error_before = 1) unless `unit` is given.
struct ModelGain {
    MaybeReal error_before; ///< calibrated baseline
    MaybeReal error_after;  ///< extended model
    MaybeReal low;          ///< 95 % interval of error_after
    MaybeReal high;
    std::string unit;
    MaybeReal floor; ///< error that repeats of one motion have among themselves: no model does better
    std::vector<std::string> runs_left_out;
    std::optional<CollapsePrediction> collapse;
    std::optional<std::string> text;
    friend bool operator==(const ModelGain&, const ModelGain&) = default;
};

/// Something that could not be judged.
struct Missing {
    std::string what;
    std::string why; ///< and what would have to be measured
    friend bool operator==(const Missing&, const Missing&) = default;
};

struct DiagnosisCost {
    std::uint64_t simulations = 0;        ///< of whole runs
    std::uint64_t window_simulations = 0; ///< of stretches that start from measured states
    std::uint64_t block_steps = 0;
    double seconds = 0; ///< wall clock
    int threads = 0;
    MaybeReal lockstep_speedup; ///< wide over scalar, measured
    friend bool operator==(const DiagnosisCost&, const DiagnosisCost&) = default;
};

/// To which part of the page a figure belongs.
enum class FigurePlace { verdict, data, baseline, wrong, candidates, unexplained, gain };

struct DiagnosisFigure : Figure {
    FigurePlace place = FigurePlace::wrong;
};

struct Diagnosis {
    // what was diagnosed, with what
    std::string measured_file;
    std::optional<std::string> measured_fingerprint; ///< of its content: "crc32 1a2b3c4d"; nullopt: not known
    std::string specimen;
    std::string study_toml; ///< the baseline, every default filled in
    std::string code_version;
    std::optional<std::string>
        command; ///< the command line that repeats the diagnosis; nullopt: it was made by no command
    std::uint64_t seed = 0;
    std::vector<std::string> options; ///< "threads = 2"
    std::uint64_t runs = 0;           ///< in the measured file
    std::uint64_t runs_used = 0;

    // what was found, in the order in which it was looked for
    std::vector<std::string> data_findings; ///< one sentence each
    std::vector<DataTest> base_tests;
    std::vector<DataTest> sensor_tests;
    std::vector<CalibratedParameter> baseline;
    std::vector<WrongStretch> wrong;   ///< worst first
    std::vector<Candidate> candidates; ///< most probable first
    std::vector<NullEnsemble> nulls;

    // what follows from it
    Verdict verdict = Verdict::none;
    std::string verdict_text; ///< in plain words, one to three sentences
    std::vector<std::string>
        indistinguishable; ///< mechanisms that these data do not distinguish; empty, or two or more
    std::optional<Unexplained> unexplained;
    std::optional<std::string> extended_study;      ///< the baseline with the cause in it (TOML); nullopt: none
    std::optional<std::string> extended_study_file; ///< where it was written; nullopt: not written
    std::optional<ModelGain> gain;
    std::vector<Missing> missing;
    std::vector<std::string> method; ///< in short: one paragraph each
    DiagnosisCost cost;
    std::optional<TestStory> tests; ///< of single joints, and the test to do next; nothing: no joint can be tested
    std::vector<DiagnosisFigure> figures;
    std::optional<WindowMotions> motion; ///< nothing: no window could be simulated, or a file of format version 2
};

/// Words of the file, the JSON object and the pages.
const char* to_string(Verdict verdict);     ///< "none", "named", "unexplained"
const char* to_string(TestOutcome outcome); ///< "passed", "failed", "not judged"
const char* to_string(Decision decision);   ///< "named", "in the set", "not shown by these data", "could not be judged"

/// Those that the verdict names, most probable first; none where the verdict is `none`.
std::vector<const Candidate*> named_causes(const Diagnosis& diagnosis);

/// The candidate of the largest gain with a p-value, where the verdict is `none`; else null.
const Candidate* best_candidate(const Diagnosis& diagnosis);

/// Writes the file whole or not at all; one that is there is replaced.
/// @throws InputError if it cannot be written
void write_diagnosis(const Diagnosis& diagnosis, const std::filesystem::path& file);

/// @throws InputError if there is no such file, if it is none of stylobate's, if it is damaged, if it holds no
///         diagnosis, or if it is of another format version
Diagnosis read_diagnosis(const std::filesystem::path& file);

} // namespace stylobate
