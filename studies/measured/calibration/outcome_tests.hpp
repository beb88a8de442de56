#pragma once
/// Tests of which only the outcome is known: what shook the specimen, as an excitation that the model can be run with.

#include "ensemble/model/campaign.hpp"
#include "ensemble/model/motion.hpp"
#include "ensemble/model/study.hpp"

#include <memory>
#include <vector>

namespace stylobate {

/// One shaking of the base. Tests that repeat it share it, and with it the ensemble that predicts them.
struct TestShaking {
    ExcitationSpec excitation;
    std::shared_ptr<const Motion> motion; ///< of a record or a table; else null
};

struct OutcomeTest {
    std::size_t run = 0;     ///< of the campaign, or row of the table
    std::size_t shaking = 0; ///< of `OutcomeTests::shakings`
    bool collapsed = false;
};

struct OutcomeTests {
    std::vector<TestShaking> shakings;
    std::vector<OutcomeTest> tests;
};

/// The runs of a campaign with a known outcome and a known base motion.
/// @param runs of the campaign; empty: all
OutcomeTests outcome_tests(const Campaign& campaign, const std::vector<std::size_t>& runs);

/// The rows of a table. What a row leaves open is as in the study's excitation:
///
///   motion_file                   a record, or a table of the base motion where that is the study's kind; scaled to
///                                 pga_m_s2 where the row has one; component, unit and baseline are the study's
///   amplitude_m, frequency_hz     the study's harmonic or tapered motion of this amplitude
///   pga_m_s2                      the study's motion of this peak acceleration, and of the frequency (a record: the
///                                 time scale) that the row's frequency_hz or pgv_over_pga_s gives it
///
/// @throws InputError naming file and line where a motion cannot be read, or cannot be made of the study's excitation
OutcomeTests outcome_tests(const OutcomeTable& table, const Study& study);

} // namespace stylobate
