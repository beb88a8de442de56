#include "studies/measured/loop/done_test.hpp"

#include "ensemble/model/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

std::vector<SeenEstimate> seen_estimates(const Signatures& signatures, const DoneTest& test)
{
    std::vector<SeenEstimate> out;
    for (const NamedEstimate& estimate : test.estimates) {
        const auto found =
            std::find_if(signatures.columns.begin(), signatures.columns.end(), [&](const TestColumn& column) {
                return column.test == test.test && column.joint == estimate.joint && column.name == estimate.name;
            });
        if (found == signatures.columns.end())
            throw InputError(
                fmt::format("{}: no simulated test has the estimate '{}' at joint {}.\n  Remove the file "
                            "of the sequence and diagnose the campaign again: its estimates are made anew.",
                            test_words(test.test, test.joint), estimate.name, estimate.joint));
        if (std::isfinite(estimate.value))
            out.push_back({found - signatures.columns.begin(), estimate.value});
    }
    return out;
}

std::vector<SeenEstimate> seen_estimates(const Signatures& signatures, const std::vector<DoneTest>& tests)
{
    std::vector<SeenEstimate> out;
    for (const DoneTest& test : tests) {
        const std::vector<SeenEstimate> more = seen_estimates(signatures, test);
        out.insert(out.end(), more.begin(), more.end());
    }
    return out;
}

std::string test_words(RunKind test, const std::optional<int>& joint)
{
    return std::string(test_kind_name(test)) + (joint ? fmt::format(" at joint {}", *joint) : " at all joints");
}

} // namespace stylobate
