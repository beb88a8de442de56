#include "stylobate/check.hpp"

#include "io/keys/words.hpp"
#include "library/inside.hpp"
#include "studies/workflow/check.hpp"
#include "studies/workflow/output_path.hpp"

namespace stylobate::api {

namespace {

Range range_of(const inner::Between& between)
{
    return {between.low, between.high};
}

} // namespace

Check::Check(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

std::string Check::kind() const
{
    return inner::word_for(inner::study_kind_names, data_->report.study.kind);
}

std::string Check::form() const
{
    return inner::word_for(inner::contact_form_names, data_->report.study.contact.form);
}

std::uint64_t Check::realizations() const
{
    return data_->report.size.realizations;
}

bool Check::at_most() const
{
    return data_->report.size.at_most;
}

std::uint64_t Check::cells() const
{
    return data_->report.size.cells;
}

int Check::blocks() const
{
    return data_->report.size.blocks;
}

int Check::free_blocks() const
{
    return data_->report.size.free_blocks;
}

Range Check::step_s() const
{
    return range_of(data_->report.size.step_s);
}

Range Check::longest_steps() const
{
    return range_of(data_->report.size.longest_steps);
}

std::optional<Trial> Check::trial() const
{
    const std::optional<inner::Trial>& trial = data_->report.trial;
    if (!trial)
        return {};
    const inner::TrialShares shares = trial->shares();
    return Trial{trial->count(), shares.valid, shares.collapsed, trial->whole(), trial->seconds};
}

std::optional<RunTime> Check::time() const
{
    const std::optional<inner::RunTime>& time = data_->report.time;
    if (!time)
        return {};
    return RunTime{time->seconds(),   range_of(time->range_s()), time->at_most,
                   time->processor_s, time->block_steps,         range_of(time->steps)};
}

double Check::memory_bytes() const
{
    return data_->report.memory_bytes;
}

double Check::file_bytes() const
{
    return data_->report.size.file_bytes;
}

std::vector<ChosenKey> Check::chosen() const
{
    std::vector<ChosenKey> chosen;
    for (const inner::NumericsChoice& choice : data_->report.study.chosen)
        chosen.push_back({choice.key, choice.value, choice.reason});
    return chosen;
}

std::vector<WeakSpot> Check::weak_spots() const
{
    std::vector<WeakSpot> spots;
    for (const inner::WeakSpot& spot : data_->report.weak)
        spots.push_back({spot.name, spot.text, spot.todo});
    return spots;
}

std::optional<Pilot> Check::pilot() const
{
    const std::optional<inner::NumericsCheck>& pilot = data_->report.pilot;
    if (!pilot)
        return {};
    return Pilot{pilot->realizations, pilot->collapsed, pilot->finer,
                 pilot->difference,   pilot->sd,        data_->report.missed()};
}

std::vector<std::string> Check::warnings() const
{
    return data_->report.warnings;
}

std::string Check::text() const
{
    return inner::check_text(data_->report);
}

std::string Check::json() const
{
    return inner::check_json(data_->report).text();
}

void Check::draw(const std::filesystem::path& picture) const
{
    translated([&] {
        inner::check_drawing(picture);
        inner::draw_study(data_->report.study, data_->report.file, picture);
    });
}

std::optional<Check> check(const Experiment& experiment, const CheckOptions& options)
{
    return translated([&]() -> std::optional<Check> {
        const auto& given = Inside::of(experiment);
        Teller teller(options);
        std::optional<inner::CheckReport> report = inner::check_study(
            given.loaded, given.name,
            {.pilot = options.pilot, .trial_seconds = options.trial_seconds, .law_seconds = options.law_seconds},
            machine_of(options), teller);
        if (!report)
            return {};
        return Inside::make<Check>({std::move(*report)});
    });
}

std::optional<Check> check(const Study& study, const CheckOptions& options)
{
    return check(Experiment(study), options);
}

} // namespace stylobate::api
