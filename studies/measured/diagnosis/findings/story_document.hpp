#pragma once
/// The story of the tests of single joints, for the console and for the page of a diagnosis.

#include "studies/measured/diagnosis/findings/test_story.hpp"
#include "studies/report/document.hpp"

namespace stylobate {

/// What the console shows: the answer, what each test showed and what was believed before and after it, limits, the
/// next test with its sheet.
void add_story(const TestStory& story, Document& document);

/// For the page: the estimates of each test in standard deviations from healthy specimens.
void add_story_figures(const TestStory& story, Document& document);

} // namespace stylobate
