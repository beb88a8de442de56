#pragma once
/// Errors of the simulation against measured data, and their cause.

#include "stylobate/study.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::api {

enum class Verdict {
    none,       ///< the simulation agrees with the measurement within the scatter of repeats and the noise of sensors
    named,      ///< one mechanism, or a set that these data cannot distinguish, explains the errors
    unexplained ///< no known mechanism explains the errors
};

/// A mechanism that the verdict names. What could not be estimated is nullopt.
struct Cause {
    std::string mechanism;       ///< as in study files: "joint_friction"
    std::string place;           ///< "joint 0", "block 2", "base", "all joints"
    std::string parameter;       ///< "ratio", "velocity_m_s"
    std::string unit;            ///< of the three numbers that follow; "" for a ratio
    std::optional<double> size;  ///< best fit
    std::optional<double> lower; ///< 95 % interval
    std::optional<double> upper;
    std::optional<double> probability; ///< of being the cause, among the mechanisms that were judged
    std::optional<double> gain_nats;   ///< log likelihood gained over the calibrated baseline
    std::optional<double> p;           ///< probability of such a gain where the mechanism is absent
};

/// What the extended model gains on runs that were not used to find or fit it; the calibrated baseline has error 1
/// unless the unit says otherwise.
struct Gain {
    std::optional<double> error_before;
    std::optional<double> error_after;
    std::optional<double> lower; ///< 95 % interval of the error after
    std::optional<double> upper;
    std::string unit;
};

struct DiagnosisOptions {
    std::optional<Study> study = {}; ///< contacts to begin with; its structure is the specimen's. None: a bed of stone
    /// Healthy campaigns that are simulated near the measured contact law; others in proportion. 0: none are simulated,
    /// and only direct tests name a cause. With fewer than about 50 no cause can be significant.
    std::uint64_t nulls = 192;
    std::uint64_t seed = 1;    ///< of what is drawn in them
    int threads = 0;           ///< 0: as many as the process may use
    std::string simd = "auto"; ///< as `RunOptions::simd`
    /// Keeps the simulated campaigns, so that a stopped diagnosis goes on. Nullopt: they are not kept.
    std::optional<std::filesystem::path> cache = {};
    std::function<void(const std::string& line)> tell = {}; ///< called with each stage, as a line of text; may be empty
    std::function<bool()> go_on = {};                       ///< polled from time to time; false: stop. May be empty
};

/// A copy is cheap.
class Diagnosis {
public:
    Verdict verdict() const;
    std::string verdict_text() const;  ///< in plain words, one to three sentences
    std::vector<Cause> causes() const; ///< most probable first; empty where the verdict is `none`
    std::optional<Gain> gain() const;
    std::optional<std::string> extended_study() const; ///< the baseline with the cause in it (TOML); nullopt: none
    std::string text() const;                          ///< the page that the command line prints
    std::string json() const;                          ///< all of it, for other programs

    /// Writes the file that `stylobate report` takes, whole or not at all.
    /// @throws InputError if it cannot be written
    void write(const std::filesystem::path& file) const;

    Diagnosis(const Diagnosis&) = default;
    Diagnosis& operator=(const Diagnosis&) = default;

private:
    struct Data;
    friend struct Inside;
    explicit Diagnosis(std::shared_ptr<const Data> data);
    std::shared_ptr<const Data> data_;
};

/// Diagnoses a measured campaign.
/// @param measured an HDF5 file, or a folder of tables, as `stylobate diagnose` takes it
/// @return nothing if `go_on` stopped it
/// @throws InputError if it cannot be read, or if its data cannot be diagnosed at all
std::optional<Diagnosis> diagnose(const std::filesystem::path& measured, const DiagnosisOptions& options = {});

} // namespace stylobate::api
