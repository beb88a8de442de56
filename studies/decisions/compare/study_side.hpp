#pragma once
/// One study of a comparison, as far as pairs need it: which limit states each realization reached.

#include "io/store/result_store.hpp"
#include "studies/experiment/limit_state.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

struct LimitDefinition {
    std::string name, describe;
    bool damage = true;                                           ///< whether more of it is worse
    std::function<std::optional<bool>(const ResultRow&)> reached; ///< of a valid realization; nothing: not known
};

/// The limit states of a study: those of surfaces (limit_state.hpp), or the damage states of a fragility study.
/// @param study, header must outlive what is returned
std::vector<LimitDefinition> limit_definitions(const Study& study, const ResultHeader& header);

/// What became of the realizations of a study, by index.
class StudySide {
public:
    /// Without rows as yet. @param study, header must outlive it
    StudySide(const Study& study, const ResultHeader& header);

    void add(const ResultRow& row);

    bool has(std::uint64_t index) const { return (state_[index] & present) != 0; }
    bool valid(std::uint64_t index) const { return (state_[index] & invalid) == 0; }
    /// Whether it is a valid realization of which is known whether it reached the limit state. @pre has(index)
    bool known(std::uint64_t index, std::size_t limit) const
    {
        return valid(index) && (state_[index] >> (most_limits + limit) & 1) == 0;
    }
    /// @pre has(index) && known(index, limit)
    bool reached(std::uint64_t index, std::size_t limit) const { return (state_[index] >> limit & 1) != 0; }
    std::uint64_t size() const { return state_.size(); }
    const std::vector<LimitDefinition>& limits() const { return limits_; }

    /// Draws of the first realizations of each cell, for the question which numbers two studies have in common: an
    /// adaptive comparison has the first ones, too.
    struct Draws {
        std::uint64_t index;
        std::vector<double> inputs;
    };
    /// In the order of their indices.
    std::vector<Draws> draws() const;

private:
    // a bit for each limit state that was reached, one for each of which it is not known, and these
    static constexpr std::size_t most_limits = 30;
    static constexpr std::uint64_t present = 1ull << 63, invalid = 1ull << 62;
    static constexpr std::uint64_t most_draws = 512; ///< or one of each cell

    std::vector<LimitDefinition> limits_;
    std::vector<std::uint64_t> state_;
    std::vector<Draws> draws_;
    std::uint64_t per_cell_, drawn_per_cell_; ///< realizations of a cell, and those of them that keep their draws
};

} // namespace stylobate
