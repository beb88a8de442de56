#include "bench/work_precision/page.hpp"

namespace stylobate::work {

const char* name(ContactForm form)
{
    return form == ContactForm::area ? "area" : form == ContactForm::two_corner ? "two_corner" : "points";
}

const char* name(DampingAt damping)
{
    return damping == DampingAt::centroid ? "centroid" : "ends";
}

void draw(const Report& report, const std::filesystem::path& png)
{
    const verification::PictureAxis cost{"block-steps per simulated second", true, 0, 0};
    const auto panel = [&](const char* error, const std::vector<verification::Series>& series, bool log) {
        return verification::curves(cost, {error, log, 0, 0}, series, "tmargin left Left reverse maxcols 1") +
               "\nreset\n";
    };
    run_gnuplot("set multiplot layout 1,3\n" + panel("error of the quarter period", report.quarter_period, true) +
                    panel("error of the overturning amplitude", report.overturning, true) +
                    panel("collapse probability less that of a fine step", report.collapse, false) +
                    "unset multiplot\n",
                {2400, 1000}, png);
}

} // namespace stylobate::work
