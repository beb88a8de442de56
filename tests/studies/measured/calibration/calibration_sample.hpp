#pragma once
/// A calibration with something in every field, and hard characters in its texts. Its numbers are made up.

#include "io/study/study_file.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "tests/studies/measured/diagnosis/diagnosis_sample.hpp"

#include <cmath>
#include <limits>

namespace stylobate {

inline FittedParameter sample_parameter(const std::string& key, double value, bool determined)
{
    FittedParameter p;
    p.key = key;
    p.start = 0.9 * value;
    p.value = value;
    p.low = 0.8 * value;
    p.high = determined ? 1.25 * value : 5 * value;
    p.from = 0.2 * value;
    p.to = 5 * value;
    p.determined = determined;
    p.effective = !determined;
    p.note = determined ? "" : "not determined by these data: nothing slides <here> & there";
    for (int i = -3; i <= 3; ++i)
        p.profile.push_back({value * std::pow(1.5, i), determined ? -2.0 * i * i : -0.01 * i * i});
    return p;
}

inline Calibration sample_calibration()
{
    Calibration c;
    c.measured = "campaign \"7\" <b>.h5";
    for (const ContactForm form : {ContactForm::area, ContactForm::points}) {
        FormCalibration f;
        f.form = form;
        f.parameters = {sample_parameter("contact.normal_stiffness_n_m2", 1.2e7, true),
                        sample_parameter("contact.friction", form == ContactForm::area ? 0.61 : 0.55, false)};
        f.correlation = {1, -0.7, -0.7, 1};
        f.score = 120.5;
        f.nominal_score = 80.25;
        f.roughness = 0.4;
        for (int run = 0; run < 50; ++run)
            f.runs.push_back({"run " + std::to_string(run), run / 2, 12, 10.0 + run, 11.5 + run});
        f.held_out = {75, 20.5, 129.5, 25};
        f.study = read_study(STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml");
        c.forms.push_back(f);
    }
    c.forms[1].held_out = {-3, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 1};
    c.best = 0;
    c.motion = sample_motion();
    c.notes = {"run 003 has no table motion & was left out", "<i>"};
    c.parameter_sets = 700;
    c.simulations = 1400;
    c.window_simulations = 90000;
    c.block_steps = 123456789;
    c.seconds = 83;
    c.complete = true;
    return c;
}

} // namespace stylobate
