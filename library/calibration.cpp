#include "stylobate/calibration.hpp"

#include "io/files/atomic_file.hpp"
#include "io/keys/words.hpp"
#include "io/study/study_file.hpp"
#include "library/inside.hpp"
#include "studies/app/file_kind.hpp"
#include "studies/calibration/calibration_data.hpp"
#include "studies/calibration/calibration_file.hpp"
#include "studies/calibration/calibration_text.hpp"
#include "studies/version.hpp"

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

/// Tells how far a calibration is.
class CalibrationTeller : public Asked {
public:
    explicit CalibrationTeller(const CalibrationOptions& options) : Asked(options.go_on), tell_(options.tell) {}

    void stage(const std::string& what) { stage_ = what; }
    void progress(const inner::Progress& p) override
    {
        if (!tell_ || (stage_ == told_ && p.done == done_))
            return;
        told_ = stage_;
        done_ = p.done;
        tell_(inner::calibration_progress(stage_, p));
    }

private:
    const std::function<void(const std::string&)>& tell_;
    std::string stage_, told_;
    std::uint64_t done_ = 0;
};

} // namespace

Calibration::Calibration(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

std::string Calibration::measured() const
{
    return data_->calibration.measured;
}

std::string Calibration::evidence() const
{
    return data_->calibration.from_outcomes ? "outcomes" : "histories";
}

const std::vector<CalibratedForm>& Calibration::forms() const
{
    return data_->forms;
}

const CalibratedForm& Calibration::best() const
{
    return data_->forms[data_->calibration.best];
}

std::vector<std::string> Calibration::notes() const
{
    return data_->calibration.notes;
}

std::string Calibration::calibrated_study() const
{
    return inner::calibrated_text(data_->calibration, data_->measured.string());
}

std::uint64_t Calibration::parameter_sets() const
{
    return data_->calibration.parameter_sets;
}

std::uint64_t Calibration::restored_sets() const
{
    return data_->calibration.restored_sets;
}

double Calibration::seconds() const
{
    return data_->calibration.seconds;
}

std::string Calibration::text() const
{
    return inner::calibration_text(data_->calibration) + inner::calibration_cost(data_->calibration) + "\n";
}

std::string Calibration::json() const
{
    return inner::calibration_json(data_->calibration).text();
}

void Calibration::write(const std::filesystem::path& file) const
{
    translated([&] {
        inner::AtomicFile whole(file);
        inner::write_calibration(data_->calibration, data_->start, inner::code_version(), whole.temporary());
        whole.commit();
    });
}

std::optional<Calibration> calibrate(const std::filesystem::path& measured, const CalibrationOptions& options)
{
    return translated([&]() -> std::optional<Calibration> {
        inner::check_kind(measured.string(), "calibrate");
        const inner::CalibrationData data(measured);
        const inner::Study start = options.study ? Inside::of(*options.study).study : data.default_start({});
        inner::demand_double(start, "study", "a calibration");
        inner::CalibrationOptions search;
        search.keys = inner::fitted_keys(start, options.fit, options.hold);
        search.forms = inner::fitted_forms(options.forms);
        search.outcomes = options.outcomes;
        search.held_out = options.held_out;
        const inner::RunOptions run = run_options(options.threads, options.simd);
        if (!options.cache.empty()) {
            search.kept = options.cache;
            search.kept_key = data.key();
        }
        CalibrationTeller teller(options);
        search.stage = [&](const std::string& what) { teller.stage(what); };
        inner::Calibration found = data.calibrated(start, search, run, teller);
        if (!found.complete)
            return {};
        std::vector<CalibratedForm> forms;
        for (const inner::FormCalibration& form : found.forms)
            forms.push_back(form_of(form));
        return Inside::make<Calibration>({std::move(found), start, measured, std::move(forms)});
    });
}

} // namespace stylobate::api
