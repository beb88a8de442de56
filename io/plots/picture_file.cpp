#include "io/plots/picture_file.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/program.hpp"

#include <cairo-pdf.h>
#include <cairo.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <librsvg/rsvg.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <memory>
#include <optional>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

constexpr double pixels_per_inch = 72; // of a drawing in a PDF: a point for each pixel

/// The functions of librsvg and of its libraries that a picture needs.
struct Rasterizer {
    decltype(&rsvg_handle_new_from_data) load = nullptr;
    decltype(&rsvg_handle_set_dpi) set_dpi = nullptr;
    decltype(&rsvg_handle_render_document) render = nullptr;
    decltype(&g_object_unref) unref = nullptr;
    decltype(&g_error_free) free_error = nullptr;
    decltype(&cairo_create) create = nullptr;
    decltype(&cairo_destroy) destroy = nullptr;
    decltype(&cairo_set_source_rgb) set_colour = nullptr;
    decltype(&cairo_paint) paint = nullptr;
    decltype(&cairo_status) status = nullptr;
    decltype(&cairo_image_surface_create) image = nullptr;
    decltype(&cairo_pdf_surface_create_for_stream) pdf = nullptr;
    decltype(&cairo_surface_write_to_png_stream) write_png = nullptr;
    decltype(&cairo_surface_finish) finish = nullptr;
    decltype(&cairo_surface_destroy) destroy_surface = nullptr;
};

/// @throws InputError if it is not there
const Rasterizer& rasterizer()
{
    static const std::optional<Rasterizer> found = []() -> std::optional<Rasterizer> {
        // Its own libraries come with it, and their functions are found through it.
        const char* const named = std::getenv("STYLOBATE_LIBRSVG");
        void* const library =
            ::dlopen(named != nullptr && *named != '\0' ? named : "librsvg-2.so.2", RTLD_NOW | RTLD_LOCAL);
        if (library == nullptr)
            return std::nullopt;
        Rasterizer r;
        bool whole = true;
        const auto find = [&]<class Function>(Function& function, const char* name) {
            function = reinterpret_cast<Function>(::dlsym(library, name));
            whole = whole && function != nullptr;
        };
        find(r.load, "rsvg_handle_new_from_data");
        find(r.set_dpi, "rsvg_handle_set_dpi");
        find(r.render, "rsvg_handle_render_document");
        find(r.unref, "g_object_unref");
        find(r.free_error, "g_error_free");
        find(r.create, "cairo_create");
        find(r.destroy, "cairo_destroy");
        find(r.set_colour, "cairo_set_source_rgb");
        find(r.paint, "cairo_paint");
        find(r.status, "cairo_status");
        find(r.image, "cairo_image_surface_create");
        find(r.pdf, "cairo_pdf_surface_create_for_stream");
        find(r.write_png, "cairo_surface_write_to_png_stream");
        find(r.finish, "cairo_surface_finish");
        find(r.destroy_surface, "cairo_surface_destroy");
        return whole ? std::optional(r) : std::nullopt;
    }();
    if (!found)
        throw InputError(
            "no picture can be drawn as PNG or PDF: librsvg was not found.\n"
            "  Install it: apt install librsvg2-2. Or set STYLOBATE_LIBRSVG to its path, or name a file .svg, "
            "which needs nothing.");
    return *found;
}

/// Without any font a picture has no text, and nobody reports it: so fontconfig is asked before.
void check_fonts()
{
    const std::optional<fs::path> lister = find_program("fc-list");
    if (!lister)
        return;
    const TemporaryFolder folder;
    const fs::path log = folder / "fonts.log";
    if (run_program(*lister, {}, folder.path(), log) == 0 && content_of(log).empty())
        throw InputError("no picture can be drawn: this machine has no fonts, so the text would be missing.\n"
                         "  Install some: apt install fonts-dejavu-core.");
}

cairo_status_t append_bytes(void* to, const unsigned char* data, unsigned int length)
{
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

/// The drawing as the bytes of a PNG or a PDF.
std::string rendered(const std::string& svg, PictureSize size, bool pdf)
{
    const Rasterizer& r = rasterizer();
    const auto failed = [](const std::string& what) {
        return InputError("librsvg could not draw the picture: " + what +
                          ".\n  Name a file .svg, which needs no librsvg.");
    };
    GError* error = nullptr;
    const std::unique_ptr<RsvgHandle, void (*)(void*)> drawing(
        r.load(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error), r.unref);
    const auto said = [&] {
        std::string text = error != nullptr ? error->message : "no message";
        if (error != nullptr)
            r.free_error(error);
        return text;
    };
    if (!drawing)
        throw failed(said());
    r.set_dpi(drawing.get(), pixels_per_inch);
    std::string bytes;
    const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
        pdf ? r.pdf(append_bytes, &bytes, size.width, size.height)
            : r.image(CAIRO_FORMAT_RGB24, size.width, size.height),
        r.destroy_surface);
    const std::unique_ptr<cairo_t, void (*)(cairo_t*)> context(r.create(surface.get()), r.destroy);
    r.set_colour(context.get(), 1, 1, 1);
    r.paint(context.get());
    const RsvgRectangle whole{0, 0, static_cast<double>(size.width), static_cast<double>(size.height)};
    if (!r.render(drawing.get(), context.get(), &whole, &error))
        throw failed(said());
    if (r.status(context.get()) != CAIRO_STATUS_SUCCESS)
        throw failed("its size is too large for the memory");
    if (!pdf && r.write_png(surface.get(), append_bytes, &bytes) != CAIRO_STATUS_SUCCESS)
        throw failed("no PNG was made");
    r.finish(surface.get());
    return bytes;
}

std::string lower_ending(const fs::path& file)
{
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending;
}

} // namespace

void check_picture(const fs::path& file)
{
    AtomicFile::check(file);
    if (lower_ending(file) == ".svg")
        return;
    rasterizer();
    check_fonts();
}

void write_picture(const std::string& svg, PictureSize size, const fs::path& file)
{
    AtomicFile target(file); // refuses before any work is done
    const std::string ending = lower_ending(file);
    if (ending == ".svg") {
        target.write(svg);
    } else {
        check_fonts();
        target.write(rendered(svg, size, ending == ".pdf"));
    }
    target.commit();
}

} // namespace stylobate
