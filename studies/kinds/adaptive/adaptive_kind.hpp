#pragma once
/// An adaptive surface: rounds of realizations until every cell's interval is narrow enough
/// (ensemble/estimators/surface/adaptive.hpp).

#include "ensemble/estimators/surface/adaptive.hpp"
#include "studies/kinds/surface/surface_kind.hpp"

#include <optional>
#include <string>

namespace stylobate {

/// Outcomes of the realizations of each cell, in their order, as far as they have been run.
class CellOutcomes {
public:
    CellOutcomes(std::size_t frequencies, std::size_t pgas, std::uint64_t most)
        : rows_(frequencies), columns_(pgas), most_(most), state_(frequencies * pgas)
    {
    }
    /// @pre the row is the surface's
    void add(const ResultRow& row);
    /// The valid ones among the first n realizations of each cell (cells). @pre all of those have been added
    SurfaceTrials trials(const std::vector<std::uint64_t>& asked) const;

private:
    std::size_t rows_, columns_;
    std::uint64_t most_; ///< indices of a cell
    std::vector<std::vector<std::optional<State>>> state_;
};

/// Mean of the cells' probabilities, each cell with the same weight however many realizations it has, and its standard
/// error. (The share among all realizations leans to the cells that took more of them.)
struct SurfaceMean {
    double value = 0, error = 0;
};
SurfaceMean mean_of(const SurfaceTable& table);
/// The mean as the progress' share, with the interval of 1.96 standard errors.
void set_share(Progress& progress, const SurfaceMean& mean);
/// What was reached with how many realizations, as a sentence.
std::string describe_adaptive(const SurfaceTable& table);

class AdaptiveKind : public SurfaceKind {
public:
    AdaptiveKind(const Study& study, const ResultHeader& header);

    static bool fits(const Study& study) { return study.surface && study.surface->adaptive; }
    /// Rounds that have been run are gone through again, by the outcomes that are there: the next ones are the same as
    /// without an interruption.
    std::optional<std::string> why_no_shards() const override
    {
        return "has surface.adaptive, whose realizations are chosen by what others did";
    }
    bool plan(Rounds& rounds) override;
    void restore(const ResultReader& reader) override { table_ = reader.surface(); }
    void share(Progress& progress) const override;
    std::optional<SurfaceTable> surface() const override { return table_; }
    std::string text() const override;
    void add_to(Json& json) const override;

protected:
    void take(const ResultRow& row) override { outcomes_.add(row); }
    std::optional<std::string> remark(const SurfaceTable& table) const override { return describe_adaptive(table); }

private:
    CellOutcomes outcomes_;
    std::optional<SurfaceTable> table_; ///< once it is complete
};

} // namespace stylobate
