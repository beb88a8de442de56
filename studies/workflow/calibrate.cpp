#include "studies/workflow/calibrate.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/measured/measured_file.hpp"
#include "io/study/study_file.hpp"
#include "studies/cluster/together.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/calibration/calibration_file.hpp"
#include "studies/measured/calibration/calibration_text.hpp"
#include "studies/version.hpp"
#include "studies/workflow/file_kind.hpp"

#include <set>
#include <system_error>
#include <utility>
#include <variant>

namespace stylobate {

namespace {

using Measured = std::variant<Campaign, OutcomeTable>;

/// A table of outcomes if the file ends in .csv and is no folder, else a campaign.
Measured measured_in(const std::filesystem::path& file)
{
    std::error_code ignored;
    if (file.extension() == ".csv" && !std::filesystem::is_directory(file, ignored))
        return read_outcomes(file);
    return read_campaign(file);
}

/// The study to begin from where none is given: `default_study` of a campaign.
Study default_start(const Measured& measured, const CalibrationRequest& request)
{
    const auto* campaign = std::get_if<Campaign>(&measured);
    if (!campaign)
        throw InputError(request.measured, 0,
                         "a table of outcomes does not describe the structure.\n  Give the structure, and the "
                         "parameters of the shaking that the table omits, by --study STUDY.toml.");
    return parse_study(default_study(*campaign).text, "the default start study of a calibration", request.settings);
}

/// By which the data are known: the file, and the motions that a table names.
std::string key_of(const Measured& measured, const std::filesystem::path& file)
{
    std::string key = fingerprint(file);
    std::set<std::string> files;
    if (const auto* table = std::get_if<OutcomeTable>(&measured))
        for (const MeasuredOutcome& row : table->rows)
            if (row.motion_file && files.insert(*row.motion_file).second)
                key += " " + fingerprint(file.parent_path() / *row.motion_file);
    return key;
}

/// Passes the progress on in words.
class InParameterSets : public Observer {
public:
    explicit InParameterSets(WorkObserver& outer) : outer_(outer) {}

    void stage(const std::string& what) { stage_ = what; }
    void progress(const Progress& p) override
    {
        planned_ = p.total;
        outer_.counted("parameter sets", calibration_progress(stage_, p), p);
    }
    void warn(const std::string& text) override { outer_.warn(text); }
    bool stop_requested() override { return outer_.stop_requested(); }
    std::uint64_t planned() const { return planned_; }

private:
    WorkObserver& outer_;
    std::string stage_;
    std::uint64_t planned_ = 0;
};

} // namespace

CalibrationEnd calibrate_measured(const CalibrationRequest& request, const Machine& machine, WorkObserver& observer)
{
    Measured measured;
    CalibrationEnd end;
    CalibrationOptions search;
    RunOptions run;
    together(machine.ranks, [&] {
        check_kind(request.measured, "calibrate");
        measured = measured_in(request.measured);
        end.start = request.start ? *request.start : default_start(measured, request);
        demand_double(end.start, request.start_name, "a calibration");
        demand_plane(end.start, request.start_name, "a calibration");
        search.keys = fitted_keys(end.start, request.fit, request.hold);
        search.forms = fitted_forms(request.forms);
        run = machine.run_options();
        if (run.leads() && request.check_outputs)
            request.check_outputs();
    });
    search.outcomes = request.outcomes;
    search.held_out = request.held_out;
    if (run.leads() && request.kept) {
        search.kept = request.kept;
        search.kept_key = key_of(measured, request.measured);
    }
    observer.begin();
    InParameterSets counted(observer);
    if (run.leads())
        search.stage = [&](const std::string& what) { counted.stage(what); };
    end.found = std::visit([&](const auto& of) { return calibrate(of, end.start, search, run, counted); }, measured);
    end.planned = counted.planned();
    return end;
}

void write_results(const CalibrationEnd& calibration, const std::filesystem::path& file)
{
    AtomicFile whole(file);
    write_calibration(calibration.found, calibration.start, code_version(), whole.temporary());
    whole.commit();
}

} // namespace stylobate
