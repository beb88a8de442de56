#include "studies/measured/diagnosis/findings/story_document.hpp"

#include "studies/report/html_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t most_estimates = 8; ///< of a step that are told: the farthest ones; the file has all

std::string percent_of(double share)
{
    return share < 0.01 ? "below 1 %" : fmt::format("{:.0f} %", 100 * share);
}

HtmlTable belief_table(const StoryStep& step)
{
    HtmlTable table{"lrr", {"what acts", "before", "after"}, {}, ""};
    for (const StoryBelief& belief : step.beliefs)
        table.rows.push_back({belief.what, percent_of(belief.before), percent_of(belief.after)});
    return table;
}

HtmlTable estimate_table(const StoryStep& step)
{
    HtmlTable table{"lrrrrl", {"estimate", "joint", "measured", "expected", "standard deviations", "by"}, {}, ""};
    std::vector<const StoryEstimate*> order;
    for (const StoryEstimate& e : step.seen)
        order.push_back(&e);
    std::ranges::stable_sort(order, [](const StoryEstimate* a, const StoryEstimate* b) {
        return std::fabs(a->deviations) > std::fabs(b->deviations);
    });
    order.resize(std::min(order.size(), most_estimates));
    for (const StoryEstimate* e : order) {
        const std::string unit = e->unit.empty() ? "" : " " + e->unit;
        table.rows.push_back({code(e->name), fmt::format("{}", e->joint), fmt::format("{:.4g}{}", e->value, unit),
                              fmt::format("{:.4g}{}", e->expected, unit), fmt::format("{:+.1f}", e->deviations),
                              e->from_the_others ? "the other joints" : "healthy specimens"});
    }
    return table;
}

void add_options(const TestStory& story, Document& document)
{
    HtmlTable table{"lrrrl",
                    {"test", "cost", "belief gained", "entropy lost", "belief per cost"},
                    {},
                    "Tests that could come next"};
    for (const StoryOption& option : story.options)
        table.rows.push_back({option.test, fmt::format("{:g}", option.cost), fmt::format("{:.3f}", option.belief_gain),
                              fmt::format("{:.3f}", option.entropy_fall),
                              option.left_out.empty() ? fmt::format("{:.3f}", option.per_cost) : option.left_out});
    document.table(table);
}

} // namespace

const char* to_string(SequenceVerdict verdict)
{
    return FieldWords<SequenceVerdict>::words[static_cast<std::size_t>(verdict)];
}

void add_story(const TestStory& story, Document& document)
{
    document.box(story.verdict == SequenceVerdict::named  ? "bad"
                 : story.verdict == SequenceVerdict::none ? "good"
                                                          : "warn",
                 fmt::format("Tests of single joints: {}", to_string(story.verdict)), story.text);
    for (std::size_t i = 0; i < story.steps.size(); ++i) {
        const StoryStep& step = story.steps[i];
        document.heading(fmt::format("Test {}: {} at joints {}", i + 1, step.test, step.joints));
        document.paragraph(step.text);
        document.table(belief_table(step));
        document.table(estimate_table(step));
    }
    if (!story.limits.empty()) {
        HtmlTable table{"ll", {"cause", "limit (95 %)"}, {}, "What the tests leave possible"};
        for (const StoryLimit& limit : story.limits)
            table.rows.push_back({limit.cause, limit.size.empty() ? "not bounded by what was simulated" : limit.size});
        document.table(table);
    }
    if (!story.next.empty()) {
        document.heading(story.next.size() == 1
                             ? "The next test: " + story.next.front()
                             : fmt::format("The tests that tell most: {}", fmt::join(story.next, ", then ")));
        std::vector<Html> lines;
        for (const std::string& line : story.sheet)
            lines.emplace_back(line);
        document.list(lines);
        add_options(story, document);
    }
    if (!story.notes.empty()) {
        std::vector<Html> notes;
        for (const std::string& note : story.notes)
            notes.emplace_back(note);
        document.list(notes);
    }
}

void add_story_figures(const TestStory& story, Document& document)
{
    for (const StoryStep& step : story.steps) {
        Figure figure;
        figure.title = fmt::format("{}: standard deviations from healthy specimens", step.test);
        figure.y_label = "standard deviations";
        FigureSeries points{"estimate", SeriesKind::points, {}, {}, {}, {}};
        for (const StoryEstimate& e : step.seen) {
            points.x.push_back(static_cast<double>(figure.x_ticks.size()));
            points.y.push_back(e.deviations);
            figure.x_ticks.push_back(fmt::format("{} {}", e.name.substr(e.name.find('.') + 1), e.joint));
        }
        if (points.x.empty())
            continue;
        const double last = static_cast<double>(points.x.size()) - 0.5;
        FigureSeries healthy{"healthy, 95 %", SeriesKind::band, {-0.5, last}, {}, {-2, -2}, {2, 2}};
        figure.series = {healthy, points};
        document.figure(figure_svg(figure, 240),
                        fmt::format("Estimates of {} by joint, from what healthy specimens or the other joints let "
                                    "expect; band: 2 standard deviations.",
                                    step.test));
    }
}

} // namespace stylobate
