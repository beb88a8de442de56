#include "io/records/ground_motion.hpp"
#include "library/inside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate::api {

Record::Record(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

Record Record::read(const std::filesystem::path& file, const std::optional<std::string>& component,
                    const std::optional<std::string>& unit)
{
    return translated([&] { return Inside::make<Record>({inner::read_record(file, component, unit), true}); });
}

Record Record::from_samples(std::vector<double> acceleration_m_s2, double dt_s, const std::string& name)
{
    if (!(dt_s > 0) || !std::isfinite(dt_s))
        throw InputError(
            fmt::format("{}: dt_s = {} is not a valid sampling interval. Give a value above 0.", name, dt_s));
    if (acceleration_m_s2.size() < inner::fewest_samples)
        throw InputError(fmt::format("{}: has {} samples, fewer than {}. Give a smaller dt_s or a longer duration.",
                                     name, acceleration_m_s2.size(), inner::fewest_samples));
    for (std::size_t i = 0; i < acceleration_m_s2.size(); ++i)
        if (!std::isfinite(acceleration_m_s2[i]))
            throw InputError(
                fmt::format("{}: the acceleration at {} s is not a number.", name, dt_s * static_cast<double>(i)));
    const double pga = inner::peak(acceleration_m_s2);
    if (pga < inner::smallest_pga_m_s2 || pga > inner::largest_pga_m_s2)
        throw InputError(fmt::format("{}: the PGA is {:g} m/s2, outside [{:g}, {:g}]. The unit is m/s2.", name, pga,
                                     inner::smallest_pga_m_s2, inner::largest_pga_m_s2));
    inner::Record record;
    record.file = name;
    record.format = "samples";
    record.unit = "m/s2";
    record.dt_s = dt_s;
    record.acceleration_m_s2 = std::move(acceleration_m_s2);
    return Inside::make<Record>({std::move(record), false});
}

const std::vector<double>& Record::acceleration_m_s2() const
{
    return data_->record.acceleration_m_s2;
}

double Record::dt_s() const
{
    return data_->record.dt_s;
}

double Record::duration_s() const
{
    return dt_s() * static_cast<double>(acceleration_m_s2().size() - 1);
}

std::string Record::file() const
{
    return data_->record.file;
}

std::string Record::format() const
{
    return data_->record.format;
}

std::string Record::component() const
{
    return data_->record.component;
}

std::string Record::title() const
{
    return data_->record.title;
}

Intensity Record::intensity() const
{
    const inner::IntensityMeasures m = translated([&] { return inner::intensity_measures(data_->record); });
    return {m.pga_m_s2,         m.pgv_m_s, m.pgd_m, m.arias_m_s, m.d5_95_s, m.cav_m_s, m.predominant_frequency_hz,
            m.mean_frequency_hz};
}

std::vector<double> Record::spectral_acceleration_m_s2(const std::vector<double>& periods_s, double damping_ratio) const
{
    if (!(damping_ratio >= 0 && damping_ratio < 1))
        throw InputError(fmt::format("damping_ratio = {} is outside [0, 1).", damping_ratio));
    for (const double period : periods_s)
        if (!(period >= 0) || !std::isfinite(period))
            throw InputError(fmt::format("a period of {} s is negative. Give 0 or more.", period));
    return inner::spectral_acceleration(data_->record, periods_s, damping_ratio);
}

} // namespace stylobate::api
