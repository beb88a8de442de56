/// Whether a specimen can be: sizes, densities, and what touches what.

#include "ensemble/model/input_error.hpp"
#include "io/measured/measured_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {
namespace {

class SpecimenChecks {
public:
    explicit SpecimenChecks(const Campaign& campaign) : campaign_(campaign), specimen_(campaign.specimen) {}

    void check_sizes() const
    {
        constexpr double largest_m = 20, smallest_m = 1e-4;
        check_list("half_width_m", specimen_.half_width_m, smallest_m, largest_m, "m");
        check_list("half_height_m", specimen_.half_height_m, smallest_m, largest_m, "m");
        check_list("depth_m", specimen_.depth_m, smallest_m, 2 * largest_m, "m");
        check_list("mass_kg", specimen_.mass_kg, 1e-5, 1e7, "kg");
        const auto within = [&](const char* name, double value, double low, double high) {
            if (!(value >= low && value <= high))
                refuse(fmt::format("specimen: {} = {:g} is outside [{:g}, {:g}].", name, value, low, high));
        };
        within("gravity_m_s2", specimen_.gravity_m_s2, 0.1, 100);
        within("friction_nominal", specimen_.friction_nominal.value_or(0.5), 0, 5);
        within("mass_tolerance", specimen_.mass_tolerance, 0, 1);
        within("width_tolerance", specimen_.width_tolerance, 0, 1);
        within("placement_tolerance_m", specimen_.placement_tolerance_m, 0, largest_m);
        within("base_block_half_width_m", specimen_.base_block_half_width_m.value_or(1), smallest_m, 10 * largest_m);
        within("base_block_top_m", specimen_.base_block_top_m, 0, largest_m);
        for (const auto* list : {&specimen_.rest_x_m, &specimen_.rest_y_m})
            for (std::size_t i = 0; i < list->size(); ++i)
                if (!(std::abs((*list)[i]) <= 200))
                    refuse(fmt::format("specimen/{}: {:g} m of block {} is beyond 200 m.\n  Units are SI. Did you mean "
                                       "{:.4g}?",
                                       list == &specimen_.rest_x_m ? "rest_x_m" : "rest_y_m", (*list)[i], i,
                                       (*list)[i] / 1000));
        const std::size_t n = specimen_.half_width_m.size();
        if (n == 0 || specimen_.half_height_m.empty() || specimen_.depth_m.empty() || specimen_.mass_kg.empty())
            return;
        for (std::size_t i = 0; i < n; ++i) {
            const double volume = 4 * specimen_.half_width_m[i] * specimen_.half_height_m[i] * specimen_.depth_m[i];
            const double density = specimen_.mass_kg[i] / volume;
            constexpr double lightest = 300, heaviest = 25000;
            if (density >= lightest && density <= heaviest)
                continue;
            // the usual slips, and what the density would be without them
            const struct {
                double factor;
                const char* slip;
            } slips[] = {{1e-3, "a mass in grams"},
                         {1e3, "a mass in tonnes"},
                         {8, "half sizes that are full sizes"},
                         {0.125, "full sizes that are half sizes"},
                         {4, "half width and half height that are full ones"},
                         {0.25, "width and height that are half ones"}};
            std::string guess;
            for (const auto& [factor, slip] : slips)
                if (guess.empty() && density * factor > 1500 && density * factor < 4000)
                    guess = fmt::format(" Did you mean another unit or measure: {}? That would be {:.0f} kg/m3.", slip,
                                        density * factor);
            refuse(fmt::format("specimen: block {} would have a density of {:.4g} kg/m3, outside [{:g}, {:g}]: {:g} kg "
                               "in {:g} x {:g} x {:g} m.\n  Sizes in the file are half widths and half heights, and "
                               "the whole depth.{}",
                               i, density, lightest, heaviest, specimen_.mass_kg[i], 2 * specimen_.half_width_m[i],
                               2 * specimen_.half_height_m[i], specimen_.depth_m[i], guess));
        }
    }

    void check_geometry() const
    {
        const std::size_t n = specimen_.half_width_m.size();
        const auto& joints = specimen_.joints;
        if (!joints.empty())
            for (std::size_t i = 0; i < block_count(campaign_); ++i)
                if (std::none_of(joints.begin(), joints.end(), [&](const auto& joint) {
                        return joint.first == static_cast<int>(i) || joint.second == static_cast<int>(i);
                    }))
                    refuse(
                        fmt::format("specimen/joints: block {} has no joint.\n  Every block stands on another one or "
                                    "on the base (-1).",
                                    i));
        if (n == 0 || specimen_.half_height_m.empty() || specimen_.rest_x_m.empty() || specimen_.rest_y_m.empty())
            return;
        for (std::size_t j = 0; j < joints.size(); ++j) {
            const auto upper = static_cast<std::size_t>(joints[j].second);
            const double near = 0.02 * specimen_.half_height_m[upper];
            const bool on_base = joints[j].first < 0;
            const auto lower = static_cast<std::size_t>(std::max(joints[j].first, 0));
            const double floor =
                on_base ? specimen_.base_block_half_width_m ? specimen_.base_block_top_m : 0 : edge(lower, 1);
            const double gap = edge(upper, 0) - floor;
            const std::string pair =
                on_base ? fmt::format("block {} and the base", upper) : fmt::format("blocks {} and {}", lower, upper);
            if (std::abs(gap) > near)
                refuse(
                    fmt::format("specimen: joint {}: {} do not touch at rest: the upper one's lower face is {} {} the "
                                "lower one's upper face.\n  Correct rest_y_m, half_height_m or the joint.",
                                j, pair, length_words(std::abs(gap)), gap > 0 ? "above" : "below"));
            const double shared =
                on_base ? 1 : std::min(edge(lower, 3), edge(upper, 3)) - std::max(edge(lower, 2), edge(upper, 2));
            if (shared <= 0)
                refuse(fmt::format("specimen: joint {}: {} are beside each other, {} apart.\n  Correct rest_x_m, "
                                   "half_width_m or the joint.",
                                   j, pair, length_words(-shared)));
        }
        for (std::size_t b = 1; b < n; ++b)
            for (std::size_t a = 0; a < b; ++a) {
                const double wide = std::min(edge(a, 3), edge(b, 3)) - std::max(edge(a, 2), edge(b, 2));
                const double high = std::min(edge(a, 1), edge(b, 1)) - std::max(edge(a, 0), edge(b, 0));
                if (wide > 0.02 * specimen_.half_width_m[b] && high > 0.02 * specimen_.half_height_m[b])
                    refuse(
                        fmt::format("specimen: blocks {} and {} overlap at rest by {}.\n  Correct rest_x_m, rest_y_m "
                                    "or their sizes.",
                                    a, b, length_words(std::min(wide, high))));
            }
    }

private:
    [[noreturn]] void refuse(const std::string& text) const { throw InputError(campaign_.source, 0, text); }

    /// Positive, finite, and of a size that stones have.
    void check_list(const char* name, const std::vector<double>& values, double low, double high,
                    const char* unit) const
    {
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (values[i] > low && values[i] <= high)
                continue;
            std::string guess;
            for (const double factor : {0.001, 0.01, 1000.0})
                if (guess.empty() && values[i] * factor > 100 * low && values[i] * factor <= high / 10)
                    guess = fmt::format(" Did you mean {:.4g}?", values[i] * factor);
            refuse(fmt::format("specimen/{}: {:g} of block {} is outside ({:g}, {:g}] {}.\n  Units are SI.{}", name,
                               values[i], i, low, high, unit, guess));
        }
    }

    /// Bottom, top, left and right of a block at rest.
    double edge(std::size_t block, int side) const
    {
        const std::vector<double>& middle = side < 2 ? specimen_.rest_y_m : specimen_.rest_x_m;
        const std::vector<double>& half = side < 2 ? specimen_.half_height_m : specimen_.half_width_m;
        return middle[block] + (side % 2 == 0 ? -half[block] : half[block]);
    }

    const Campaign& campaign_;
    const Specimen& specimen_;
};

} // namespace

void check_specimen(const Campaign& campaign)
{
    const SpecimenChecks checks(campaign);
    checks.check_sizes();
    checks.check_geometry();
}

} // namespace stylobate
