#include "studies/diagnosis/decision/window_evidence.hpp"

#include "studies/diagnosis/decision/slip_score.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/tracking/specimen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace stylobate {

namespace {

// Free windows: long enough that a slip shows, short enough that an impact that went the other way does not rule.
constexpr double window_part = 0.5; // of the specimen's time scale
constexpr double shortest_window_s = 0.2;
// The smallest sizes tried beyond those of the list are between two neighbours of the best one.
constexpr std::size_t refined = 8; ///< causes whose size is looked at more closely
constexpr std::size_t judging_forms = 2;
constexpr std::size_t search_runs = 4;

struct FormName {
    ContactForm form;
    const char* name;
};
constexpr FormName forms[] = {
    {ContactForm::area, "area"}, {ContactForm::two_corner, "two_corner"}, {ContactForm::points, "points"}};

Study with_contacts(const Study& start, ContactForm form, double stiffness, double damping, double friction)
{
    Study study = start;
    study.contact.form = form;
    study.contact.normal_stiffness_n_m2 *= stiffness;
    study.contact.tangential_stiffness_n_m *= stiffness;
    study.contact.normal_damping_ratio = damping;
    study.contact.tangential_damping_ratio = damping;
    study.contact.normal_damping_n_s_m.reset();
    study.contact.tangential_damping_n_s_m.reset();
    // a dashpot at the centroid damps no rocking: no healthy contact is like that
    study.contact.damping = DampingAt::ends;
    study.contact.friction *= friction;
    return study;
}

class Windows {
public:
    Windows(const Campaign& campaign, const TrackScales& scales, double length_s, const std::vector<SizedCause>& given,
            const RunOptions& options, Observer& observer)
        : built_(build_specimen(campaign.specimen)), comparison_(campaign, {length_s, 0, {}}),
          slip_(campaign, built_, comparison_, scales), given_(given), options_(options), observer_(observer)
    {
    }

    bool empty() const { return comparison_.windows().empty(); }
    const WindowComparison& comparison() const { return comparison_; }

    ModelVariant variant(const Study& study, const SizedCause* tried) const
    {
        ModelVariant v;
        v.study = study;
        std::vector<SizedCause> causes = given_;
        if (tried)
            causes.push_back(*tried);
        v.change = [causes, this](Realization& r, std::size_t) {
            for (const SizedCause& cause : causes)
                apply_cause(cause, built_, r);
        };
        return v;
    }

    /// (variants x windows) log scores of all coordinates, or of slip alone, each by its own scales; empty if stopped.
    std::vector<std::vector<double>> scores(const std::vector<ModelVariant>& variants, bool slip)
    {
        std::vector<std::vector<double>> out;
        const std::vector<WindowResiduals> residuals = comparison_.residuals(variants, options_, observer_);
        for (const WindowResiduals& z : residuals)
            out.push_back(slip ? slip_(z) : comparison_.scores(z, comparison_.fit_scales(z)));
        return out;
    }

private:
    SpecimenStructure built_;
    WindowComparison comparison_;
    SlipScore slip_;
    const std::vector<SizedCause>& given_;
    const RunOptions& options_;
    Observer& observer_;
};

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

/// Size and its standard deviation from the scores of several sizes: a parabola through the best and its neighbours.
void size_of(const std::map<double, double>& score, CauseFit& fit)
{
    auto best = score.begin();
    for (auto it = score.begin(); it != score.end(); ++it)
        if (it->second > best->second)
            best = it;
    fit.size = best->first;
    const bool first = best == score.begin(), last = std::next(best) == score.end();
    if (first || last) {
        const auto other = first ? std::next(best) : std::prev(best);
        fit.sd = other == score.end() ? std::fabs(best->first) : std::fabs(other->first - best->first) / 2;
        return;
    }
    const auto [x0, y0] = *std::prev(best);
    const auto [x1, y1] = *best;
    const auto [x2, y2] = *std::next(best);
    const double left = (y1 - y0) / (x1 - x0), right = (y2 - y1) / (x2 - x1);
    const double curvature = 2 * (right - left) / (x2 - x0);
    const double widest = (x2 - x0) / 2;
    if (curvature < 0) {
        fit.size = std::clamp((x0 + x1) / 2 - left / curvature, x0, x2);
        fit.sd = std::min(std::sqrt(-1 / curvature), widest);
    } else {
        fit.sd = widest;
    }
    // windows are not quite independent, and the model is not quite right
    fit.sd = std::max(fit.sd, widest / 4);
}

/// Contacts of a baseline, as factors on those of the study that the search begins with.
struct Contacts {
    FormName form;
    double stiffness, damping, friction;
};

/// The baseline gets a search of its own: form, stiffness and damping first, then each contact form's best once more
/// about its values, friction included.
class ContactSearch {
public:
    ContactSearch(Windows& windows, const Study& start) : windows_(windows), start_(start) {}

    /// @return false if the observer stopped it
    bool run()
    {
        std::vector<Contacts> contacts;
        for (const FormName& form : forms)
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
            found.push_back({fmt::format("{}, K_N x {:.3g}, damping {:.3g}, friction x {:.3g}", t.contacts.form.name,
                                         t.contacts.stiffness, t.contacts.damping, t.contacts.friction),
                             study_of(t.contacts), t.score});
        std::sort(found.begin(), found.end(),
                  [](const WindowBaseline& a, const WindowBaseline& b) { return a.score > b.score; });
        return found;
    }

private:
    struct Tried {
        Contacts contacts;
        double score = -std::numeric_limits<double>::infinity();
    };

    Study study_of(const Contacts& c) const
    {
        return with_contacts(start_, c.form.form, c.stiffness, c.damping, c.friction);
    }

    bool score(const std::vector<Contacts>& list)
    {
        std::vector<ModelVariant> variants;
        for (const Contacts& c : list)
            variants.push_back(windows_.variant(study_of(c), nullptr));
        const std::vector<std::vector<double>> scores = windows_.scores(variants, false);
        for (std::size_t k = 0; k < scores.size(); ++k) {
            Tried& form = best_[static_cast<std::size_t>(list[k].form.form)];
            if (sum(scores[k]) > form.score)
                form = {list[k], sum(scores[k])};
        }
        return !scores.empty();
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

    Windows& windows_;
    const Study& start_;
    Tried best_[std::size(forms)];
};

/// Every cause, beside the two best contact forms: what it gains is what both of them grant it.
class CauseSearch {
public:
    CauseSearch(Windows& windows, const Campaign& campaign, const std::vector<WindowBaseline>& baselines)
        : windows_(windows), runs_(campaign.runs.size()), baselines_(baselines),
          judges_(std::min<std::size_t>(judging_forms, baselines.size()))
    {
    }

    /// @return false if the observer stopped it
    bool run(const std::vector<TriedCause>& causes) { return try_listed_sizes(causes) && refine_the_best(); }

    /// One for each mechanism and place, the best first.
    void report(WindowEvidence& out)
    {
        std::stable_sort(found_.begin(), found_.end(),
                         [](const Found& a, const Found& b) { return a.fit.gain > b.fit.gain; });
        for (Found& f : found_) {
            if (f.fit.gain > 0)
                size_of(f.gain, f.fit);
            if (std::any_of(out.causes.begin(), out.causes.end(), [&](const CauseFit& other) {
                    return other.cause.mechanism == f.fit.cause.mechanism && other.cause.place == f.fit.cause.place;
                }))
                continue;
            out.causes.push_back(f.fit);
            out.gain_by_form.push_back(f.by_form);
        }
    }

private:
    struct Found {
        CauseFit fit;
        std::map<double, double> gain; ///< by size
        std::vector<double> by_form;   ///< (judges) at the best size
    };

    bool try_listed_sizes(const std::vector<TriedCause>& causes)
    {
        std::vector<SizedCause> list;
        for (const TriedCause& t : causes)
            for (const double size : t.sizes)
                list.push_back({t.cause, size});
        if (!score(list))
            return false;
        std::size_t next = 0;
        for (const TriedCause& t : causes) {
            Found f;
            f.fit.cause = t.cause;
            f.fit.size = t.cause.neutral;
            f.fit.gain_by_run.assign(runs_, 0);
            f.by_form.assign(judges_, 0);
            f.gain[t.cause.neutral] = 0;
            for (const double size : t.sizes)
                take(f, size, next++, list.size());
            found_.push_back(std::move(f));
        }
        return true;
    }

    /// Sizes between the best one and its neighbours, of the causes that gain most.
    bool refine_the_best()
    {
        std::sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) { return a.fit.gain > b.fit.gain; });
        std::vector<SizedCause> list;
        std::vector<std::size_t> of;
        for (std::size_t f = 0; f < found_.size() && f < refined && found_[f].fit.gain > 0; ++f) {
            const std::map<double, double>& gain = found_[f].gain;
            const auto top = std::max_element(gain.begin(), gain.end(),
                                              [](const auto& a, const auto& b) { return a.second < b.second; });
            for (const auto other : {top == gain.begin() ? top : std::prev(top), std::next(top)})
                if (other != gain.end() && other != top) {
                    list.push_back({found_[f].fit.cause, (top->first + other->first) / 2});
                    of.push_back(f);
                }
        }
        if (list.empty())
            return true;
        if (!score(list))
            return false;
        for (std::size_t i = 0; i < list.size(); ++i)
            take(found_[of[i]], list[i].size, i, list.size());
        return true;
    }

    /// Scores of (judges x (baseline, then the list)).
    bool score(const std::vector<SizedCause>& list)
    {
        std::vector<ModelVariant> variants;
        for (std::size_t f = 0; f < judges_; ++f) {
            variants.push_back(windows_.variant(baselines_[f].study, nullptr));
            for (const SizedCause& cause : list)
                variants.push_back(windows_.variant(baselines_[f].study, &cause));
        }
        scores_ = windows_.scores(variants, true);
        return !scores_.empty();
    }

    /// What the k-th of the list gains, by the form that grants it least.
    void take(Found& f, double size, std::size_t k, std::size_t listed)
    {
        double least = std::numeric_limits<double>::infinity();
        std::size_t hardest = 0;
        std::vector<double> by_form;
        for (std::size_t j = 0; j < judges_; ++j) {
            const std::size_t at = j * (listed + 1);
            by_form.push_back(sum(scores_[at + 1 + k]) - sum(scores_[at]));
            if (by_form.back() < least) {
                least = by_form.back();
                hardest = at;
            }
        }
        f.gain[size] = least;
        if (least <= f.fit.gain)
            return;
        f.fit.gain = least;
        f.by_form = by_form;
        f.fit.gain_by_run.assign(runs_, 0);
        const std::vector<WindowPlace>& places = windows_.comparison().windows();
        for (std::size_t w = 0; w < places.size(); ++w)
            f.fit.gain_by_run[places[w].run] += scores_[hardest + 1 + k][w] - scores_[hardest][w];
    }

    Windows& windows_;
    std::size_t runs_;
    const std::vector<WindowBaseline>& baselines_;
    std::size_t judges_;
    std::vector<std::vector<double>> scores_; ///< of the last list
    std::vector<Found> found_;
};

} // namespace

std::vector<TriedCause> window_causes(const Specimen& specimen, const TrackScales& scales, double friction)
{
    const double height = scales.time_s * scales.time_s * specimen.gravity_m_s2, speed = height / scales.time_s;
    double weight = 0, width = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < specimen.mass_kg.size(); ++b) {
        weight += specimen.mass_kg[b] * specimen.gravity_m_s2;
        width = std::min(width, specimen.half_width_m[b]);
    }
    std::vector<TriedCause> tried;
    const auto of_joint = [](const char* mechanism, int joint, const char* parameter, const char* unit,
                             double neutral) {
        Cause cause{mechanism, joint < 0 ? "all" : fmt::format("joint {}", joint), parameter, unit, neutral};
        cause.joint = joint;
        return cause;
    };
    const int joints = static_cast<int>(specimen.joints.size());
    for (int j = 0; j < joints; ++j)
        tried.push_back({of_joint("joint_friction", j, "ratio", "", 1), {0.4, 0.55, 0.7, 0.85, 1.2}});
    for (const double part : {0.01, 0.04}) {
        Cause stribeck = of_joint("stribeck", -1, "dynamic_ratio", "", 1);
        stribeck.fixed = part * speed;
        tried.push_back({stribeck, {0.5, 0.7, 0.85}});
    }
    tried.push_back({of_joint("friction_wear", -1, "wear_per_m", "1/m", 0), {0.5 / height, 1.5 / height, 5 / height}});
    tried.push_back({of_joint("adhesion", -1, "force_n_m", "N/m", 0),
                     {0.1 * friction * weight / width, 0.3 * friction * weight / width}});
    for (int j = 0; j < joints; ++j) {
        Cause dowel = of_joint("dowel", j, "stiffness_n_m", "N/m", 0);
        dowel.fixed = 0.0025 * height;
        tried.push_back({dowel, {30 * weight / height, 300 * weight / height}});
    }
    return tried;
}

WindowEvidence window_evidence(const Campaign& campaign, const Study& start, const TrackScales& scales,
                               const std::vector<SizedCause>& given, bool judge_causes, const RunOptions& options,
                               Observer& observer)
{
    WindowEvidence out;
    const double length = std::max(shortest_window_s, window_part * scales.time_s);
    Windows windows(campaign, scales, length, given, options, observer);
    if (windows.empty()) {
        out.why_not =
            "No run has both a base motion and a history of the blocks that a simulation could be nudged towards.";
        out.complete = true;
        return out;
    }
    Windows few(of_first_repeats(campaign), scales, length, given, options, observer);
    ContactSearch contacts(few, start);
    if (!contacts.run())
        return out;
    out.baselines = contacts.baselines();
    if (judge_causes) {
        CauseSearch causes(windows, campaign, out.baselines);
        if (!causes.run(window_causes(campaign.specimen, scales, campaign.specimen.friction_nominal.value_or(0.7))))
            return out;
        causes.report(out);
    }
    for (const Windows* w : {&few, &windows}) {
        out.simulations += w->comparison().simulations();
        out.window_simulations += w->comparison().window_simulations();
        out.block_steps += w->comparison().block_steps();
    }
    out.complete = true;
    return out;
}

} // namespace stylobate
