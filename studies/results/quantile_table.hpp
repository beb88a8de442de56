#pragma once
/// Quantiles of values of realizations, as a table of a page.

#include "io/store/result_store.hpp"
#include "studies/report/html.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// A realization's value, and what it is.
struct Measure {
    const char* name;
    const char* unit;
    double Outcome::*value;
};

/// 5 %, median, 95 % and the greatest of each measure; of a single row its values. @pre there is a row
HtmlTable quantile_table(const std::vector<const ResultRow*>& rows, const std::vector<Measure>& measures);

/// Of sorted values, linear between them; NaN of none.
double quantile_or_nan(const std::vector<double>& sorted, double share);
/// "0.0123"; "–" of what is not finite.
std::string number_or_dash(double value);

} // namespace stylobate
