#pragma once
/// Where the texts of a picture lie, read from its SVG: no two of them may overlap, and none may leave the picture.

#include "io/plots/text_width.hpp"
#include "tests/io/store/export_cases.hpp"

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

namespace stylobate {

struct PlacedText {
    std::string words;
    double left = 0, top = 0, right = 0, bottom = 0;
};

inline std::string attribute(const std::string& element, const std::string& name)
{
    const std::size_t at = element.find(" " + name + "=\"");
    if (at == std::string::npos)
        return "";
    const std::size_t begin = at + name.size() + 3;
    return element.substr(begin, element.find('"', begin) - begin);
}

/// The texts of a document of SVG, but for slanted ones.
inline std::vector<PlacedText> texts_of(const std::string& svg)
{
    const std::string root = svg.substr(svg.find("<svg"), svg.find('>', svg.find("<svg")) - svg.find("<svg"));
    const double usual = std::stod(attribute(root, "font-size"));
    std::vector<PlacedText> texts;
    for (std::size_t at = svg.find("<text"); at != std::string::npos; at = svg.find("<text", at + 1)) {
        const std::size_t end = svg.find('>', at);
        const std::string element = svg.substr(at, end - at);
        const std::string words = std::regex_replace(svg.substr(end + 1, svg.find("</text>", end) - end - 1),
                                                     std::regex("&[#a-z0-9]+;"), "x");
        const std::string size = attribute(element, "font-size"), turn = attribute(element, "transform");
        const double font = size.empty() ? usual : std::stod(size);
        const double x = std::stod(attribute(element, "x")), y = std::stod(attribute(element, "y"));
        const double wide = font * text_width(words);
        const std::string anchor = attribute(element, "text-anchor");
        const double before = anchor == "end" ? wide : anchor == "middle" ? wide / 2 : 0;
        const double high = 0.73 * font; // of capitals and digits
        if (turn.empty())
            texts.push_back({words, x - before, y - high, x - before + wide, y});
        else if (turn.starts_with("rotate(-90"))
            texts.push_back({words, x - high, y + before - wide, x, y + before});
    }
    return texts;
}

/// What is wrong with the texts of a picture: those that overlap, and those that leave it.
inline std::string text_faults(const std::string& svg)
{
    const std::string root = svg.substr(svg.find("<svg"), svg.find('>', svg.find("<svg")) - svg.find("<svg"));
    const double width = std::stod(attribute(root, "width")), height = std::stod(attribute(root, "height"));
    const std::vector<PlacedText> texts = texts_of(svg);
    std::string faults;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const PlacedText& a = texts[i];
        if (a.left < 0 || a.top < 0 || a.right > width || a.bottom > height)
            faults += "'" + a.words + "' leaves the picture\n";
        for (std::size_t k = i + 1; k < texts.size(); ++k) {
            const PlacedText& b = texts[k];
            if (std::min(a.right, b.right) > std::max(a.left, b.left) + 1 &&
                std::min(a.bottom, b.bottom) > std::max(a.top, b.top) + 1)
                faults += "'" + a.words + "' and '" + b.words + "' overlap\n";
        }
    }
    return faults;
}

} // namespace stylobate
