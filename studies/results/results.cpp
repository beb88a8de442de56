#include "studies/results/results.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/study/study_file.hpp"
#include "studies/results/kinds.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace stylobate {

Results::Results(const std::string& file, std::vector<std::string> settings)
    : file_(file), settings_(std::move(settings)), reader_(file),
      study_(parse_study(header().study_toml, file + " (its study)")), kind_(make_kind(study_, header()))
{
    check_settings(study_, file_, settings_);
}

const Kind& Results::concluded() const
{
    check_complete(reader_, file_);
    if (!concluded_) {
        if (const Tally* tally = reader_.tally())
            kind_->add(*tally);
        reader_.for_each_row([&](const ResultRow& row) { kind_->add(row); });
        kind_->restore(reader_);
        concluded_ = true;
    }
    return *kind_;
}

const std::vector<ResultRow>& Results::trials() const
{
    if (!trials_) {
        trials_ = reader_.rows();
        std::erase_if(*trials_, [&](const ResultRow& row) { return !kind_->is_trial(row.index); });
    }
    return *trials_;
}

std::string Results::title() const
{
    return study_.title.value_or(std::filesystem::path(file_).stem().string());
}

const Experiment& Results::experiment() const
{
    if (const std::optional<std::string> why = kind_->why_no_replay())
        throw InputError(fmt::format("{}: {}", file_, *why));
    if (!loaded_)
        loaded_.emplace(LoadedStudy::from_results(study_, header(), file_, settings_));
    return loaded_->experiment();
}

} // namespace stylobate
