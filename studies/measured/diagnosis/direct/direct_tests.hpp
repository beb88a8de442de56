#pragma once
/// What the base and the sensors did, before any simulation is blamed.
///
/// As long as nothing rocks or slides, the lowest blocks ride on the table, and what the cameras see of them is the
/// table's motion: compared with the file's base motion it gives gain, offset of the clocks, distortion, pitch and
/// vertical motion. Where the cameras see the table itself, that is used instead, over whole runs. What lies askew at
/// rest (wedges, offsets of drums) is seen at once, too.

#include "ensemble/model/campaign.hpp"
#include "studies/measured/diagnosis/evidence/balance_fit.hpp"
#include "studies/measured/diagnosis/evidence/smoothed_run.hpp"
#include "studies/measured/diagnosis/findings/diagnosis.hpp"

#include <string>
#include <vector>

namespace stylobate {

/// Beyond which a test has found something. They stand well above what campaigns without any effect show, and below
/// what changes a response.
struct DirectThresholds {
    double distortion = 0.02;             ///< of a harmonic, over the fundamental, in acceleration
    double pitch_rad_s2_m = 4e-4;         ///< soft contacts lean by a tenth of it
    double pitch_apart_rad_s2_m = 1.2e-4; ///< where their lean is not in it
    /// The two above are so many standard deviations of what healthy campaigns show, and the pitch that was fitted must
    /// be so many of both together.
    double pitch_sds = 3.5;
    double vertical = 0.6;        ///< rms of the common vertical motion over the cameras' noise
    double vertical_ratio = 0.02; ///< of the horizontal motion, over whole runs
    double vertical_line = 12;    ///< power of a line of the table's own over its neighbours'
    double offset_s = 8e-4;       ///< without a view of the table; a fifth of it with one
    double gain = 0.02;           ///< likewise
    double alone = 8;             ///< nats by which gain or distortion alone must explain more than the other one alone
    /// What of a block's motion is apart from the base's by both, over the motion (rms) and over the cameras' noise, is
    /// no ride. By the fit of gain and offset 113 virtual campaigns that ride reach 0.16 and 1.5; one whose block 0
    /// hardly has friction any more is at 0.56 and 5.9.
    double apart_of_motion = 0.3;
    double apart_of_noise = 3;
    double with_table = 0.2;          ///< factor of the two above where the cameras see the table
    double wedge_rad = 3e-4;          ///< between two blocks at rest
    double placed_by_chance = 1.5e-3; ///< probability that any block of a campaign is so far off in the mean
    double sds = 5;                   ///< and every other one must be so many of its own standard deviations
};

/// Harmonics that the table adds to its motion: as a polynomial of the displacement (all motions), or as second and
/// third harmonics of nearly harmonic motions, in phase and in quadrature.
struct TableDistortion {
    bool polynomial = true;
    std::vector<double> size; ///< of its terms, in displacement
    int order = 2;            ///< of the larger harmonic
    double ratio = 0;         ///< its acceleration over the fundamental's; 0: none found
    double sd = 0;
    double gain = 0; ///< nats
};

/// Whether a cause is a vertical motion of the table that does not follow the horizontal one: no model has its record.
inline bool unrecorded_vertical(const Cause& cause)
{
    return cause.mechanism == "vertical_motion" && cause.parameter != "ratio";
}

/// What was found and how to correct for it.
struct DirectResult {
    std::vector<DataTest> base_tests;             ///< in the order in which they are judged
    std::vector<DataTest> sensor_tests;           ///< at rest
    std::vector<CauseFit> found;                  ///< named causes, gain in nats; sizes in the parameters' units
    std::vector<std::vector<double>> corrected_m; ///< (runs)(nt) corrected base displacement; empty where there is none
    std::vector<std::vector<double>> base_m;      ///< (runs)(nt) `corrected_m` with the zero of the cameras
    // what the correction is made of
    double gain = 1;
    double offset_s = 0;
    TableDistortion distortion;
};

/// What other runs of the specimen showed, applied to these.
DirectResult apply_corrections(const Campaign& campaign, const CampaignScales& scales, const DirectResult& shown);

/// Whether the cameras saw the table in every run: then places on it are known, not only beside other blocks.
bool sees_table(const Campaign& campaign);

/// Adds the tests of every joint, from the means of each run over the time before its base moves (at least 20 samples),
/// and what they found.
void test_rest(const Campaign& campaign, const CampaignScales& scales, const DirectThresholds& limits,
               DirectResult& out);

DirectResult direct_tests(const Campaign& campaign, const CampaignScales& scales, const DirectThresholds& limits = {});

// ---- How direct tests report their findings.

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
