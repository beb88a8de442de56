#include "studies/kinds/nearest_on_axis.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/store/surface_axis.hpp"

#include <fmt/format.h>

namespace stylobate {

std::size_t nearest_on_axis(const std::vector<double>& axis, double wanted, const char* option, const std::string& unit,
                            const std::string& results)
{
    constexpr double typed = 5e-3; // a value is within an axis if it is so to the digits that people type
    if (!(wanted >= axis.front() * (1 - typed) && wanted <= axis.back() * (1 + typed)))
        throw InputError(axis.size() == 1 ? fmt::format("{} {:g}: {} has only {:.4g} {}", option, wanted, results,
                                                        axis.front(), unit)
                                          : fmt::format("{} {:g}: the axis of {} goes from {:.4g} to {:.4g} {}", option,
                                                        wanted, results, axis.front(), axis.back(), unit));
    return make_cell_axis(axis, option).nearest(wanted);
}

} // namespace stylobate
