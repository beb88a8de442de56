#pragma once
/// A fragility study: motions x intensities x structures.

#include "studies/kinds/fragility/fragility.hpp"
#include "studies/kinds/kind.hpp"

namespace stylobate {

class FragilityKind : public Kind {
public:
    using Kind::Kind;

    static bool fits(const Study& study) { return study.fragility.has_value(); }
    double row_memory(double outcome) const override { return 4.5 * outcome; }
    double table_bytes() const override { return 300 * static_cast<double>(study_.cells()); }
    void conclude() override { fragility_ = fragility_of(study_, header_, std::move(rows_)); }
    std::vector<Table> tables() const override { return {to_table(stored(fragility_))}; }
    std::string text() const override;
    void add_to(Json& json) const override;

    ChosenCells choose(const CellChoice& choice, const std::string& results) const override;
    std::optional<std::string> chosen_by() const override { return "--motion and --intensity"; }

    static constexpr PictureKind own_pictures[] = {{"fragility", "a fragility study", true}};
    std::span<const PictureKind> pictures() const override { return own_pictures; }
    Picture picture(const ResultReader& reader, const std::string& results,
                    const PictureRequest& request) const override;
    Table columns(const std::vector<ResultRow>& rows) const override;
    std::vector<std::pair<std::string, std::string>> files(const std::string& format,
                                                           const std::string& name) const override;
    std::optional<Answer> answer() const override;
    void sections(PageWriter& writer) const override;

    /// What was found, once it is complete.
    const Fragility& fragility() const { return fragility_; }

protected:
    void take(const ResultRow& row) override { rows_.push_back({row.index, row.cell, row.pga_m_s2, row.outcome}); }

private:
    std::vector<FragilityOutcome> rows_;
    Fragility fragility_; ///< once it is complete
};

} // namespace stylobate
