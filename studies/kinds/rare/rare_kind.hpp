#pragma once
/// A study of rare events: subset simulation on the peak displacement of the top, beyond all of which is the collapse,
/// with chains as lanes (ensemble/estimators/designs/subset_simulation.hpp).
///
/// The numbers that a realization is drawn with are the standard normal ones of a chain's point, each by its
/// distribution function; a step of all chains is one batch of the executor. The pilot is simulation 0, the repeats
/// follow. Which point comes next depends on the outcomes before, and these on nothing but (study, seed): so does the
/// whole.

#include "io/tables/kind_tables.hpp"
#include "studies/kinds/kind.hpp"

#include <string>
#include <unordered_map>
#include <vector>

namespace stylobate {

class RareKind : public Kind {
public:
    using Kind::Kind;

    static bool fits(const Study& study) { return study.rare.has_value(); }
    /// Independent draws: the states of the chains are not known in advance.
    std::uint64_t drawn_first() const override;
    /// Chains are gone through again by the outcomes that are there.
    std::optional<std::string> why_no_shards() const override
    {
        return "is of kind \"rare\", whose realizations are chosen by what others did";
    }
    double row_memory(double outcome) const override { return outcome + 200; }
    bool plan(Rounds& rounds) override;
    void restore(const ResultReader& reader) override { table_ = rare_table(reader.table("rare")); }
    void share(Progress&) const override {}
    std::vector<Table> tables() const override { return {to_table(table_)}; }
    std::string text() const override;
    void add_to(Json& json) const override;

    /// Its realizations lean to the collapse.
    bool draws_plainly() const override { return false; }
    std::optional<std::string> why_no_replay() const override
    {
        return "a realization of a chain depends on all previous ones; it cannot be repeated alone";
    }

    static constexpr PictureKind own_pictures[] = {{"rare", "a study of rare events"}};
    std::span<const PictureKind> pictures() const override { return own_pictures; }
    Picture picture(const ResultReader& reader, const std::string& results,
                    const PictureRequest& request) const override;
    std::optional<Answer> answer() const override;
    bool summary(PageWriter& writer) const override;
    bool shows_motion() const override { return false; }

protected:
    void take(const ResultRow& row) override { outcome_[row.index] = row.outcome; }

private:
    std::unordered_map<std::uint64_t, Outcome> outcome_;
    RareTable table_; ///< once it is complete
};

} // namespace stylobate
