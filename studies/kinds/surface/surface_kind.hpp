#pragma once
/// A surface: realizations in every cell of frequency, or direction, by PGA, as rows or as counts.

#include "studies/kinds/kind.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace stylobate {

/// Counts realizations cell by cell; those that are invalid are no trials.
class SurfaceCounts {
public:
    explicit SurfaceCounts(const SurfaceAxes& axes, LimitState limit = LimitState::collapse);
    /// Of what has been counted; its probabilities are computed anew.
    static SurfaceCounts of(const SurfaceTable& counted);
    void add(const ResultRow& row);
    /// Probability and Jeffreys interval of every cell.
    SurfaceTable table() const;

private:
    SurfaceTable table_;
    LimitState limit_ = LimitState::collapse;
};

/// The surface of a study that keeps counts and no rows.
SurfaceTable surface_of(const ResultHeader& header, const Tally& tally, LimitState limit);

class SurfaceKind : public Kind {
public:
    SurfaceKind(const Study& study, const ResultHeader& header);

    static bool fits(const Study& study) { return study.surface.has_value(); }
    std::optional<SurfaceTable> surface() const override { return counts_by_cell_.table(); }

    ChosenCells choose(const CellChoice& choice, const std::string& results) const override;
    std::optional<std::string> chosen_by() const override
    {
        return fmt::format("{} and --pga", header_.row_quantity().option);
    }

    static constexpr PictureKind own_pictures[] = {{"surface", "a surface", true}, {"slice", "a surface", true, true}};
    std::span<const PictureKind> pictures() const override { return own_pictures; }
    Picture picture(const ResultReader& reader, const std::string& results,
                    const PictureRequest& request) const override;
    bool pictures_want_all(std::string_view picture) const override
    {
        return picture != "surface" && picture != "slice";
    }
    void map(PageWriter& writer) const override;
    void sections(PageWriter& writer) const override;
    bool shows_motion() const override { return false; }

protected:
    void take(const ResultRow& row) override;
    void take(const Tally& tally) override;
    /// Below the table of the cells.
    virtual std::optional<std::string> remark(const SurfaceTable&) const { return std::nullopt; }

private:
    SurfaceCounts counts_by_cell_;
};

/// The surface of the store, or that of another limit state from the rows. Of a run that is not complete, that of the
/// realizations that were begun first and have all ended: none of them is missing because it takes long.
/// @param results for messages
/// @throws InputError if the limit state was not followed, or if there is nothing to draw yet
SurfaceTable surface_so_far(const ResultReader& reader, const Study& study, const std::string& results,
                            LimitState limit);

/// What the title of a surface adds where the run is not complete: of how many realizations it is. A complete run adds
/// no text.
std::string partial_words(const ResultReader& reader, const Study& study, const SurfaceTable& surface);

} // namespace stylobate
