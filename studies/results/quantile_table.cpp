#include "studies/results/quantile_table.hpp"

#include "ensemble/numerics/sample_quantiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stylobate {

HtmlTable quantile_table(const std::vector<const ResultRow*>& rows, const std::vector<Measure>& measures)
{
    HtmlTable table{"lrrrr", {"", "5 %", "median", "95 %", "greatest"}, {}, ""};
    if (rows.size() == 1)
        table = {"lr", {"", "value"}, {}, ""};
    for (const Measure& measure : measures) {
        std::vector<double> values;
        for (const ResultRow* row : rows)
            values.push_back(row->outcome.*measure.value);
        std::sort(values.begin(), values.end());
        std::vector<Html> line = {fmt::format("{} [{}]", measure.name, measure.unit)};
        if (rows.size() == 1)
            line.emplace_back(number_or_dash(values[0]));
        else
            for (const double share : {0.05, 0.5, 0.95, 1.0})
                line.emplace_back(number_or_dash(quantile_or_nan(values, share)));
        table.rows.push_back(std::move(line));
    }
    return table;
}

double quantile_or_nan(const std::vector<double>& sorted, double share)
{
    if (sorted.empty())
        return std::numeric_limits<double>::quiet_NaN();
    return sorted_quantile(sorted, share, QuantileDefinition::linear);
}

std::string number_or_dash(double value)
{
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : "–";
}

} // namespace stylobate
