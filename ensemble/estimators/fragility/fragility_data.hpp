#pragma once
/// Outcomes at known intensities, summed by record: the input of every fragility estimate.
///
/// Runs of one record are not independent, so the record is the unit of every interval. Within a record only the number
/// of runs and of those that reached the limit state at each intensity affect a curve. Summed in this way, 60,000 runs
/// of 40 records at 10 intensities are 400 rows and 10 points, and a thousand resamples cost milliseconds.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace stylobate {

// The limits of an interval, and the kinds of maximum of a likelihood.

struct Limits {
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
};

/// Where the maximum of a likelihood is.
enum class Maximum : std::uint8_t {
    inside,    ///< it has its maximum at finite coefficients
    separated, ///< unbounded: a plane separates the runs that reached the limit state from the others
    none,      ///< nothing reached it
    all        ///< everything did
};

/// Runs of one record at one intensity.
struct FragilityRow {
    std::uint32_t record = 0;
    std::uint32_t point = 0; ///< row of `FragilityData::intensity`
    double trials = 0;
    double reached = 0; ///< of them, those that reached the limit state
};

struct FragilityData {
    std::size_t records = 0;
    std::size_t measures = 1;           ///< intensity measures of a run
    std::vector<double> intensity;      ///< (points x measures) distinct, in ascending order, each > 0
    std::vector<FragilityRow> rows;     ///< by record, then point; one for each pair that has runs
    std::vector<std::size_t> first_row; ///< (records + 1) where each record's rows begin

    std::size_t points() const { return intensity.size() / measures; }
    std::span<const FragilityRow> of_record(std::size_t record) const
    {
        return std::span(rows).subspan(first_row[record], first_row[record + 1] - first_row[record]);
    }
};

/// One run, or several of one record at one intensity.
struct FragilityRun {
    std::uint32_t record = 0;      ///< any number that identifies the record
    std::vector<double> intensity; ///< (measures)
    double reached = 0;            ///< 0 or 1, or how many of `trials`
    double trials = 1;
};

/// @throws InputError where a run has another number of measures than the first, an intensity that is not above 0, or
///         `reached` outside [0, trials]; where there is no run
FragilityData grouped(std::span<const FragilityRun> runs);

/// Of stripes: (records x stripes) runs and how many of them reached the limit state; those without runs are left out.
FragilityData grouped(const std::vector<double>& intensity, const std::vector<double>& trials,
                      const std::vector<double>& reached);

/// (records x points) the share of each record's own runs; without runs at a point it takes that of all others there.
std::vector<std::vector<double>> record_shares(const FragilityData& data);

/// Outcomes with one of their measures only.
FragilityData with_measure(const FragilityData& data, std::size_t measure);

// From a linear predictor to a probability: the probit (the normal distribution; Bliss, "The calculation of the
// dosage-mortality curve", Annals of Applied Biology 22 (1935) 134) and the logit (the logistic distribution; Berkson,
// "Application of the logistic function to bio-assay", Journal of the American Statistical Association 39 (1944) 357).

/// Which distribution function maps the linear predictor to a probability. The probit in the logarithm of an intensity
/// is the lognormal fragility curve.
enum class Link : std::uint8_t { probit, logit };
const char* to_string(Link link);

/// A link at one value of the linear predictor.
struct LinkValue {
    double below = 0.5;   ///< probability F(eta)
    double above = 0.5;   ///< 1 - F(eta), with its own relative accuracy
    double density = 0;   ///< dF / d eta
    double curvature = 0; ///< d density / d eta
};
LinkValue link_at(Link link, double eta);

/// The linear predictor of a probability in (0, 1): the inverse of `below`.
double link_quantile(Link link, double probability);

} // namespace stylobate
