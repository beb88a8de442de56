#pragma once
/// A diagnosis as a page.

#include "studies/measured/diagnosis/findings/diagnosis.hpp"
#include "studies/report/html.hpp"

#include <string>

namespace stylobate {

/// The verdict first, then what it rests on.
/// @param file for names
/// @param title of the page; empty: by the specimen
HtmlPage diagnosis_page(const Diagnosis& diagnosis, const std::string& file, const std::string& title = "");

} // namespace stylobate
