// What does an intervention change? A study with a table [variants], and each limit state's difference with its
// interval.
//
//   compare STUDY.toml
//
// The results of the studies are written into the working folder; the same command continues them.

#include <stylobate/stylobate.hpp>

#include <cstdio>

namespace sb = stylobate::api;

int main(int argc, char** argv)
try {
    if (argc != 2) {
        std::fprintf(stderr, "usage: compare STUDY.toml\n");
        return 2;
    }
    sb::CompareOptions options;
    options.tell = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
    const auto found = sb::compare({argv[1]}, options);
    if (!found) // only where `go_on` stops it
        return 1;

    // The columns of a table have names and units; a number with an interval has three of them.
    const sb::Table& rows = found->rows();
    const auto difference = rows.numbers("difference"), lower = rows.numbers("difference_lower"),
               upper = rows.numbers("difference_upper");
    for (std::size_t i = 0; i < difference.size(); ++i)
        if (rows.texts("place")[i] == "all")
            std::printf("%s, %s: %+.4f (%+.4f to %+.4f), %s\n", rows.texts("variant")[i].c_str(),
                        rows.texts("limit_state")[i].c_str(), difference[i], lower[i], upper[i],
                        rows.texts("verdict")[i].c_str());
    found->write("comparison.h5"); // for sb::risk, sb::report, and the command line
} catch (const sb::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
