// How often does a monument reach its limit states at a site, and how likely is that over years?
//
//   risk RESULTS.h5 HAZARD
//
// RESULTS.h5: of a fragility study, or a comparison of fragility studies. HAZARD: a file, or a power law such as
// k0=1e-3,k=3,measure=pga.

#include <stylobate/stylobate.hpp>

#include <cstdio>

namespace sb = stylobate::api;

int main(int argc, char** argv)
try {
    if (argc != 3) {
        std::fprintf(stderr, "usage: risk RESULTS.h5 HAZARD\n");
        return 2;
    }
    const auto found = sb::risk(argv[1], {argv[2]});
    if (!found)
        return 1;
    std::printf("%s", found->text().c_str());
    for (const sb::Column& column : found->rows().columns)
        std::printf("%s%s%s\n", column.name.c_str(), column.unit.empty() ? "" : ", ", column.unit.c_str());
    found->write("risk.h5");
    if (const auto page = sb::report("risk.h5"))
        page->write("risk.html");
} catch (const sb::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
