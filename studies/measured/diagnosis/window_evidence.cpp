#include "studies/measured/diagnosis/window_evidence.hpp"

#include "ensemble/tracking/specimen.hpp"
#include "io/keys/words.hpp"
#include "studies/measured/diagnosis/findings/diagnosis_words.hpp"
#include "studies/measured/windows/window_comparison.hpp"
#include "studies/measured/windows/window_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace stylobate {

namespace {

// Free windows: long enough that a slip shows, short enough that an impact that went the other way does not rule.
constexpr double window_part = 0.5; // of the specimen's time scale
constexpr double shortest_window_s = 0.2;
constexpr std::size_t search_runs = 4;

constexpr ContactForm forms[] = {ContactForm::area, ContactForm::two_corner, ContactForm::points};

/// Contacts of a baseline, as factors on those of the study that the search begins with.
struct Contacts {
    ContactForm form = ContactForm::area;
    double stiffness = 1, damping = 1, friction = 1;
};

Study with_contacts(const Study& start, const Contacts& c)
{
    Study study = start;
    study.contact.form = c.form;
    study.contact.normal_stiffness_n_m2 *= c.stiffness;
    study.contact.tangential_stiffness_n_m *= c.stiffness;
    study.contact.normal_damping_ratio = c.damping;
    study.contact.tangential_damping_ratio = c.damping;
    study.contact.normal_damping_n_s_m.reset();
    study.contact.tangential_damping_n_s_m.reset();
    // a dashpot at the centroid damps no rocking: no healthy contact is like that
    study.contact.damping = DampingAt::ends;
    study.contact.friction *= c.friction;
    return study;
}

/// The first repeats of a few motions: enough to choose contacts by.
Campaign of_first_repeats(const Campaign& campaign)
{
    Campaign few = campaign;
    few.runs.clear();
    std::set<int> motions;
    for (const MeasuredRun& run : campaign.runs)
        if (few.runs.size() < search_runs && motions.insert(run.motion_id).second)
            few.runs.push_back(run);
    return few;
}

double sum(const std::vector<double>& v)
{
    return std::accumulate(v.begin(), v.end(), 0.0);
}

/// The baseline gets a search of its own: form, stiffness and damping first, then each contact form's best once more
/// about its values, friction included.
class ContactSearch {
public:
    ContactSearch(WindowComparison& windows, const Study& start, const std::vector<SizedCause>& given,
                  const SpecimenStructure& built, const RunOptions& options, Observer& observer)
        : windows_(windows), start_(start), given_(given), built_(built), options_(options), observer_(observer)
    {
    }

    /// @return false if the observer stopped it
    bool run()
    {
        std::vector<Contacts> contacts;
        for (const ContactForm form : forms)
            for (const double stiffness : {0.1, 0.3, 1.0})
                for (const double damping : {0.1, 0.4})
                    contacts.push_back({form, stiffness, damping, 1});
        return score(contacts) && score(about_the_best(1)) && score(about_the_best(0.5));
    }

    /// The best of each form, best first.
    std::vector<WindowBaseline> baselines() const
    {
        std::vector<WindowBaseline> found;
        for (const Tried& t : best_)
            found.push_back({fmt::format("{}, K_N x {:.3g}, damping {:.3g}, friction x {:.3g}",
                                         word_for(contact_form_names, t.contacts.form), t.contacts.stiffness,
                                         t.contacts.damping, t.contacts.friction),
                             with_contacts(start_, t.contacts), t.score});
        std::sort(found.begin(), found.end(),
                  [](const WindowBaseline& a, const WindowBaseline& b) { return a.score > b.score; });
        return found;
    }

private:
    struct Tried {
        Contacts contacts;
        double score = -std::numeric_limits<double>::infinity();
    };

    /// Each by its own scales.
    bool score(const std::vector<Contacts>& list)
    {
        std::vector<ModelVariant> variants;
        for (const Contacts& c : list)
            variants.push_back(with_causes(with_contacts(start_, c), built_, given_));
        const std::vector<WindowResiduals> residuals = windows_.residuals(variants, options_, observer_);
        for (std::size_t k = 0; k < residuals.size(); ++k) {
            const double total = sum(windows_.scores(residuals[k], windows_.fit_scales(residuals[k])));
            Tried& form = best_[static_cast<std::size_t>(list[k].form)];
            if (total > form.score)
                form = {list[k], total};
        }
        return !residuals.empty();
    }

    std::vector<Contacts> about_the_best(double step) const
    {
        std::vector<Contacts> contacts;
        for (const Tried& t : best_) {
            const Contacts& c = t.contacts;
            for (const double by : {std::pow(1.8, step), std::pow(1.8, -step)}) {
                contacts.push_back({c.form, c.stiffness * by, c.damping, c.friction});
                contacts.push_back({c.form, c.stiffness, std::min(c.damping * by, 1.0), c.friction});
            }
            for (const double by : {1 - 0.06 * step, 1 + 0.06 * step})
                contacts.push_back({c.form, c.stiffness, c.damping, c.friction * by});
        }
        return contacts;
    }

    WindowComparison& windows_;
    const Study& start_;
    const std::vector<SizedCause>& given_;
    const SpecimenStructure& built_;
    const RunOptions& options_;
    Observer& observer_;
    Tried best_[std::size(forms)];
};

} // namespace

ModelVariant with_causes(const Study& study, const SpecimenStructure& built, std::vector<SizedCause> causes)
{
    ModelVariant variant;
    variant.study = study;
    variant.change = [built, causes = std::move(causes)](Realization& r, std::size_t) {
        for (const SizedCause& cause : causes)
            apply_cause(cause, built, r);
    };
    return variant;
}

WindowEvidence window_evidence(const Campaign& campaign, const Study& start, const CampaignScales& scales,
                               const std::vector<SizedCause>& given, const RunOptions& options, Observer& observer)
{
    WindowEvidence out;
    const double length = std::max(shortest_window_s, window_part * scales.time_s);
    const SpecimenStructure built = build_specimen(campaign.specimen);
    WindowComparison few(of_first_repeats(campaign), {length, {}, {}});
    if (few.windows().empty()) {
        out.why_not =
            "No run has both a base motion and a history of the blocks that a simulation could be nudged towards.";
        out.complete = true;
        return out;
    }
    ContactSearch contacts(few, start, given, built, options, observer);
    if (!contacts.run())
        return out;
    out.baselines = contacts.baselines();
    out.cost = few.cost();
    out.complete = true;
    return out;
}

namespace {

constexpr double beyond = 2;        // scales: noise and 20 ms of the local motion
constexpr std::size_t pictured = 2; // runs whose worst block is shown
constexpr std::size_t before = 4;   // windows before the worst one, and as many after it
constexpr double noise_band = 2;    // standard deviations

/// Windows in which one coordinate of a block is off, one after the other.
struct Stretch {
    std::size_t run = 0;
    int block = 0; ///< of the specimen
    int coordinate = 0;
    std::size_t first = 0, last = 0; ///< windows
    std::size_t worst = 0;
    double excess = 0; ///< of the worst
};

std::vector<Stretch> stretches_of(const std::vector<WindowPlace>& windows, const std::vector<WindowExcess>& excess)
{
    std::vector<Stretch> done;
    std::map<std::tuple<std::size_t, int, int>, Stretch> open;
    const auto close = [&](auto it) {
        done.push_back(it->second);
        return open.erase(it);
    };
    for (std::size_t w = 0; w < windows.size(); ++w)
        for (const auto& [what, value] : excess[w]) {
            const auto coordinate = static_cast<int>(what.second);
            const auto key = std::tuple{windows[w].run, what.first, coordinate};
            auto it = open.find(key);
            const bool follows = it != open.end() && windows[w].start_s <= windows[it->second.last].end_s + 1e-6;
            if (it != open.end() && (value < beyond || !follows)) {
                close(it);
                it = open.end();
            }
            if (value < beyond)
                continue;
            if (it == open.end())
                it = open.emplace(key, Stretch{windows[w].run, what.first, coordinate, w, w, w, 0}).first;
            Stretch& stretch = it->second;
            stretch.last = w;
            if (value > stretch.excess) {
                stretch.worst = w;
                stretch.excess = value;
            }
        }
    for (auto it = open.begin(); it != open.end();)
        it = close(it);
    std::stable_sort(done.begin(), done.end(), [](const Stretch& a, const Stretch& b) { return a.excess > b.excess; });
    return done;
}

/// What a number is drawn in.
struct Unit {
    const char* name;
    double per_si;
};

Unit unit_of(BlockCoordinate coordinate, double largest)
{
    if (coordinate == BlockCoordinate::theta)
        return largest < 0.1 ? Unit{"mrad", 1000} : Unit{"rad", 1};
    return largest < 1 ? Unit{"mm", 1000} : Unit{"m", 1};
}

/// One coordinate of a block about its worst window: what was seen with its noise, what the baseline makes of it.
DiagnosisFigure curve_figure(const Stretch& stretch, const std::string& run, BlockCoordinate coordinate,
                             const std::vector<std::size_t>& windows, const std::vector<WindowPlace>& places,
                             const std::vector<WindowCurve>& curves, const std::vector<WindowExcess>& excess)
{
    const auto c = static_cast<std::size_t>(coordinate);
    double largest = 0;
    for (const WindowCurve& curve : curves)
        for (const auto* values : {&curve.seen[c], &curve.model[c]})
            for (const double value : *values)
                largest = std::isfinite(value) ? std::max(largest, std::fabs(value)) : largest;
    const Unit unit = unit_of(coordinate, largest);
    const bool known_noise = std::isfinite(curves.front().noise_sd[c]) && curves.front().noise_sd[c] > 0;
    FigureSeries seen{known_noise ? fmt::format("measured, ± {:g} sd of the noise", noise_band) : "measured",
                      SeriesKind::line,
                      {},
                      {},
                      {},
                      {}};
    FigureSeries model{"calibrated baseline, restarted in each window", SeriesKind::line, {}, {}, {}, {}};
    FigureSeries wrong{"error above noise and a short lag", SeriesKind::spans, {}, {}, {}, {}};
    for (std::size_t k = 0; k < curves.size(); ++k) {
        const WindowCurve& curve = curves[k];
        for (std::size_t i = 0; i < curve.time_s.size(); ++i) {
            seen.x.push_back(curve.time_s[i]);
            seen.y.push_back(unit.per_si * curve.seen[c][i]);
            if (known_noise) {
                seen.low.push_back(unit.per_si * (curve.seen[c][i] - noise_band * curve.noise_sd[c]));
                seen.high.push_back(unit.per_si * (curve.seen[c][i] + noise_band * curve.noise_sd[c]));
            }
            model.x.push_back(curve.time_s[i]);
            model.y.push_back(unit.per_si * curve.model[c][i]);
        }
        model.x.push_back(places[windows[k]].end_s); // a gap: the next one starts anew
        model.y.push_back(std::numeric_limits<double>::quiet_NaN());
        const auto found = excess[windows[k]].find({stretch.block, coordinate});
        if (found == excess[windows[k]].end() || found->second < beyond)
            continue;
        const WindowPlace& place = places[windows[k]];
        if (!wrong.y.empty() && place.start_s <= wrong.y.back() + 1e-6) {
            wrong.y.back() = place.end_s;
        } else {
            wrong.x.push_back(place.start_s);
            wrong.y.push_back(place.end_s);
        }
    }
    DiagnosisFigure figure;
    figure.place = FigurePlace::wrong;
    figure.title = fmt::format("Run {}, {}, {}.", run, block_words(stretch.block),
                               coordinate == BlockCoordinate::theta ? "rotation" : "horizontal displacement");
    figure.caption = "Measured and simulated motion. The simulation starts from the measured motion at the beginning "
                     "of each window and runs freely to its end; grey: windows with significant errors.";
    figure.x_label = "time, the cameras' clock [s]";
    figure.y_label =
        fmt::format("{} [{}]", coordinate == BlockCoordinate::theta ? "rotation" : "displacement", unit.name);
    figure.series = {std::move(seen), std::move(model)};
    if (!wrong.x.empty())
        figure.series.push_back(std::move(wrong));
    return figure;
}

/// The windows about the worst one of a stretch, of its run.
std::vector<std::size_t> windows_about(const Stretch& stretch, const std::vector<WindowPlace>& places)
{
    std::vector<std::size_t> windows;
    const std::size_t from = stretch.worst - std::min(stretch.worst, before);
    for (std::size_t w = from; w < std::min(stretch.worst + before + 1, places.size()); ++w)
        if (places[w].run == stretch.run)
            windows.push_back(w);
    return windows;
}

} // namespace

WrongWindows wrong_windows(const Campaign& campaign, const Study& baseline, std::size_t most, const RunOptions& options,
                           SimulationCount& count, Observer& observer)
{
    WrongWindows found;
    const SpecimenStructure built = build_specimen(campaign.specimen);
    WindowComparison comparison(campaign, {});
    const std::vector<WindowPlace>& places = comparison.windows();
    if (places.empty())
        return found;
    ModelVariant variant;
    variant.study = baseline;
    const std::vector<WindowResiduals> residuals = comparison.residuals({variant}, options, observer);
    if (!residuals.empty()) {
        const std::vector<WindowExcess> excess = excess_of(comparison, residuals.front(), built);
        const std::vector<Stretch> stretches = stretches_of(places, excess);
        found.shown = choose_windows(places, excess);
        std::set<std::size_t> shown; // the blocks of a run are off together
        for (const Stretch& s : stretches) {
            const std::string& run = campaign.runs[s.run].name;
            if (found.stretches.size() < most)
                found.stretches.push_back({run, s.block, coordinate_names[s.coordinate], places[s.first].start_s,
                                           places[s.last].end_s, s.excess});
            if (s.block < 0 || shown.size() == pictured || !shown.insert(s.run).second)
                continue;
            const std::vector<std::size_t> windows = windows_about(s, places);
            const std::vector<WindowCurve> curves = comparison.curves(
                variant, windows, {static_cast<std::size_t>(built.block[static_cast<std::size_t>(s.block)])}, options,
                observer);
            if (curves.empty())
                break;
            for (const BlockCoordinate coordinate : {BlockCoordinate::x, BlockCoordinate::theta})
                found.figures.push_back(curve_figure(s, run, coordinate, windows, places, curves, excess));
        }
    }
    count += comparison.cost();
    return found;
}

} // namespace stylobate
