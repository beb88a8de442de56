#pragma once
/// Past shaking, inferred from the state of a structure: a surface whose rows hold the final state, for pasts of one
/// event, of two in succession, and so on ([survival], docs/past.md).

#include "studies/kinds/surface/surface_kind.hpp"
#include "studies/kinds/survival/survival.hpp"

namespace stylobate {

class SurvivalKind : public SurfaceKind {
public:
    SurvivalKind(const Study& study, const ResultHeader& header) : SurfaceKind(study, header), rows_(study, header) {}

    static bool fits(const Study& study) { return study.survival.has_value(); }
    /// One number of events after the other.
    bool plan(Rounds& rounds) override;
    void conclude() override { survival_ = survival_of(study_, rows_); }
    std::vector<Table> tables() const override;
    std::string text() const override;
    void add_to(Json& json) const override;

    static constexpr std::string_view of_survival = "a survival study";
    static constexpr PictureKind own_pictures[] = {{"likelihood", of_survival},
                                                   SurfaceKind::own_pictures[0],
                                                   SurfaceKind::own_pictures[1],
                                                   {"exclusion", of_survival},
                                                   {"rates", of_survival}};
    std::span<const PictureKind> pictures() const override { return own_pictures; }
    Picture picture(const ResultReader& reader, const std::string& results,
                    const PictureRequest& request) const override;
    std::vector<std::pair<std::string, std::string>> files(const std::string& format,
                                                           const std::string& name) const override;
    std::optional<Answer> answer() const override;
    void sections(PageWriter& writer) const override;

protected:
    void take(const ResultRow& row) override;

private:
    SurvivalCounts rows_;
    Survival survival_; ///< once it is complete
};

} // namespace stylobate
