#pragma once
/// What the model of a study leaves out: one sentence, which every summary and every page with an answer has.
/// docs/space.md measures what the plane leaves out; the pages carry its table.

#include "ensemble/model/study.hpp"
#include "studies/report/document.hpp"

#include <optional>
#include <string>

namespace stylobate {

/// The sentence of a model. @param dimensions 2: planar, 3: in space
std::string left_out_text(int dimensions);
std::string left_out_text(const Study& study);

/// Of the study whose text a file has; nullopt where this version cannot read it.
std::optional<std::string> left_out_text_of(const std::string& study_toml);

/// Puts the sentence into a page; the measured table opens below it.
void add_left_out(Document& page, int dimensions);
/// Of the study whose text a file has; nothing where this version cannot read it.
void add_left_out_of(Document& page, const std::string& study_toml);

/// The table of docs/space.md: shares of collapsed realizations in the plane and in space, in %.
HtmlTable left_out_evidence();

} // namespace stylobate
