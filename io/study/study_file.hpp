#pragma once
/// The study file: TOML in, `Study` out, every key checked.

#include "ensemble/model/study.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stylobate {

/// One number of a study that a search chooses.
struct SearchedKey {
    std::string key; ///< dotted
    double from = 0, to = 0;
    Spacing spacing = Spacing::linear;
    /// Its value at a place of [0, 1].
    double value(double place) const;
    /// The place of a value. @pre from <= value <= to
    double place(double value) const;
};

/// [optimise] of a study file: what `stylobate compare` searches.
struct OptimiseSpec {
    std::string minimise = "collapse"; ///< name of a limit state
    std::optional<std::string> hazard; ///< file, or a power law; nullopt: the probability is minimised
    std::uint64_t budget = 0;          ///< realizations
    std::vector<SearchedKey> keys;     ///< one to three, by name
};

/// Reads a study file. `overrides` are "KEY=VALUE" settings of the command line (any key, dotted; the value as in TOML,
/// and a bare word is taken as a string), applied before anything is checked.
///
/// @throws InputError with file, line, key, value, the allowed range and what to do: a misspelt key ('did you mean'),
///         a wrong type, a missing key, a value out of range, a key that the chosen kind does not use
Study read_study(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The study with one of its [variants] laid over it.
/// @throws InputError as above, and if there is no such variant
Study read_variant(const std::filesystem::path& file, const std::string& variant,
                   const std::vector<std::string>& overrides = {});
/// Names of its [variants], in the order of their characters.
std::vector<std::string> read_variant_names(const std::filesystem::path& file,
                                            const std::vector<std::string>& overrides = {});
/// Its [optimise]; nothing if it has none.
std::optional<OptimiseSpec> read_optimisation(const std::filesystem::path& file,
                                              const std::vector<std::string>& overrides = {});

/// Reads a study from text; `name` stands for the file in messages.
/// A relative `excitation.file` is left as it is.
Study parse_study(const std::string& text, const std::string& name, const std::vector<std::string>& overrides = {});

/// The canonical TOML text of a study, written from its values: every key with its default, in one order, numbers
/// that read back to the same bits. Left out is what has no default (a title, a record's component, a corner, a
/// perturbation) and values that another key gives in their place (a damping ratio beside a coefficient). `parse_study`
/// of it gives the same study, with the same text. Two studies are the same if their texts are, but for the title.
std::string study_text(const Study& study);

/// For what compares extensions of the model.
/// @param file where the study is from, for the message;  @param what needs double precision: "a diagnosis"
/// @throws InputError if the study requests single precision
void demand_double(const Study& study, const std::string& file, const std::string& what);

/// For what compares motions in the plane. Parameters as above.
/// @throws InputError if the structure is in space
void demand_plane(const Study& study, const std::string& file, const std::string& what);

} // namespace stylobate
