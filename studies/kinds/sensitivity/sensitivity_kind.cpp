#include "studies/kinds/sensitivity/sensitivity_kind.hpp"

#include "io/plots/plot_estimates.hpp"
#include "io/tables/table.hpp"

namespace stylobate {

SensitivityKind::SensitivityKind(const Study& study, const ResultHeader& header)
    : Kind(study, header), outcomes_(study, header.input_names)
{
}

std::string SensitivityKind::text() const
{
    return Kind::text() + sensitivity_text(table_);
}

void SensitivityKind::add_to(Json& json) const
{
    json.member("sensitivity", sensitivity_json(table_));
}

Picture SensitivityKind::picture(const ResultReader& reader, const std::string& results, const PictureRequest&) const
{
    check_complete(reader, results);
    return {
        "sensitivity", "Sensitivity to the factors", "",
        [this](const std::string& title, const std::filesystem::path& file) { plot_sensitivity(table_, title, file); }};
}

std::vector<std::pair<std::string, std::string>> SensitivityKind::files(const std::string& format,
                                                                        const std::string& name) const
{
    auto files = Kind::files(format, name);
    files.emplace_back("sensitivity.csv", csv_text(listed(table_)));
    return files;
}

void SensitivityKind::sections(PageWriter& writer) const
{
    writer.page.section("Sensitivity to the factors");
    add_sensitivity(writer.page, table_);
}

} // namespace stylobate
