#pragma once
/// A page and its pictures, for the sections of a kind.

#include "studies/report/html.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace stylobate {

struct PageWriter {
    HtmlPage& page;
    /// Puts a picture into the page, or a note why it could not be drawn. The function draws a PNG.
    std::function<void(const std::string& caption, const std::function<void(const std::filesystem::path& png)>& draw)>
        picture;
};

} // namespace stylobate
