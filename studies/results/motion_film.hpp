#pragma once
/// One realization in motion, alone: as a page, or as a film by ffmpeg.

#include "ensemble/model/observer.hpp"
#include "kernels/isa.hpp"
#include "studies/results/results.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace stylobate {

/// "html", "gif", "mp4", "webm".
bool is_motion_format(std::string_view format);

/// The realization's trajectory, of the file or run again, as the player of the page shows it, in real time; in the
/// plane with rods, tendons and clamps; in space a film has the view of the player's start. A film has no texts; it has
/// 25 frames a second as GIF, else 50, and at most `longest_film_s` seconds.
/// @param title of the page; nullopt: by the results and the realization
/// @param file written whole or not at all
/// @returns false if the observer stopped it; there is no file then
/// @throws InputError if there is no such realization, if a film is asked for and ffmpeg (or the program that
///         STYLOBATE_FFMPEG names) is missing or fails, if the realization is longer, and if the file cannot be written
bool write_motion(const Results& results, Isa isa, std::uint64_t index, const std::optional<std::string>& title,
                  const std::string& format, const std::filesystem::path& file, Observer& observer);

inline constexpr double longest_film_s = 600;

} // namespace stylobate
