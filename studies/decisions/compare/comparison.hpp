#pragma once
/// What an intervention changes, by limit state and place, as plain data, and as an HDF5 file (`io/FORMAT.md`).

#include "ensemble/estimators/paired/paired_difference.hpp"
#include "ensemble/estimators/paired/paired_tests.hpp"
#include "io/tables/rows.hpp"
#include "io/tables/table.hpp"
#include "studies/experiment/limit_state.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// What a difference comes to at the level of its interval.
enum class ChangeVerdict {
    better, ///< of damage: its probability is smaller
    worse,
    less, ///< of what is no damage, as rocking without collapse
    more,
    open ///< the interval contains 0
};
const char* to_string(ChangeVerdict verdict);

/// One limit state in one cell or stripe, or in all.
struct PlaceComparison {
    PairedCounts counts;
    Share base, variant;   ///< each side's own probability with its interval
    double difference = 0; ///< variant - base; NaN without pairs
    double lower = -1;     ///< paired interval
    double upper = 1;
    double unpaired = 0;   ///< realizations of each of two studies drawn independently whose difference has the same
                           ///< variance; NaN where that is not known
    double p = 1;          ///< exact two-sided test that the studies do not differ
    double p_adjusted = 1; ///< over the cells of the limit state; of all cells together as `p`

    /// How many times as many realizations an unpaired comparison would need.
    double saving() const { return unpaired / static_cast<double>(counts.pairs()); }
    /// The largest difference of either sign that the interval contains.
    double largest() const;
};

struct LimitComparison {
    std::string name;     ///< "collapse", "peak_0.35"
    std::string describe; ///< "rocking without collapse"
    bool damage = true;   ///< whether more of it is worse
    std::vector<PlaceComparison> cells;
    PlaceComparison overall;
    std::vector<PairedCounts> by_motion = {}; ///< (stripes x motions) of a fragility study; else empty

    ChangeVerdict verdict(const PlaceComparison& place) const;
    /// Cells that are named at the rate of false names: those where it is worse (or more), or better.
    std::vector<std::size_t> named(double rate, bool worse) const;
};

/// How the draws of one perturbed quantity are related, as found in the pairs.
enum class CommonDraws {
    same,         ///< the same numbers
    quantiles,    ///< the same quantiles of distributions that differ
    other,        ///< other numbers
    base_only,    ///< the variant does not draw it
    variant_only, ///< the base does not draw it
};
const char* to_string(CommonDraws draws);

template <>
struct FieldWords<CommonDraws> {
    static constexpr const char* words[] = {"same numbers", "same quantiles", "other numbers", "base alone",
                                            "variant alone"};
    static constexpr WordsAs as = WordsAs::numbers;
};

struct CommonInput {
    std::string name; ///< "friction"
    CommonDraws draws = CommonDraws::same;
    std::uint64_t numbers = 1; ///< how many of the quantity (joints, blocks) are so
};

/// On which drawn quantity the change of the first limit state depends.
struct InputDependence {
    std::string input; ///< "friction": of a quantity that joints or blocks have of their own the mean over them
    Dependence found;
    double p_adjusted = 1; ///< over the quantities, by Holm's procedure
};

struct VariantComparison {
    std::string name;                                                 ///< "dowels"
    std::string results;                                              ///< its results file
    std::string study_toml;                                           ///< its canonical study
    std::uint64_t pairs = 0;                                          ///< that both studies have valid
    std::uint64_t invalid_base = 0, invalid_variant = 0, dropped = 0; ///< dropped: invalid in either
    std::vector<CommonInput> inputs;
    std::vector<std::string> notes; ///< what else differs, in sentences
    std::vector<LimitComparison> limits;
    std::vector<InputDependence> depends; ///< smallest p-value first; none where pairs share motions

    /// Pairs that are not counted for a limit state: one of the two stands and still moved at the end, so that its
    /// residual is not known.
    std::uint64_t unknown(const LimitComparison& limit) const
    {
        return pairs - std::min(pairs, limit.overall.counts.pairs());
    }
};

/// The axes are those of a surface.
struct Comparison : SurfaceAxes {
    std::string kind; ///< of the studies
    std::string title;
    std::string base_name, base_results, base_toml;
    std::string code_version;
    double level = interval_level;         ///< of intervals and verdicts
    double rate = 0.05;                    ///< of false names among the cells that are named
    std::optional<std::string> adjustment; ///< "benjamini-hochberg" or "holm"; nullopt: there is one cell
    std::string measure;                   ///< of a fragility study
    std::vector<double> intensity;         ///< its stripes; none of a cloud
    std::uint64_t motions = 0;             ///< of a fragility study: the groups of pairs
    std::uint64_t adaptive_budget = 0;     ///< realizations of each study at most; 0: all were run
    double adaptive_margin = 0;            ///< difference that matters
    std::uint64_t adaptive_rounds = 0;
    std::vector<VariantComparison> variants;

    /// The cells of a surface, the stripes, or 1.
    std::size_t places() const;
    /// "2.5 Hz, 4 m/s2", "PGA 3 m/s2", "all".
    std::string place(std::size_t cell) const;
};

/// A row of a surface, or all stripes of a fragility study.
struct CapacityRow {
    std::string place; ///< "0.5 Hz", "all stripes"
    CapacityRatio ratio;
};

/// Of a limit state that is damage. None where the study has less than two intensities, and none of an adaptive
/// comparison: it stops a cell by its outcomes.
std::vector<CapacityRow> capacity_rows(const Comparison& comparison, const LimitComparison& limit);

/// The measure in which the capacity is: "PGA".
std::string capacity_measure(const Comparison& comparison);

// ---- fields, in the file, in JSON and in tables ---------------------------------------------------------------------

template <class F>
void visit_fields(std::type_identity<PairedCounts>, F&& f)
{
    f("both", &PairedCounts::both);
    f("base_only", &PairedCounts::base_only);
    f("variant_only", &PairedCounts::variant_only);
    f("neither", &PairedCounts::neither);
}

template <class F>
void visit_fields(std::type_identity<PairedDifference>, F&& f)
{
    f("value", &PairedDifference::value);
    f("lower", &PairedDifference::lower);
    f("upper", &PairedDifference::upper);
}

template <class F>
void visit_fields(std::type_identity<PlaceComparison>, F&& f)
{
    f("", &PlaceComparison::counts);
    f("base_probability", within(&PlaceComparison::base, &Share::probability));
    f("base_probability_lower", within(&PlaceComparison::base, &Share::lower));
    f("base_probability_upper", within(&PlaceComparison::base, &Share::upper));
    f("variant_probability", within(&PlaceComparison::variant, &Share::probability));
    f("variant_probability_lower", within(&PlaceComparison::variant, &Share::lower));
    f("variant_probability_upper", within(&PlaceComparison::variant, &Share::upper));
    f("difference", &PlaceComparison::difference);
    f("difference_lower", &PlaceComparison::lower);
    f("difference_upper", &PlaceComparison::upper);
    f("unpaired_realizations", &PlaceComparison::unpaired);
    f("p", &PlaceComparison::p);
    f("p_adjusted", &PlaceComparison::p_adjusted);
}

template <class F>
void visit_fields(std::type_identity<LimitComparison>, F&& f)
{
    f("limit_states", &LimitComparison::name);
    f("descriptions", &LimitComparison::describe);
    f("damage", &LimitComparison::damage);
}

template <class F>
void visit_fields(std::type_identity<CommonInput>, F&& f)
{
    f("inputs", &CommonInput::name);
    f("input_draws", &CommonInput::draws);
    f("input_numbers", &CommonInput::numbers);
}

template <class F>
void visit_fields(std::type_identity<InputDependence>, F&& f)
{
    f("on", &InputDependence::input);
    f("z", within(&InputDependence::found, &Dependence::z));
    f("p", within(&InputDependence::found, &Dependence::p));
    f("p_adjusted", &InputDependence::p_adjusted);
}

template <class F>
void visit_fields(std::type_identity<VariantComparison>, F&& f)
{
    f("name", &VariantComparison::name);
    f("results", &VariantComparison::results);
    f("study_toml", &VariantComparison::study_toml);
    f("pairs", &VariantComparison::pairs);
    f("invalid_base", &VariantComparison::invalid_base);
    f("invalid_variant", &VariantComparison::invalid_variant);
    f("dropped_pairs", &VariantComparison::dropped);
    f("notes", &VariantComparison::notes);
}

template <class F>
void visit_fields(std::type_identity<Comparison>, F&& f)
{
    f("study_kind", &Comparison::kind);
    f("title", &Comparison::title);
    f("base", &Comparison::base_name);
    f("base_results", &Comparison::base_results);
    f("base_study_toml", &Comparison::base_toml);
    f("level", &Comparison::level);
    f("false_names", &Comparison::rate);
    f("adjustment", &Comparison::adjustment);
    f("measure", &Comparison::measure);
    f("motions", &Comparison::motions);
    f("adaptive_budget", &Comparison::adaptive_budget);
    f("adaptive_margin", &Comparison::adaptive_margin);
    f("adaptive_rounds", &Comparison::adaptive_rounds);
    f("code_version", &Comparison::code_version);
    f("frequency_hz", &Comparison::frequency_hz, {.none = "no surface"});
    f("direction_deg", &Comparison::direction_deg, {.none = "no surface over directions"});
    f("pga_m_s2", &Comparison::pga_m_s2, {.none = "no surface"});
    f("intensity", &Comparison::intensity, {.none = "no stripes"});
}

/// Writes it whole or not at all; the same comparison gives the same bytes.
/// @throws InputError if it cannot be written
void write_comparison(const Comparison& comparison, const std::filesystem::path& file);

/// @throws InputError if the file is none, of another format version, or damaged
Comparison read_comparison(const std::filesystem::path& file);

/// What the file has between its seal and its end.
std::vector<Table> tables_of(const Comparison& comparison);
/// @param file  for messages
/// @throws InputError "FILE: is damaged" where the tables are not those of a comparison
Comparison comparison_from(const std::vector<Table>& tables, const std::string& file);

} // namespace stylobate
