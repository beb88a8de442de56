#include "studies/evidence/claims/claim.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/files/key_reader.hpp"
#include "io/keys/ranges.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <fstream>
#include <iterator>

namespace stylobate::claims {

namespace {

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

using Type = TomlValue::Type;

constexpr std::array kind_words{
    Word<Criterion::Kind>{"bound", Criterion::Kind::bound}, Word<Criterion::Kind>{"trend", Criterion::Kind::trend},
    Word<Criterion::Kind>{"order", Criterion::Kind::order}, Word<Criterion::Kind>{"paired", Criterion::Kind::paired},
    Word<Criterion::Kind>{"same", Criterion::Kind::same}};
constexpr std::array measure_words{Word<Measure::Kind>{"probability", Measure::Kind::probability},
                                   Word<Measure::Kind>{"minority", Measure::Kind::minority},
                                   Word<Measure::Kind>{"median", Measure::Kind::median},
                                   Word<Measure::Kind>{"onset", Measure::Kind::onset}};
using Way = Criterion::Way;
constexpr std::array way_words{Word<Way>{"falls", Way::falls}, Word<Way>{"rises", Way::rises},
                               Word<Way>{"either", Way::either}};
constexpr std::array source_words{Word<bool>{"paper", false}, Word<bool>{"inference", true}};
constexpr std::array where_words{Word<bool>{"all", false}, Word<bool>{"any", true}};
const std::vector<std::string> measure_keys{"measure", "event", "amount", "given", "within_cycles", "between_steps"};

std::vector<std::string> strings(const KeyReader& keys, std::string_view key)
{
    std::vector<std::string> all;
    const TomlValue* array = keys.find(key);
    if (array == nullptr)
        return all;
    const bool fits =
        array->type == Type::array && std::all_of(array->entries.begin(), array->entries.end(),
                                                  [](const TomlValue& entry) { return entry.type == Type::string; });
    if (!fits)
        keys.refuse(key, "is not a list of strings");
    for (const TomlValue& entry : array->entries)
        all.push_back(entry.text);
    return all;
}

/// A text, or a list of texts that are joined by blanks; nullopt where it is absent or has no character.
std::optional<std::string> prose(const KeyReader& keys, std::string_view key)
{
    const TomlValue* value = keys.find(key);
    if (value == nullptr)
        return std::nullopt;
    std::string text = value->type != Type::array ? keys.text(key) : "";
    if (value->type == Type::array)
        for (const std::string& part : strings(keys, key))
            text += (text.empty() ? "" : " ") + part;
    return text.empty() ? std::nullopt : std::optional(text);
}

/// [from, to], or one number for both, or three and more values.
bool read_window(const KeyReader& keys, std::string_view key, Window& window)
{
    const TomlValue* value = keys.find(key);
    if (value == nullptr)
        return false;
    const std::vector<TomlValue> given =
        value->type == Type::array ? value->entries : std::vector<TomlValue>{*value, *value};
    std::vector<double> numbers;
    for (const TomlValue& one : given)
        if ((one.type == Type::number || one.type == Type::integer) && one.number >= 0 && std::isfinite(one.number))
            numbers.push_back(one.number);
    if (numbers.size() != given.size() || numbers.size() < 2 || !std::is_sorted(numbers.begin(), numbers.end()))
        keys.refuse(key, "is not a window", "Give one number, [from, to], or three and more values, ascending.");
    window.from = numbers.front();
    window.to = numbers.back();
    if (value->type != Type::array)
        window.values = {numbers.front()};
    else if (numbers.size() > 2)
        window.values = numbers;
    return true;
}

void read_frequency(const KeyReader& keys, Window& window)
{
    if (read_window(keys, "frequency_over_f1", window)) {
        window.over_f1 = true;
        if (keys.has("frequency_hz"))
            keys.refuse("frequency_hz", "and frequency_over_f1 exclude each other", "Give one of the two.");
    } else {
        read_window(keys, "frequency_hz", window);
    }
}

Measure read_measure(const KeyReader& keys)
{
    Measure m;
    m.kind = keys.choice("measure", measure_words);
    if (m.kind == Measure::Kind::median)
        m.amount = keys.choice("amount", amount_words);
    else
        m.event = keys.choice("event", event_words);
    if (keys.has("given"))
        m.given = keys.choice("given", event_words);
    if (m.event == Event::collapsed_early || m.given == Event::collapsed_early)
        m.within_cycles = keys.number("within_cycles", cycles_range);
    m.between_steps = keys.boolean_or("between_steps", false);
    if (m.between_steps && m.kind != Measure::Kind::onset)
        keys.refuse("between_steps", "is for an onset");
    return m;
}

Criterion read_criterion(const KeyReader& keys)
{
    std::vector<std::string> known = measure_keys;
    known.insert(known.end(), {"kind", "pga_m_s2", "at_least", "at_most", "where", "direction", "along"});
    keys.allow_only(known);
    using Kind = Criterion::Kind;
    Criterion c;
    c.kind = keys.choice("kind", kind_words);
    if (c.kind != Kind::same)
        c.measure = read_measure(keys);
    else if (keys.has("given"))
        c.measure.given = keys.choice("given", event_words);
    if (c.kind == Kind::paired && (c.measure.kind != Measure::Kind::probability || c.measure.given))
        keys.refuse("measure", "is compared by pairs",
                    "Pairs have the probability of an event, without `given`: give measure = \"probability\".");
    read_window(keys, "pga_m_s2", c.pga);
    if (c.kind == Kind::bound) {
        const stylobate::Range any{-1e300, 1e300, false};
        c.at_least = keys.maybe_number("at_least", any);
        c.at_most = keys.maybe_number("at_most", any);
        if (!c.at_least && !c.at_most)
            keys.missing("at_least", "A bound has at_least or at_most, or both.");
    }
    if (c.kind == Kind::bound || c.kind == Kind::order)
        c.any = keys.choice_or("where", where_words, c.any);
    if (c.kind == Kind::trend || c.kind == Kind::order || c.kind == Kind::paired)
        c.way = keys.choice("direction", way_words);
    if (c.way == Way::either && c.kind != Kind::order)
        keys.refuse("direction", "is for the order of levels; a trend and pairs fall or rise");
    if (c.kind == Kind::order || c.kind == Kind::paired || c.kind == Kind::same)
        c.along = keys.text("along");
    return c;
}

std::vector<VariantAxis> read_axes(const KeyReader& keys)
{
    std::vector<VariantAxis> axes;
    for (const KeyReader& one : keys.tables("axis")) {
        one.allow_only({"name", "label", "levels"});
        VariantAxis axis;
        axis.name = one.text("name");
        axis.label = one.has("label") ? one.text("label") : axis.name;
        for (const KeyReader& level : one.tables("levels")) {
            level.allow_only({"name", "set", "only", "also", "law"});
            axis.levels.push_back({level.text("name"), strings(level, "set"), strings(level, "only")});
            axis.levels.back().law = level.text_if_given("law");
            for (const KeyReader& also : level.tables("also")) {
                also.allow_only({"only", "set"});
                axis.levels.back().also.push_back({strings(also, "only"), strings(also, "set")});
            }
        }
        if (axis.levels.empty())
            one.missing("levels", "Give levels = [{ name = \"...\", set = [\"KEY=VALUE\"] }, ...].");
        axes.push_back(axis);
    }
    return axes;
}

/// "AXIS=LEVEL" words must name what there is.
void check_words(const KeyReader& keys, std::string_view key, const std::vector<VariantAxis>& axes,
                 const std::vector<std::string>& words)
{
    for (const std::string& word : words) {
        const bool known = std::any_of(axes.begin(), axes.end(), [&](const VariantAxis& axis) {
            return std::any_of(axis.levels.begin(), axis.levels.end(),
                               [&](const Level& level) { return axis.name + '=' + level.name == word; });
        });
        if (!known)
            keys.refuse(key, fmt::format("has \"{}\", which is no AXIS=LEVEL of this file", word));
    }
}

Test read_test(const KeyReader& keys, const std::vector<VariantAxis>& axes)
{
    keys.allow_only({"id", "says", "section", "source", "stand_ins", "after_trials", "contradiction", "criterion",
                     "ranges", "frequency_hz", "frequency_over_f1", "only", "untestable", "impossible", "reason",
                     "figures"});
    Test test;
    test.id = keys.text("id");
    const std::optional<std::string> says = prose(keys, "says");
    if (!says)
        keys.missing("says", "Give the statement of the paper, in other words.");
    test.says = *says;
    test.section = keys.text("section");
    test.inference = keys.choice_or("source", source_words, false);
    test.stand_ins = prose(keys, "stand_ins");
    test.after_trials = prose(keys, "after_trials");
    test.contradiction = prose(keys, "contradiction");
    test.untestable = prose(keys, "untestable");
    test.impossible = prose(keys, "impossible");
    if (!keys.has("criterion"))
        keys.missing("criterion", "A claim is decided by a criterion.");
    test.criterion = read_criterion(keys.table("criterion"));
    const std::optional<std::string>& along = test.criterion.along;
    if (along && axis_index(axes, *along) == axes.size())
        keys.table("criterion").refuse("along", "is no axis of this file");

    for (const KeyReader& one : keys.tables("ranges")) {
        one.allow_only({"name", "frequency_hz", "frequency_over_f1"});
        Range range;
        range.name = one.text("name");
        read_frequency(one, range.frequency);
        test.ranges.push_back(range);
    }
    if (test.ranges.empty()) {
        test.ranges.push_back({});
        read_frequency(keys, test.ranges.back().frequency);
    }
    test.only = strings(keys, "only");
    check_words(keys, "only", axes, test.only);
    const KeyReader reason = keys.table("reason");
    reason.allow_only({"confirmed", "refuted", "depends", "untestable"});
    test.reasons = {prose(reason, "confirmed"), prose(reason, "refuted"), prose(reason, "depends"),
                    prose(reason, "untestable")};
    test.figures = strings(keys, "figures");
    return test;
}

Figure read_figure(const KeyReader& keys, const std::vector<VariantAxis>& axes)
{
    keys.allow_only({"name", "title", "caption", "x", "y_label", "log_y", "measures", "frequency_hz",
                     "frequency_over_f1", "pga_m_s2", "only", "line", "line_label"});
    Figure figure;
    figure.name = keys.text("name");
    figure.title = keys.text("title");
    figure.caption = prose(keys, "caption").value_or("");
    figure.x = keys.text("x");
    if (figure.x != "frequency" && figure.x != "pga" && axis_index(axes, figure.x) == axes.size())
        keys.refuse("x", "is neither frequency nor pga nor an axis of this file");
    figure.y_label = keys.text("y_label");
    figure.log_y = keys.boolean_or("log_y", false);
    for (const KeyReader& one : keys.tables("measures")) {
        one.allow_only(measure_keys);
        figure.measures.push_back(read_measure(one));
    }
    if (figure.measures.empty())
        keys.missing("measures", "Give measures = [{ measure = \"onset\", event = \"rocked\" }, ...].");
    read_frequency(keys, figure.frequency);
    read_window(keys, "pga_m_s2", figure.pga);
    figure.only = strings(keys, "only");
    check_words(keys, "only", axes, figure.only);
    figure.line = keys.maybe_number("line", {-1e300, 1e300, false});
    figure.line_label = keys.text_if_given("line_label").value_or("");
    return figure;
}

/// "the probability that it collapses", "the median total sliding", for sentences.
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

/// "at 2.15 m/s2", "from 1 to 8 Hz", "above 4 Hz"; nullopt for everything.
std::optional<std::string> window_text(const Window& w, const char* unit)
{
    const std::string of = w.over_f1 ? "of the first natural frequency" : unit;
    const bool open_end = std::isinf(w.to);
    if (!w.values.empty())
        return fmt::format("at {:g} {}", fmt::join(w.values, ", "), of);
    if (open_end)
        return w.from > 0 ? std::optional(fmt::format("from {:g} {} on", w.from, of)) : std::nullopt;
    if (w.from == w.to)
        return fmt::format("at {:g} {}", w.from, of);
    return w.from > 0 ? fmt::format("from {:g} to {:g} {}", w.from, w.to, of) : fmt::format("up to {:g} {}", w.to, of);
}

} // namespace

std::size_t axis_index(const std::vector<VariantAxis>& axes, const std::string& name)
{
    return static_cast<std::size_t>(
        std::find_if(axes.begin(), axes.end(), [&](const VariantAxis& axis) { return axis.name == name; }) -
        axes.begin());
}

bool picked(const std::vector<VariantAxis>& axes, const Levels& levels, const std::vector<std::string>& only)
{
    return std::all_of(only.begin(), only.end(), [&](const std::string& word) {
        const std::string name = word.substr(0, word.find('='));
        const std::size_t i = axis_index(axes, name);
        return i < axes.size() &&
               std::find(only.begin(), only.end(), name + '=' + axes[i].levels[levels[i]].name) != only.end();
    });
}

std::vector<Levels> variants(const std::vector<VariantAxis>& axes)
{
    std::vector<Levels> all;
    Levels levels(axes.size(), 0);
    for (bool more = true; more;) {
        bool allowed = true;
        for (std::size_t i = 0; i < axes.size(); ++i)
            allowed = allowed && picked(axes, levels, axes[i].levels[levels[i]].only);
        if (allowed)
            all.push_back(levels);
        more = false;
        for (std::size_t i = axes.size(); i-- > 0 && !more;) {
            more = ++levels[i] < axes[i].levels.size();
            if (!more)
                levels[i] = 0;
        }
    }
    return all;
}

std::vector<std::string> settings_of(const std::vector<VariantAxis>& axes, const Levels& levels)
{
    std::vector<std::string> settings;
    const auto add = [&](const std::vector<std::string>& more) {
        settings.insert(settings.end(), more.begin(), more.end());
    };
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const Level& level = axes[i].levels[levels[i]];
        add(level.set);
        for (const Together& also : level.also)
            if (picked(axes, levels, also.only))
                add(also.set);
    }
    return settings;
}

std::optional<std::string> law_of(const std::vector<VariantAxis>& axes, const Levels& levels)
{
    for (std::size_t i = 0; i < axes.size(); ++i)
        if (const Level& level = axes[i].levels[levels[i]]; level.law)
            return level.law;
    return std::nullopt;
}

std::string variant_text(const std::vector<VariantAxis>& axes, const Levels& levels)
{
    std::string text;
    for (std::size_t i = 0; i < axes.size(); ++i)
        if (axes[i].levels.size() > 1)
            text += (text.empty() ? "" : ", ") + axes[i].label + ' ' + axes[i].levels[levels[i]].name;
    return text;
}

std::string variant_key(const std::vector<VariantAxis>& axes, const Levels& levels)
{
    std::string text;
    for (std::size_t i = 0; i < axes.size(); ++i)
        text += (text.empty() ? "" : " ") + axes[i].name + '=' + axes[i].levels[levels[i]].name;
    return text;
}

bool is_length(const Measure& m)
{
    return m.kind == Measure::Kind::median && m.amount == Amount::total_sliding_m;
}

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
    return m.kind == Measure::Kind::median && m.amount == Amount::total_rocking_rad ? "rad" : "";
}

std::string short_text(const Measure& m)
{
    return m.kind == Measure::Kind::median ? word_of(amount_words, m.amount).text : event_text(m.event);
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
                               file.axes[axis_index(file.axes, *c.along)].label);
        else
            text = fmt::format("{} {} from each level of {} to the next, in {}", measure_text(c.measure), way,
                               file.axes[axis_index(file.axes, *c.along)].label,
                               c.any ? "at least one cell and in no cell in the opposite direction" : "every cell");
        break;
    case Criterion::Kind::paired:
        text =
            fmt::format("{} {} from the first level of {} to the last, by pairs of realizations with the same draws, "
                        "over the cells in which 5 to 95 % of the two levels together do",
                        measure_text(c.measure), way, file.axes[axis_index(file.axes, *c.along)].label);
        break;
    case Criterion::Kind::same:
        text =
            fmt::format("the most frequent response mode{} is the same for every {}, in the cells in which something "
                        "moves",
                        c.measure.given ? fmt::format(" (given that it {})", event_text(*c.measure.given)) : "",
                        file.axes[axis_index(file.axes, *c.along)].label);
        break;
    }
    if (!of_onset)
        if (const std::optional<std::string> where = window_text(c.pga, "m/s²"))
            text += ", " + *where;
    if (test.ranges.size() == 1) {
        if (const std::optional<std::string> where = window_text(test.ranges.front().frequency, "Hz"))
            text += ", " + *where;
    } else {
        text += "; evaluated separately:";
        for (std::size_t i = 0; i < test.ranges.size(); ++i)
            text += (i == 0 ? " " : " and ") + test.ranges[i].name;
    }
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text + ".";
}

ClaimFile parse_claims(const std::string& text, const std::string& name)
{
    const TomlValue root = parse_toml(text, name);
    const KeyReader top(&root, "", root.place);
    if (!top.has("claim"))
        top.missing("claim", "A claim file is a study with a section [claim].");
    const KeyReader keys = top.table("claim");
    keys.allow_only({"what", "axis", "test", "figure"});

    ClaimFile file;
    file.file = name;
    file.name = std::filesystem::path(name).stem().string();
    file.what = prose(keys, "what").value_or("");
    file.axes = read_axes(keys);
    for (const KeyReader& one : keys.tables("axis"))
        for (const KeyReader& level : one.tables("levels")) {
            check_words(level, "only", file.axes, strings(level, "only"));
            for (const KeyReader& also : level.tables("also"))
                check_words(also, "only", file.axes, strings(also, "only"));
        }
    for (const KeyReader& one : keys.tables("test"))
        file.tests.push_back(read_test(one, file.axes));
    for (const KeyReader& one : keys.tables("figure"))
        file.figures.push_back(read_figure(one, file.axes));
    return file;
}

ClaimFile read_claims(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw InputError(file.string(), 0, "cannot be read.\n  Check the path and its permissions.");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    return parse_claims(text, file.string());
}

} // namespace stylobate::claims
