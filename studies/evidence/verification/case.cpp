#include "studies/evidence/verification/case.hpp"

#include <cassert>
#include <cmath>
#include <utility>

namespace stylobate::verification {

bool Check::passed() const
{
    switch (relation) {
    case Relation::at_least:
        return measured >= expected - tolerance;
    case Relation::at_most:
        return measured <= expected + tolerance;
    default:
        return std::fabs(measured - expected) <= tolerance;
    }
}

Convergence convergence(std::string parameter, std::string quantity, std::vector<double> at, std::vector<double> value,
                        double exact)
{
    assert(at.size() == value.size() && "one value for each parameter");
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        if (value[i] == exact)
            continue;
        const double u = std::log(at[i]), v = std::log(std::fabs(value[i] - exact));
        n += 1;
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    const double order = (n * xy - x * y) / (n * xx - x * x);
    return {std::move(parameter), std::move(quantity), std::move(at), std::move(value), exact, order};
}

double aitken(const std::vector<double>& values)
{
    assert(values.size() >= 3 && "Aitken's limit takes three values");
    const std::size_t n = values.size();
    const double d1 = values[n - 2] - values[n - 3], d2 = values[n - 1] - values[n - 2];
    return values[n - 1] + d2 * d2 / (d1 - d2);
}

double richardson(std::vector<double> values, double factor, const std::vector<double>& exponents)
{
    assert(values.size() == exponents.size() + 1 && "each value takes one power away");
    for (const double exponent : exponents) {
        const double ratio = std::pow(factor, exponent);
        for (std::size_t i = 0; i + 1 < values.size(); ++i)
            values[i] = (ratio * values[i + 1] - values[i]) / (ratio - 1);
        values.pop_back();
    }
    return values.front();
}

bool Finding::passed() const
{
    bool all = !checks.empty();
    for (const Check& check : checks)
        all = all && check.passed();
    return all;
}

void Finding::equals(std::string what, double expected, double measured, double tolerance)
{
    checks.push_back({std::move(what), expected, measured, tolerance, Relation::equals});
}

void Finding::at_least(std::string what, double bound, double measured)
{
    checks.push_back({std::move(what), bound, measured, 0, Relation::at_least});
}

void Finding::at_most(std::string what, double bound, double measured)
{
    checks.push_back({std::move(what), bound, measured, 0, Relation::at_most});
}

Cases all_cases()
{
    Cases all;
    for (Cases (*some)() : {contact_cases, scheme_cases, vibration_cases, static_cases, rocking_cases,
                            overturning_cases, initiation_cases, sliding_cases, frame_cases, sensitivity_cases})
        for (Case& one : some())
            all.push_back(std::move(one));
    return all;
}

} // namespace stylobate::verification
