#include "studies/diagnosis/direct_findings.hpp"

#include <cmath>

namespace stylobate {

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
    fit.sd = sd;
    fit.gain = gain;
    return fit;
}

} // namespace stylobate
