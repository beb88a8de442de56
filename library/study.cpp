#include "io/keys/words.hpp"
#include "io/study/study_file.hpp"
#include "library/inside.hpp"
#include "studies/report/left_out.hpp"
#include "studies/results/study_facts.hpp"

namespace stylobate::api {

Study::Study(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

Study Study::from_file(const std::filesystem::path& file, const std::vector<std::string>& settings)
{
    return translated([&] { return Inside::make<Study>({inner::read_study(file, settings), file, {}, settings}); });
}

Study Study::from_text(const std::string& toml, const std::vector<std::string>& settings)
{
    return translated([&] {
        return Inside::make<Study>({inner::parse_study(toml, "study", settings), {}, toml, settings});
    });
}

void Study::set(const std::string& setting)
{
    // from the beginning: a key that takes the place of another's default must not meet that default
    std::vector<std::string> settings = data_->settings;
    settings.push_back(setting);
    *this = data_->file ? from_file(*data_->file, settings) : from_text(data_->source, settings);
}

std::string Study::text() const
{
    return data_->study.text;
}

std::vector<std::pair<std::string, std::string>> Study::summary() const
{
    auto facts = inner::study_facts(data_->study);
    facts.emplace_back("Left out", inner::left_out_text(data_->study));
    return facts;
}

std::string Study::kind() const
{
    return inner::word_for(inner::study_kind_names, data_->study.kind);
}

std::uint64_t Study::seed() const
{
    return data_->study.seed;
}

std::uint64_t Study::realizations() const
{
    return data_->study.design().most;
}

} // namespace stylobate::api
