#pragma once
/// The style and the script of a page: the files of `studies/report/page`, which the build embeds into the program.

#include <string_view>

namespace stylobate {

std::string_view page_style();

/// All scripts one after the other, to stand in one block of braces.
std::string_view page_script();

} // namespace stylobate
