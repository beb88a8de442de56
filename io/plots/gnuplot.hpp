#pragma once
/// gnuplot as a separate program: finds it, feeds it a script, brings the picture home.

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

// Another program that a picture or a film needs: found at run time, run without a shell.

/// The first executable of that name in PATH.
std::optional<std::filesystem::path> find_program(const char* name);

/// The program that an environment variable names, or else the one in PATH.
/// @param lacking what cannot be done without it: "no picture can be drawn"   @param package of Debian that has it
/// @throws InputError if there is none, with what to install
std::filesystem::path find_tool(const char* name, const char* variable, const std::string& lacking,
                                const std::string& package);

/// All bytes of a file; none if it cannot be read.
std::string content_of(const std::filesystem::path& file);

/// Runs a program in `folder`, its output and its errors in `log`. The status is the program's exit status, or 128 +
/// the signal that ended it.
/// @param input piece after piece of its standard input, until an empty one; what a program does not read is lost.
///        Without it the standard input is empty
/// @throws InputError if it cannot be started
int run_program(const std::filesystem::path& program, std::vector<std::string> arguments,
                const std::filesystem::path& folder, const std::filesystem::path& log,
                const std::function<std::string()>& input = nullptr);

struct CellAxis;

/// Size of a picture in pixels.
struct PictureSize {
    int width = 1800;
    int height = 1350;
};

/// viridis (van der Walt and Smith, 2015): even steps look even, to the colour-blind too, and in grey.
inline constexpr std::array<const char*, 11> viridis{"#440154", "#482475", "#414487", "#355f8d", "#2a788e", "#21918c",
                                                     "#22a884", "#44bf70", "#7ad151", "#bddf26", "#fde725"};
/// The colour at a value in [0, 1], "#rrggbb"; beyond, that of the nearest end.
std::string viridis_colour(double value);
/// The command that makes viridis the palette.
std::string viridis_palette();

/// Where gnuplot is: the program named by the environment variable STYLOBATE_GNUPLOT if that is set, else the first
/// one in PATH.
/// @throws InputError if there is none, with what to install
std::filesystem::path find_gnuplot();

/// A literal of gnuplot for any text: quoted, nothing in it is interpreted, line breaks and other control characters
/// become blanks, bytes that are not UTF-8 become '?'.
std::string gnuplot_text(std::string_view text);

/// Commands for the two lines above a picture: the title (smaller if it is long) and the subtitle.
std::string gnuplot_heading(std::string_view title, std::string_view subtitle, PictureSize size = {});

/// Commands for the scale, the range (first to last edge) and the tics of an axis.
std::string gnuplot_axis(char letter, const CellAxis& axis);

/// Runs a script whose terminal and output are set already (UTF-8, no markup in texts) and writes the picture to
/// `file`, whole or not at all: as SVG or PDF by its file extension, else as PNG. The script and its by-products
/// live in a temporary folder that is removed.
///
/// @throws InputError if gnuplot is missing, cannot be started or reports an error (its first lines are quoted), if the
///         machine has no fonts, or if the picture cannot be written
void run_gnuplot(const std::string& script, PictureSize size, const std::filesystem::path& file);

} // namespace stylobate
