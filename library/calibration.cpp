#include "stylobate/calibration.hpp"

#include "io/keys/words.hpp"
#include "library/inside.hpp"
#include "studies/measured/calibration/calibration_text.hpp"

namespace stylobate::api {

namespace {

CalibratedForm form_of(const inner::FormCalibration& form)
{
    CalibratedForm of;
    of.form = inner::word_for(inner::contact_form_names, form.form);
    for (const inner::FittedParameter& p : form.parameters)
        of.parameters.push_back({.key = p.key,
                                 .start = p.start,
                                 .value = p.value,
                                 .lower = p.low,
                                 .upper = p.high,
                                 .range_from = p.from,
                                 .range_to = p.to,
                                 .bounded_below = p.bounded_below,
                                 .bounded_above = p.bounded_above,
                                 .determined = p.determined,
                                 .effective = p.effective,
                                 .note = p.note});
    of.score = form.score;
    of.start_score = form.nominal_score;
    for (const inner::RunScore& run : form.runs)
        of.runs.push_back({run.run, run.motion_id, run.units, run.nominal, run.calibrated});
    if (form.held_out.groups > 0)
        of.held_out = {form.held_out.total, form.held_out.low, form.held_out.high};
    return of;
}

} // namespace

Calibration::Calibration(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

std::string Calibration::measured() const
{
    return data_->calibration().measured;
}

std::string Calibration::evidence() const
{
    return data_->calibration().from_outcomes ? "outcomes" : "histories";
}

const std::vector<CalibratedForm>& Calibration::forms() const
{
    return data_->forms;
}

const CalibratedForm& Calibration::best() const
{
    return data_->forms[data_->calibration().best];
}

std::vector<std::string> Calibration::notes() const
{
    return data_->calibration().notes;
}

std::string Calibration::calibrated_study() const
{
    return inner::calibrated_text(data_->calibration(), data_->measured.string());
}

std::uint64_t Calibration::parameter_sets() const
{
    return data_->calibration().parameter_sets;
}

std::uint64_t Calibration::restored_sets() const
{
    return data_->calibration().restored_sets;
}

double Calibration::seconds() const
{
    return data_->calibration().seconds;
}

std::string Calibration::text() const
{
    return inner::calibration_text(data_->calibration()) + inner::calibration_cost(data_->calibration()) + "\n";
}

std::string Calibration::json() const
{
    return inner::calibration_json(data_->calibration()).text();
}

void Calibration::write(const std::filesystem::path& file) const
{
    translated([&] { inner::write_results(data_->end, file); });
}

std::optional<Calibration> calibrate(const std::filesystem::path& measured, const CalibrationOptions& options)
{
    return translated([&]() -> std::optional<Calibration> {
        inner::CalibrationRequest request{.measured = measured.string()};
        if (options.study)
            request.start = Inside::of(*options.study).study;
        request.fit = options.fit;
        request.hold = options.hold;
        request.forms = options.forms;
        request.outcomes = options.outcomes;
        request.held_out = options.held_out;
        request.kept = options.cache;
        Teller teller(options);
        inner::CalibrationEnd end = inner::calibrate_measured(request, machine_of(options), teller);
        if (!end.found.complete)
            return {};
        std::vector<CalibratedForm> forms;
        for (const inner::FormCalibration& form : end.found.forms)
            forms.push_back(form_of(form));
        return Inside::make<Calibration>({std::move(end), measured, std::move(forms)});
    });
}

} // namespace stylobate::api
