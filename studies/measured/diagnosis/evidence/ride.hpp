#pragma once
/// The parts of runs in which the lowest block, or the table itself, rides on the base: what direct tests look at.

#include "ensemble/model/campaign.hpp"
#include "studies/measured/diagnosis/evidence/robust_fit.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace stylobate {

/// Shorter rides are not informative.
inline constexpr std::size_t shortest_ride = 30; // samples

/// Mean of v[from] to v[to - 1].
double mean_of(const std::vector<double>& v, std::size_t from, std::size_t to);

/// A series with 0 where nothing was seen.
std::vector<double> filled(std::vector<double> v);

/// Median of the first samples: the angle at which it rests. 0 of an empty series.
double rest_angle_of(const std::vector<double>& angle);

/// Blocks that stand on the table (or on what is fixed to it).
std::vector<int> lowest_blocks(const Specimen& s);

/// The file's base displacement at the cameras' samples; of an acceleration alone its double integral.
std::vector<double> base_displacement(const MeasuredRun& run);

/// One run at the spacing of the scales.
struct Ride {
    std::size_t run = 0;                    ///< of the campaign
    std::vector<double> base;               ///< displacement of the file [m]
    std::vector<double> rate, acceleration; ///< of it, smoothed
    std::vector<double> x, y, theta;        ///< of the lowest block, or of the table: raw samples
    /// What stays on the table of it: the middle of the block's bottom face, horizontally. The centre of a block that
    /// leans on soft beds or begins to rock moves by its height times the rotation, which is no motion of the table.
    std::vector<double> foot;
    double foot_height_m = 0; ///< of that, above the table
    double noise_x = 0, noise_y = 0, noise_theta = 0, noise_foot = 0;
    std::vector<std::pair<std::size_t, std::size_t>> parts; ///< in which it rides
    bool harmonic = false;
    double omega = 0;            ///< circular frequency of a harmonic ride [rad/s]
    double middle = 0, peak = 0; ///< of the base: its mean, and how far from that it gets [m]

    void find_peak()
    {
        middle = mean_of(base, 0, base.size());
        peak = 0;
        for (const double u : base)
            peak = std::max(peak, std::fabs(u - middle));
    }

    /// Takes the base motion at a later time.
    void shift(double by_s, const CampaignScales& scales)
    {
        std::vector<double> time(base.size());
        for (std::size_t i = 0; i < time.size(); ++i)
            time[i] = scales.spacing_s * static_cast<double>(i);
        base = resampled(time, base.data(), 1, by_s, scales.spacing_s, base.size());
        rate = scales.rates.apply(1, base);
        acceleration = scales.widths.back().apply(2, base);
    }
};

struct Prepared {
    std::vector<Ride> rides; ///< (runs that can be used)
    bool table = false;      ///< the cameras see the table
    std::string what;        ///< "the table" or "block 0"
};

/// Finds the rides of a campaign.
Prepared prepare_rides(const Campaign& campaign, const CampaignScales& scales);

/// Regression of what is seen in all rides, with an offset of its own for each stretch. Values that are not finite
/// were not seen.
/// @param column(ride, i, k) k-th regressor   @return fit of the k regressors
struct RideFit {
    std::vector<double> size, sd;
    std::vector<double> gain; ///< of each, over the fit without it [nats]
    double scale = 1;
    double log_likelihood = 0; ///< of all samples [nats]
};

template <class Value, class Column>
RideFit fit_rides(const std::vector<Ride>& rides, int regressors, Value&& value, Column&& column)
{
    std::vector<double> rows, values, sds; // rows one after the other
    for (const Ride& ride : rides)
        for (const auto& [from, to] : ride.parts) {
            std::vector<double> mean(static_cast<std::size_t>(regressors) + 1, 0);
            std::size_t count = 0;
            for (std::size_t i = from; i < to; ++i) {
                const double seen = value(ride, i).first;
                if (!std::isfinite(seen))
                    continue;
                ++count;
                mean.back() += seen;
                for (int k = 0; k < regressors; ++k)
                    mean[static_cast<std::size_t>(k)] += column(ride, i, k);
            }
            for (double& m : mean)
                m /= static_cast<double>(count);
            for (std::size_t i = from; i < to; ++i) {
                if (!std::isfinite(value(ride, i).first))
                    continue;
                for (int k = 0; k < regressors; ++k)
                    rows.push_back(column(ride, i, k) - mean[static_cast<std::size_t>(k)]);
                values.push_back(value(ride, i).first - mean.back());
                sds.push_back(value(ride, i).second);
            }
        }
    RideFit out;
    out.size.assign(static_cast<std::size_t>(regressors), 0);
    out.sd.assign(static_cast<std::size_t>(regressors), std::numeric_limits<double>::infinity());
    out.gain.assign(static_cast<std::size_t>(regressors), 0);
    if (values.empty())
        return out;
    RegressionData data;
    const auto n = static_cast<Eigen::Index>(values.size());
    data.columns = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        rows.data(), n, regressors);
    data.values = Eigen::Map<const Eigen::VectorXd>(values.data(), n);
    data.sd = Eigen::Map<const Eigen::VectorXd>(sds.data(), n);
    data.group.assign(values.size(), 0);
    data.prior_sd = Eigen::VectorXd::Constant(regressors, std::numeric_limits<double>::infinity());
    const Eigen::VectorXd unit = data.columns.cwiseAbs().colwise().maxCoeff();
    for (Eigen::Index k = 0; k < regressors; ++k)
        if (unit(k) > 0)
            data.columns.col(k) /= unit(k);
    const RobustFit fit = robust_fit(data);
    out.scale = fit.scale(0);
    out.log_likelihood = fit.log_density.sum();
    for (int k = 0; k < regressors; ++k) {
        const auto c = static_cast<std::size_t>(k);
        if (unit(k) == 0)
            continue;
        out.size[c] = fit.coefficients(k) / unit(k);
        out.sd[c] = std::sqrt(fit.covariance(k, k)) / unit(k);
        // Wald's: enough for what is tens of standard deviations away, and for what is none
        out.gain[c] = 0.5 * std::pow(out.size[c] / out.sd[c], 2);
    }
    return out;
}

/// `fit_rides` with standard deviations that also hold what differs from run to run (the jackknife's): soft contacts
/// and what else rides along is alike within a run, and no noise.
template <class Value, class Column>
RideFit fit_over_runs(const std::vector<Ride>& rides, int regressors, Value&& value, Column&& column)
{
    RideFit fit = fit_rides(rides, regressors, value, column);
    std::set<std::size_t> runs;
    for (const Ride& ride : rides)
        runs.insert(ride.run);
    if (runs.size() < 3)
        return fit;
    std::vector<double> sum(fit.size.size(), 0), squares(fit.size.size(), 0);
    for (const std::size_t left_out : runs) {
        std::vector<Ride> others;
        for (const Ride& ride : rides)
            if (ride.run != left_out)
                others.push_back(ride);
        const RideFit without = fit_rides(others, regressors, value, column);
        for (std::size_t k = 0; k < sum.size(); ++k) {
            sum[k] += without.size[k];
            squares[k] += without.size[k] * without.size[k];
        }
    }
    const auto n = static_cast<double>(runs.size());
    for (std::size_t k = 0; k < sum.size(); ++k) {
        const double variance = std::max(0.0, squares[k] / n - std::pow(sum[k] / n, 2)) * (n - 1);
        fit.sd[k] = std::max(fit.sd[k], std::sqrt(variance));
        fit.gain[k] = 0.5 * std::pow(fit.size[k] / fit.sd[k], 2);
    }
    return fit;
}

} // namespace stylobate
