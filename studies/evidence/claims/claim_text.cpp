#include "studies/evidence/claims/claim_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cmath>

namespace stylobate::claims {

namespace {

bool is_length(const Measure& m)
{
    return m.kind == Measure::Kind::median &&
           (m.amount == Amount::total_sliding_m || m.amount == Amount::residual_sliding_m ||
            m.amount == Amount::peak_top_m);
}

std::string event_phrase(const Measure& m, Event event)
{
    return event == Event::collapsed_early
               ? fmt::format("collapses within {:g} cycles of the start of the strong shaking", m.within_cycles)
               : event_text(event);
}

std::string limit_text(const Measure& m, double value)
{
    const std::string unit = unit_text(m);
    return fmt::format("{:g}{}{}", is_length(m) ? 1000 * value : value, unit.empty() ? "" : " ", unit);
}

std::string axis_label(const ClaimFile& file, const std::string& name)
{
    for (const VariantAxis& axis : file.axes)
        if (axis.name == name)
            return axis.label;
    return name;
}

} // namespace

std::string event_text(Event event)
{
    return word_of(event_words, event).text;
}

std::string unit_text(const Measure& m)
{
    if (m.kind == Measure::Kind::onset)
        return "m/s²";
    if (is_length(m))
        return "mm";
    const bool angle = m.amount == Amount::total_rocking_rad || m.amount == Amount::rocking_path_rad;
    return m.kind == Measure::Kind::median && angle ? "rad" : "";
}

std::string number_text(const Measure& m, const Estimate& e)
{
    if (!e.known())
        return "unknown";
    const double scale = is_length(m) ? 1000 : 1;
    const std::string unit = unit_text(m).empty() ? "" : " " + unit_text(m);
    if (m.kind == Measure::Kind::onset) {
        if (std::isinf(e.upper) && std::isinf(e.value))
            return fmt::format("above {:.3g}{}", e.lower, unit);
        if (e.lower == 0)
            return fmt::format("at most {:.3g}{}", e.upper, unit);
    }
    return fmt::format("{:.3g} [{:.3g}, {}]{}", scale * e.value, scale * e.lower,
                       std::isinf(e.upper) ? "∞" : fmt::format("{:.3g}", scale * e.upper), unit);
}

std::string measure_text(const Measure& m)
{
    std::string text;
    switch (m.kind) {
    case Measure::Kind::probability:
        text = fmt::format("the probability that it {}", event_phrase(m, m.event));
        break;
    case Measure::Kind::minority:
        text =
            fmt::format("the smaller of the probabilities that it {} and that it does not", event_phrase(m, m.event));
        break;
    case Measure::Kind::median:
        text = fmt::format("the median {}", word_of(amount_words, m.amount).text);
        break;
    case Measure::Kind::onset:
        text = fmt::format("the lowest PGA at which it {} with probability 1/2", event_phrase(m, m.event));
        break;
    }
    if (m.given)
        text += fmt::format(" (given that it {})", event_phrase(m, *m.given));
    return text;
}

std::string short_text(const Measure& m)
{
    return m.kind == Measure::Kind::median ? word_of(amount_words, m.amount).text : event_text(m.event);
}

std::string window_text(const Window& w, const char* unit)
{
    const std::string of = w.over_f1 ? "of the first natural frequency" : unit;
    const bool open_end = std::isinf(w.to);
    if (!w.values.empty())
        return fmt::format("at {:g} {}", fmt::join(w.values, ", "), of);
    if (open_end)
        return w.from > 0 ? fmt::format("from {:g} {} on", w.from, of) : "";
    if (w.from == w.to)
        return fmt::format("at {:g} {}", w.from, of);
    return w.from > 0 ? fmt::format("from {:g} to {:g} {}", w.from, w.to, of) : fmt::format("up to {:g} {}", w.to, of);
}

std::string criterion_text(const ClaimFile& file, const Test& test)
{
    const Criterion& c = test.criterion;
    const char* way = c.way == Criterion::Way::rises ? "rises" : "falls";
    const bool of_onset = c.measure.kind == Measure::Kind::onset;
    std::string text;
    switch (c.kind) {
    case Criterion::Kind::bound:
        text = measure_text(c.measure) + " is ";
        if (c.at_least)
            text += "at least " + limit_text(c.measure, *c.at_least);
        if (c.at_most)
            text += (c.at_least ? " and at most " : "at most ") + limit_text(c.measure, *c.at_most);
        text += c.any ? " in at least one cell" : " in every cell";
        break;
    case Criterion::Kind::trend:
        text = fmt::format("{} {} with frequency: the last frequency against the first, and no pair of frequencies in "
                           "the opposite direction",
                           measure_text(c.measure), way);
        break;
    case Criterion::Kind::order:
        if (c.way == Criterion::Way::either)
            text = fmt::format("{} differs between levels of {}, in at least one cell", measure_text(c.measure),
                               axis_label(file, c.along));
        else
            text = fmt::format("{} {} from each level of {} to the next, in {}", measure_text(c.measure), way,
                               axis_label(file, c.along),
                               c.any ? "at least one cell and in no cell in the opposite direction" : "every cell");
        break;
    case Criterion::Kind::paired:
        text =
            fmt::format("{} {} from the first level of {} to the last, by pairs of realizations with the same draws, "
                        "over the cells in which 5 to 95 % of the two levels together do",
                        measure_text(c.measure), way, axis_label(file, c.along));
        break;
    case Criterion::Kind::same:
        text =
            fmt::format("the most frequent response mode{} is the same for every {}, in the cells in which something "
                        "moves",
                        c.measure.given ? fmt::format(" (given that it {})", event_text(*c.measure.given)) : "",
                        axis_label(file, c.along));
        break;
    }
    if (!of_onset)
        if (const std::string where = window_text(c.pga, "m/s²"); !where.empty())
            text += ", " + where;
    if (test.ranges.size() == 1) {
        if (const std::string where = window_text(test.ranges.front().frequency, "Hz"); !where.empty())
            text += ", " + where;
    } else {
        text += "; evaluated separately:";
        for (std::size_t i = 0; i < test.ranges.size(); ++i)
            text += (i == 0 ? " " : " and ") + test.ranges[i].name;
    }
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text + ".";
}

const char* to_string(Finding finding)
{
    return finding == Finding::holds ? "holds" : finding == Finding::fails ? "fails" : "undecided";
}

} // namespace stylobate::claims
