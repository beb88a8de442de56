#pragma once
/// Ground-motion records: files of any known format, and what they amount to.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stylobate::api {

/// Intensity measures of a ground motion. Those of the acceleration are of the record as it stands; velocity and
/// displacement are taken after the correction of the baseline.
struct Intensity {
    double pga_m_s2 = 0;
    double pgv_m_s = 0;
    double pgd_m = 0;
    double arias_m_s = 0;                ///< pi / (2 g) times the integral of a2
    double d5_95_s = 0;                  ///< from 5 to 95 % of it
    double cav_m_s = 0;                  ///< cumulative absolute velocity: integral of |a|
    double predominant_frequency_hz = 0; ///< peak of the smoothed Fourier amplitude (Konno and Ohmachi, b = 40)
    double mean_frequency_hz = 0;        ///< inverse of the mean period of Rathje et al. (2004)
};

/// One component of a record. A copy is cheap.
class Record {
public:
    /// Reads a component; the format is recognised from the content (PEER AT2, COSMOS, ESM, K-NET, plain columns and
    /// others, as `stylobate record` has them).
    /// @param component its name, its orientation or the number of its column; nullopt: the only one there is
    /// @param unit of the acceleration: "g", "m/s2", "cm/s2", "mm/s2"; nullopt: the file must give it
    /// @throws InputError if the file cannot be read, is damaged or of no known format, has no such component or
    ///         several where none is named, or if its unit is not known
    static Record read(const std::filesystem::path& file, const std::optional<std::string>& component = {},
                       const std::optional<std::string>& unit = {});

    /// A record from samples of the acceleration, at rest before the first one.
    /// @param acceleration_m_s2 10 samples at least
    /// @param name for messages and for the text of the study
    /// @throws InputError if there are too few samples, one of them is not finite, all are zero, or dt_s <= 0
    static Record from_samples(std::vector<double> acceleration_m_s2, double dt_s, const std::string& name = "samples");

    const std::vector<double>& acceleration_m_s2() const; ///< (n) as in the file
    double dt_s() const;
    double duration_s() const;
    std::string file() const;
    std::string format() const; ///< "peer-at2", "columns" and so on; "samples" where it was not read
    std::string component() const;
    std::string title() const; ///< event and station, from the file

    /// @throws InputError if there is nothing to integrate: all samples are equal
    Intensity intensity() const;
    /// Pseudo-acceleration of an oscillator that starts at rest, exact for an acceleration that is linear between the
    /// samples.
    /// @param periods_s (n) not negative; period 0: the PGA
    /// @param damping_ratio in [0, 1)
    /// @return (n) [m/s2]
    /// @throws InputError if a period or the damping ratio is out of range
    std::vector<double> spectral_acceleration_m_s2(const std::vector<double>& periods_s,
                                                   double damping_ratio = 0.05) const;

    Record(const Record&) = default;
    Record& operator=(const Record&) = default;

private:
    struct Data;
    friend struct Inside;
    explicit Record(std::shared_ptr<const Data> data);
    std::shared_ptr<const Data> data_;
};

} // namespace stylobate::api
