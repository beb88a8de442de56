#include "studies/diagnosis/tests/direct_findings.hpp"

#include <cmath>

namespace stylobate {

namespace {

constexpr double least_error = 0.02; // of a size against its neutral value

} // namespace

bool beyond(double value, double sd, double threshold, double sds)
{
    return std::fabs(value) > threshold && std::fabs(value) > sds * sd;
}

DataTest told(std::string name, std::string place, double value, double sd, double threshold, std::string unit,
              bool found, const std::string& sentence)
{
    DataTest test;
    test.name = std::move(name);
    test.place = std::move(place);
    test.value = value;
    if (std::isfinite(sd))
        test.sd = sd;
    test.threshold = threshold;
    test.unit = std::move(unit);
    test.outcome = found ? TestOutcome::failed : TestOutcome::passed;
    test.sentence = sentence;
    return test;
}

double probability_of_finding(double p, double before)
{
    if (p <= 0)
        return 1;
    const double chance = p < std::exp(-1) ? -std::exp(1) * p * std::log(p) : 1;
    return before / (before + (1 - before) * chance);
}

DataTest cannot(std::string name, const std::string& why)
{
    DataTest test;
    test.name = std::move(name);
    test.place = "base";
    test.outcome = TestOutcome::not_judged;
    test.sentence = why;
    return test;
}

CauseFit cause_of(const char* mechanism, const std::string& place, const char* parameter, const char* unit,
                  double neutral, double size, double sd, double gain)
{
    CauseFit fit;
    fit.cause = {mechanism, place, parameter, unit, neutral};
    fit.size = size;
    // what the tests leave out (soft contacts, a form of distortion that is not quite theirs) is small, not nothing
    fit.sd = std::hypot(sd, least_error * (size - neutral));
    fit.gain = gain;
    return fit;
}

} // namespace stylobate
