#include "studies/workflow/calibrate.hpp"

#include "io/files/atomic_file.hpp"
#include "io/study/study_file.hpp"
#include "studies/cluster/together.hpp"
#include "studies/measured/calibration/calibration.hpp"
#include "studies/measured/calibration/calibration_file.hpp"
#include "studies/measured/calibration/calibration_text.hpp"
#include "studies/version.hpp"
#include "studies/workflow/file_kind.hpp"

#include <utility>

namespace stylobate {

namespace {

/// Passes the progress on in words.
class InParameterSets : public Observer {
public:
    explicit InParameterSets(WorkObserver& outer) : outer_(outer) {}

    void stage(const std::string& what) { stage_ = what; }
    void progress(const Progress& p) override
    {
        planned_ = p.total;
        outer_.counted(calibration_progress(stage_, p), p);
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
    std::optional<CalibrationData> data;
    CalibrationEnd end;
    CalibrationOptions search;
    RunOptions run;
    together(machine.ranks, [&] {
        check_kind(request.measured, "calibrate");
        data.emplace(request.measured);
        end.start = request.start ? *request.start : data->default_start(request.settings);
        demand_double(end.start, request.start_name, "a calibration");
        search.keys = fitted_keys(end.start, request.fit, request.hold);
        search.forms = fitted_forms(request.forms);
        run = machine.run_options();
        if (run.leads() && request.check_outputs)
            request.check_outputs();
    });
    search.outcomes = request.outcomes;
    search.held_out = request.held_out;
    if (run.leads() && !request.kept.empty()) {
        search.kept = request.kept;
        search.kept_key = data->key();
    }
    observer.begin();
    InParameterSets counted(observer);
    if (run.leads())
        search.stage = [&](const std::string& what) { counted.stage(what); };
    end.found = data->calibrated(end.start, search, run, counted);
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
