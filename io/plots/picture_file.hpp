#pragma once
/// Pictures as files: SVG as it is, PNG and PDF by librsvg.

#include <filesystem>
#include <string>

namespace stylobate {

/// Size of a picture in pixels.
struct PictureSize {
    int width = 1800;
    int height = 1350;
};

/// Writes a drawing, whole or not at all: as SVG or PDF (72 pixels an inch) by its file extension, else as PNG.
///
/// librsvg is loaded when the first PNG or PDF is written, so that a program without it can do everything else.
/// @param svg a document of SVG of that size   @param file its folder must exist
/// @throws InputError if librsvg is missing or reports an error, if the machine has no fonts, or if the picture cannot
///         be written
void write_picture(const std::string& svg, PictureSize size, const std::filesystem::path& file);

/// Whether a picture of that name could be written now: for what takes long before it draws.
/// @throws InputError as `write_picture` does
void check_picture(const std::filesystem::path& file);

} // namespace stylobate
