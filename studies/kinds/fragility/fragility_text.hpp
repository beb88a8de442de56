#pragma once
/// A fragility study in words, as JSON, as a section of a page, and as a picture.

#include "io/plots/figure.hpp"
#include "studies/kinds/fragility/fragility.hpp"
#include "studies/kinds/kind.hpp"
#include "studies/report/document.hpp"
#include "studies/report/json.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace stylobate {

/// Lines for a terminal: each limit state with median and dispersion, and what must be known of them.
std::string fragility_text(const Fragility& fragility);
Json fragility_json(const Fragility& fragility);

/// "20 motions (18 different), 4 structures under each".
std::string design_text(const Fragility& fragility);

/// Whether a lognormal curve could be fitted.
bool has_curve(const StateFragility& state);

/// The limit state that the answer is about: the collapse; null where there are none.
const StateFragility* principal_state(const Fragility& fragility);

/// The intensity at which half of the structures fall, with its interval.
Answer fragility_answer(const Fragility& fragility);

/// Of each limit state, the collapse first and at first alone shown: the fitted curve with its band, with the p-value
/// of its lack of fit in the legend; the shares of the stripes with their intervals; and the monotone curve through
/// these where the lognormal one does not fit or where there is none.
Figure fragility_figure(const Fragility& fragility);

/// The section of a result's page.
void fragility_section(const Fragility& fragility, Document& page);

/// Curves of all limit states of one kind each, with their bands, and the shares of the stripes with their bars.
/// @param states names of limit states; without any: the peak's, and the collapse
/// @throws InputError for a name that is none, or if nothing can be drawn
void plot_fragility(const Fragility& fragility, const std::vector<std::string>& states, const std::string& title,
                    const std::filesystem::path& png);

} // namespace stylobate
