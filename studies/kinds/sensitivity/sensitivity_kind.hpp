#pragma once
/// A sensitivity study: a design of factors, and the shares of the outcomes' variance that they explain.

#include "studies/kinds/kind.hpp"
#include "studies/kinds/sensitivity/sensitivity.hpp"

namespace stylobate {

class SensitivityKind : public Kind {
public:
    SensitivityKind(const Study& study, const ResultHeader& header);

    static bool fits(const Study& study) { return study.sensitivity.has_value(); }
    double row_memory(double) const override { return 80; }
    void conclude() override { table_ = outcomes_.table(); }
    void restore(const ResultReader& reader) override { table_ = sensitivity_table(reader.table("sensitivity")); }
    std::vector<Table> tables() const override { return {to_table(table_)}; }
    std::string text() const override;
    void add_to(Json& json) const override;

    static constexpr PictureKind own_pictures[] = {{"sensitivity", "a sensitivity study"}};
    std::span<const PictureKind> pictures() const override { return own_pictures; }
    Picture picture(const ResultReader& reader, const std::string& results,
                    const PictureRequest& request) const override;
    std::vector<std::pair<std::string, std::string>> files(const std::string& format,
                                                           const std::string& name) const override;
    std::optional<Answer> answer() const override;
    void sections(PageWriter& writer) const override;
    bool shows_motion() const override { return false; }

protected:
    void take(const ResultRow& row) override { outcomes_.add(row); }

private:
    SensitivityOutcomes outcomes_;
    SensitivityTable table_; ///< once it is complete
};

} // namespace stylobate
