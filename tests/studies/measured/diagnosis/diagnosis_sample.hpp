#pragma once
/// A diagnosis with something in every field, and hard characters in its texts. Its numbers are made up.

#include "studies/measured/diagnosis/findings/diagnosis.hpp"

#include <cmath>
#include <limits>

namespace stylobate {

inline DiagnosisFigure sample_figure()
{
    DiagnosisFigure figure;
    figure.place = FigurePlace::wrong;
    figure.title = "Run 004, block 2, rotation";
    figure.caption = "Measured against the ensemble of the calibrated baseline; the band holds 95 % of it.";
    figure.x_label = "time [s]";
    figure.y_label = "rotation [rad]";
    FigureSeries band{"baseline, 95 %", SeriesKind::band, {}, {}, {}, {}};
    FigureSeries line{"measured", SeriesKind::line, {}, {}, {}, {}};
    for (int i = 0; i < 3000; ++i) {
        const double t = 0.001 * i;
        const double theta = 0.02 * std::sin(8 * t) * std::exp(-t / 2);
        band.x.push_back(t);
        band.low.push_back(theta - 0.002 - 0.001 * t);
        band.high.push_back(theta + 0.002 + 0.001 * t);
        line.x.push_back(t);
        line.y.push_back(i > 2000 && i < 2200 ? std::numeric_limits<double>::quiet_NaN()
                                              : theta * (t > 1 ? 1 + 0.3 * (t - 1) : 1));
    }
    figure.series = {band, line};
    return figure;
}

/// Two windows of two blocks on a fixed one. In the second the cameras' clock is uneven, and once block 1 is not seen.
inline WindowMotions sample_motion()
{
    WindowMotions motion;
    motion.blocks = {{ShownBlockKind::drum, 0.5, 0.25, 2.0, 0.85},
                     {ShownBlockKind::epistyle, 0.4, 0.25, 2.1, 1.35},
                     {ShownBlockKind::fixed, 0.6, 0.3, 2.0, 0.3}};
    WindowMotion worst{WindowChoice::worst, "004", 1.2, 1.4, 1, 57, {}, {}};
    worst.tracks = {{"measured", {}, -1, "", {}}, {"baseline", 36.1, 1, "x", {}}, {"extended", 1.5, 0, "theta", {}}};
    WindowMotion typical = worst;
    typical.choice = WindowChoice::typical;
    typical.run = "005 <i>";
    typical.rank = 29;
    typical.from_s = 0.5;
    typical.to_s = 0.72;
    for (int k = 0; k < 11; ++k) {
        const double t = 0.02 * k;
        worst.samples.push_back({1.2 + t, 0.1 * t});
        typical.samples.push_back({0.5 + t + (k == 5 ? 0.008 : 0), -0.2 * t});
        for (WindowMotion* window : {&worst, &typical})
            for (std::size_t track = 0; track < 3; ++track)
                for (std::size_t b = 0; b < 2; ++b) {
                    const double moved = 0.001 * static_cast<double>((b + 1) * (track + 1)) * (1 + k);
                    const ShownBlock& block = motion.blocks[b];
                    window->tracks[track].places.push_back(
                        {block.rest_x_m + moved, block.rest_y_m + moved / 10, -0.01 * moved * k});
                }
    }
    typical.tracks[0].places[2 * 7 + 1].theta_rad = std::numeric_limits<double>::quiet_NaN();
    motion.windows = {worst, typical};
    return motion;
}

inline Diagnosis filled_diagnosis()
{
    Diagnosis d;
    d.measured_file = "measured/col\"umn & co.h5";
    d.measured_fingerprint = "crc32 1a2b3c4d";
    d.specimen = "Seven drums <script>alert(1)</script>, 1:10, é";
    d.study_toml = "[study]\nkind = \"single\"\n\n[contact]\nfriction = 0.68 # µ < 1\n";
    d.code_version = "0.1.0+abc";
    d.command = "stylobate diagnose 'col\"umn & co.h5' --study column.toml -o diagnosis.h5";
    d.seed = 0xfedcba9876543210;
    d.options = {"threads = 2", "simd = avx2"};
    d.runs = 12;
    d.runs_used = 11;

    d.data_findings = {"Run 007 has no base motion; it is not used.", "Block 5 is not seen in 3 % of the samples."};
    d.base_tests = {{"time_offset", "all runs", 0.0004, 0.0003, 0.001, "s", TestOutcome::passed,
                     "The clocks of base and cameras agree."},
                    {"sensor_gain", "run 004", 1.031, 0.004, 0.01, "", TestOutcome::failed,
                     "The sensor reads 3.1 % more than the cameras see."},
                    {"vertical_motion",
                     "table",
                     {},
                     {},
                     {},
                     "m/s2",
                     TestOutcome::not_judged,
                     "The table was not seen by the cameras."}};
    d.sensor_tests = {
        {"noise", "block 2 theta", 1.9e-4, 1e-5, 4e-4, "rad", TestOutcome::passed, "The noise is as stated."}};
    d.baseline = {{"contact.friction", "", 0.671, 0.65, 0.69, true, ""},
                  {"contact.normal_stiffness_n_m2", "N/m2", 1e8, {}, {}, false, "small rocking alone would tell it"}};
    d.wrong = {{"004", 2, "theta", 1.2, 2.0, 3.1}, {"005", -1, "x", 0.25, 0.5, 1.4}};

    Candidate joint{"joint_friction",
                    "joint 0",
                    "ratio",
                    "",
                    0.57,
                    0.49,
                    0.66,
                    1.0,
                    41.2,
                    4.4,
                    0.0005,
                    0.83,
                    {},
                    Decision::named,
                    "It explains every run that slides."};
    joint.evidence = {{"004", 30.5, "slip at joint 0 only"}, {"006", {}, "left out"}};
    Candidate stribeck{"stribeck",
                       "all joints",
                       "dynamic_ratio",
                       "",
                       0.81,
                       0.7,
                       0.95,
                       1.0,
                       38.9,
                       5.1,
                       0.002,
                       0.17,
                       {{"004", 28.1, {}}},
                       Decision::in_set,
                       "It slips as fast in these runs."};
    Candidate drag{"drag", "block 6", "drag", "N s2/m2",           0.002, {}, 0.02, 0.0, 0.3, 4.1,
                   0.44,   {},        {},     Decision::not_shown, ""};
    Candidate vertical{"vertical_motion",
                       "base",
                       "ratio",
                       "",
                       {},
                       {},
                       {},
                       0.0,
                       {},
                       {},
                       {},
                       {},
                       {},
                       Decision::not_judged,
                       "Needs the table seen by the cameras."};
    d.candidates = {joint, stribeck, drag, vertical};
    d.nulls = {{"area", 200, "Friction, stiffness and places drawn anew and calibrated again in each."}};

    d.verdict = Verdict::named;
    d.verdict_text = "Joint 0 has less friction than the others: 0.57 of theirs (0.49 to 0.66).";
    d.indistinguishable = {"joint_friction", "stribeck"};
    d.unexplained = Unexplained{3,
                                "x",
                                "velocity",
                                "What remains at block 3 grows with velocity.",
                                {{"velocity", 0.31, 0.05}, {"amplitude", 0.02, {}}}};
    d.extended_study = d.study_toml + "\n[mechanisms]\njoint_friction = { joint = 0, ratio = 0.57 }\n";
    d.extended_study_file = "diagnosis_extended.toml";
    d.gain = ModelGain{1.0,
                       0.58,
                       0.5,
                       0.66,
                       "",
                       0.41,
                       {"004", "005"},
                       CollapsePrediction{4, 0.31, 0.12, 2, 4, "Two of them fell."},
                       "Most of it in run 004."};
    TestStory story;
    story.verdict = SequenceVerdict::named;
    story.text = "The tests name stribeck at all, dynamic_ratio = 0.72 (0.68 to 0.77, 90 %).";
    story.named = {{"stribeck", "all", "dynamic_ratio", "", 0.72, 0.68, 0.77, 0.97, 11.5},
                   {"dowel", "joint 1", "yield_n", "N", 3, {}, {}, 0.95, 6}};
    story.share = 0.97;
    story.log_evidence = 11.5;
    story.prior = {{"nothing", 0.5, 0.5}, {"stribeck at all", 0.2, 0.2}};
    story.steps = {{"pull",
                    "0, 1, 2",
                    {{"pull.speed", "friction in slow less in fast cycles", 1, 0.28, 0.004, "", 0.01, 21.5, false},
                     {"pull.width", "displacement after a reversal", 0, 2e-5, 1e-6, "m", 1.9e-5, 0.4, true}},
                    {{"stribeck at all", 0.2, 0.97}, {"nothing", 0.5, 0.02}},
                    11.5,
                    SequenceVerdict::named,
                    "It is 21.5 standard deviations from what healthy specimens give."},
                   {"rest", "0", {}, {}, 11.5, SequenceVerdict::named, "It gave no estimate."}};
    story.limits = {{"dowel at joint 1", "yield_n = 0.12 N"}, {"drag at all", ""}};
    story.options = {{"push", 1.5, 0.4, 0.4, 0.27, ""}, {"shake", 1, 0, 0, 0, "no cause shows in it"}};
    story.next = {"push"};
    story.sheet = {"push: at joints 0, 1.", "Clamp the blocks below."};
    story.notes = {"Run 7 is left out."};
    story.simulations = 5000;
    story.seconds = 62.5;
    d.tests = story;
    d.missing = {{"vertical_motion", "the table was not seen by the cameras"}};
    d.method = {"The baseline was calibrated first, then each mechanism was fitted beside it."};
    d.cost = {61234, 450000, 1234567890123, 212.5, 2, 6.8};

    DiagnosisFigure bars;
    bars.place = FigurePlace::gain;
    bars.title = "Error by run";
    bars.y_label = "error";
    bars.x_ticks = {"004", "005"};
    bars.series = {{"baseline", SeriesKind::bars, {0, 1}, {1.1, 0.9}, {1.0, 0.8}, {1.2, 1.0}},
                   {"extended", SeriesKind::bars, {0, 1}, {0.6, 0.5}, {0.5, 0.4}, {0.7, 0.6}}};
    DiagnosisFigure marks;
    marks.place = FigurePlace::candidates;
    marks.title = "Gain by amplitude <i>";
    marks.x_label = "peak acceleration [m/s²]";
    marks.y_label = "gain [nats]";
    marks.x_log = marks.y_log = true;
    marks.series = {{"", SeriesKind::points, {1, 3, 10}, {0.2, 5, 40}, {0.1, 3, 30}, {0.4, 8, 55}}};
    d.figures = {sample_figure(), bars, marks};
    d.motion = sample_motion();
    return d;
}

/// One that names no cause: candidates were compared with simulated campaigns, and none is significant.
inline Diagnosis diagnosis_without_cause()
{
    Diagnosis d;
    d.measured_file = "column.h5";
    d.runs = d.runs_used = 6;
    d.code_version = "0.3.0";
    Candidate friction;
    friction.mechanism = "joint_friction";
    friction.place = "joint 0";
    friction.parameter = "ratio";
    friction.size = 0.63;
    friction.gain_nats = 6.1;
    friction.null95 = 7.4;
    friction.p = 0.056;
    friction.decision = Decision::not_shown;
    friction.why = "the p-value of the gain is 0.056";
    Candidate wear = friction;
    wear.mechanism = "corner_wear";
    wear.gain_nats = 1.2;
    wear.p = 0.7;
    wear.why = "the p-value of the gain is 0.7";
    d.candidates = {friction, wear};
    d.nulls = {{"area", 192, "friction of the joints"}};
    return d;
}

} // namespace stylobate
