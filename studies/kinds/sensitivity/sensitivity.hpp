#pragma once
/// Which factors the outcomes of a sensitivity study depend on, from its realizations.
/// The outcomes are defined for every valid realization, so that the factors stay independent. A quantity that only
/// some realizations have would refer to a selection with dependent factors, for which no indices are defined:
///
///   collapse            1 if a block has fallen, else 0: the mean is the probability
///   time_upright        time of the first fall, or the longest end of any realization where it stood
///   peak_displacement   of the top, at most the width of a drum: that much where it collapsed
///   residual_displacement   its size, likewise
///
/// Of a structure that still moves at the end the residual displacement is not known. Rows of the design with such a
/// structure are left out of this outcome, and the table states how many.

#include "ensemble/model/study.hpp"
#include "io/plots/figure.hpp"
#include "io/store/result_store.hpp"
#include "io/tables/kind_tables.hpp"
#include "studies/report/document.hpp"
#include "studies/report/json.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// Outcomes of the realizations of a sensitivity study; in any order.
class SensitivityOutcomes {
public:
    /// @param inputs names of the inputs of a row
    SensitivityOutcomes(const Study& study, const std::vector<std::string>& inputs);
    void add(const ResultRow& row);
    /// @pre all realizations have been added
    /// @throws InputError if fewer than two rows of the design are valid
    SensitivityTable table() const;

private:
    struct Kept {
        State state = State::invalid;
        double collapse_time_s = -1;
        double end_time_s = 0;
        double peak_m = 0;
        double residual_m = 0;
    };
    static constexpr std::size_t outcomes = 4;
    std::array<double, outcomes> values(const Kept& kept, double longest_s) const;

    static constexpr std::size_t residual = 3; ///< its number
    std::vector<std::size_t> usable(std::size_t outcome) const;
    std::vector<double> directions(const std::vector<std::size_t>& rows) const;

    FactorDesign spec_;
    std::uint64_t seed_;
    double width_m_; ///< of the widest drum
    std::vector<Kept> kept_;
    std::vector<std::size_t> input_; ///< (factors) place of the input, of a factor with a single value; else `none`
    std::vector<double> drawn_;      ///< (rows x points x factors) these inputs
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
};

/// A table for each outcome, and the remarks.
void add_sensitivity(Document& page, const SensitivityTable& table);
/// The same as a console shows it.
std::string sensitivity_text(const SensitivityTable& table);
Json sensitivity_json(const SensitivityTable& table);
/// Bars of all indices of one outcome, factor by factor, with their intervals; Sobol's cut at -0.5 and 1.6.
Figure sensitivity_figure(const SensitivityTable& table, std::size_t outcome);
/// For each outcome, bars of the factors' indices with their intervals. What is not determined has no bar.
/// @throws InputError if the table is empty, and as `write_picture` does
void plot_sensitivity(const SensitivityTable& table, const std::string& title, const std::filesystem::path& file);

/// What must be known of a table: factors without effect, outcomes that do not vary, rows left out.
std::vector<std::string> sensitivity_remarks(const SensitivityTable& table);

} // namespace stylobate
