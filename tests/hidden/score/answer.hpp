#pragma once
/// The answer to a virtual campaign, kept apart from it: what is hidden, where, how strongly, and whether it can be
/// seen.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stylobate::hidden {

struct AnswerEffect {
    std::string name;
    bool listed = true; ///< among the mechanisms that a verdict can name
    std::string place;
    std::string parameter;
    double size = 0;
    bool size_comparable = true;
    double snr_noise = 0;
    double snr_scatter = 0;
    double law_share = 0;
    bool detectable = false;
};

struct Answer {
    std::uint64_t seed = 0;
    std::string law;
    std::string specimen;
    std::vector<AnswerEffect> effects; ///< none, one or two
    int runs = 0;
    int collapses = 0;
    double friction = 0; ///< mean over the beds, without what effects change

    /// The right one: "none", "named" or "unexplained".
    std::string verdict() const;
};

/// Text of a TOML file.
std::string text_of(const Answer& answer);

/// @throws InputError if the file is no answer
Answer read_answer(const std::filesystem::path& file);

} // namespace stylobate::hidden
