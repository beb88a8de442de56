#pragma once
/// How direct tests report their findings.

#include "studies/diagnosis/findings/diagnosis.hpp"
#include "studies/diagnosis/laws/balance_fit.hpp"

#include <string>

namespace stylobate {

/// In these samples of a run the blocks lie as they were put down.
inline constexpr std::size_t first_samples = 20;

/// Whether a finding is beyond its threshold and its noise.
bool beyond(double value, double sd, double threshold, double sds);

/// A test that was made. @param sd infinite or NaN: not known
DataTest told(std::string name, std::string place, double value, double sd, double threshold, std::string unit,
              bool found, const std::string& sentence);

/// Probability that a finding is no chance, from its p-value: the evidence against chance is at most -1 / (e p ln p)
/// (Sellke, Bayarri and Berger, "Calibration of p values for testing precise null hypotheses", The American
/// Statistician 55 (2001)).
/// @param p of such a finding by chance, anywhere that was tested   @param before of what was found, without the test
double probability_of_finding(double p, double before);

/// A test of the base that could not be made.
DataTest cannot(std::string name, const std::string& why);

CauseFit cause_of(const char* mechanism, const std::string& place, const char* parameter, const char* unit,
                  double neutral, double size, double sd, double gain);

} // namespace stylobate
