#pragma once
/// What the loop keeps in files, as lines of text with tabs between their parts: the simulated tests of a specimen,
/// which take long to make, and the sequence of tests that were done on it.

#include "studies/measured/loop/done_test.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

/// Checksum of a specimen as planned: sizes, masses, places, joints, tolerances. Its name does not count, nor what is
/// measured at rest: that may be added while the tests go on.
std::string specimen_fingerprint(const Specimen& specimen);

/// What simulated tests depend on: the program's version, the specimen, and a text with all numbers of the procedures
/// and what was measured at rest.
std::string tests_fingerprint(const Specimen& specimen, std::string_view procedures);

/// Writes simulated tests, whole or not at all. @throws InputError if the file cannot be written
void keep_tests(const std::filesystem::path& file, const std::string& fingerprint, const SimulatedTests& tests);

/// Simulated tests of this fingerprint; nothing where there is no file, or where it is of another specimen, procedure
/// or version, or not complete: then they are simulated again.
/// @throws InputError if the file is something else, which must not be overwritten
std::optional<SimulatedTests> kept_tests(const std::filesystem::path& file, const std::string& fingerprint);

/// A sequence of tests: what it began with, and what was done.
struct TestSequence {
    std::vector<PriorShare> shares; ///< of the first diagnosis
    std::vector<DoneTest> tests;    ///< in their order
};

/// Writes a sequence, whole or not at all. @throws InputError if the file cannot be written
void keep_sequence(const std::filesystem::path& file, const Specimen& specimen, const TestSequence& sequence);

/// The sequence of this specimen, to be continued; an empty one where there is no file.
/// @throws InputError if the file is of another specimen, is something else, or has a line that cannot be read
TestSequence kept_sequence(const std::filesystem::path& file, const Specimen& specimen);

} // namespace stylobate
