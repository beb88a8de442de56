#include "studies/diagnosis/decision/window_evidence.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/tracking/specimen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace stylobate {

namespace {

// Free windows: long enough that a slip shows, short enough that an impact that went the other way does not rule.
constexpr double window_part = 0.5; // of the specimen's time scale
constexpr double shortest_window_s = 0.2;
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
    Windows(const Campaign& campaign, double length_s, const std::vector<SizedCause>& given, const RunOptions& options,
            Observer& observer)
        : built_(build_specimen(campaign.specimen)), comparison_(campaign, {length_s, {}, {}}), given_(given),
          options_(options), observer_(observer)
    {
    }

    bool empty() const { return comparison_.windows().empty(); }
    const WindowComparison& comparison() const { return comparison_; }

    ModelVariant variant(const Study& study) const
    {
        ModelVariant v;
        v.study = study;
        v.change = [this](Realization& r, std::size_t) {
            for (const SizedCause& cause : given_)
                apply_cause(cause, built_, r);
        };
        return v;
    }

    /// (variants x windows) log scores, each by its own scales; empty if stopped.
    std::vector<std::vector<double>> scores(const std::vector<ModelVariant>& variants)
    {
        std::vector<std::vector<double>> out;
        const std::vector<WindowResiduals> residuals = comparison_.residuals(variants, options_, observer_);
        for (const WindowResiduals& z : residuals)
            out.push_back(comparison_.scores(z, comparison_.fit_scales(z)));
        return out;
    }

private:
    SpecimenStructure built_;
    WindowComparison comparison_;
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
            variants.push_back(windows_.variant(study_of(c)));
        const std::vector<std::vector<double>> scores = windows_.scores(variants);
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

} // namespace

WindowEvidence window_evidence(const Campaign& campaign, const Study& start, const TrackScales& scales,
                               const std::vector<SizedCause>& given, const RunOptions& options, Observer& observer)
{
    WindowEvidence out;
    const double length = std::max(shortest_window_s, window_part * scales.time_s);
    Windows few(of_first_repeats(campaign), length, given, options, observer);
    if (few.empty()) {
        out.why_not =
            "No run has both a base motion and a history of the blocks that a simulation could be nudged towards.";
        out.complete = true;
        return out;
    }
    ContactSearch contacts(few, start);
    if (!contacts.run())
        return out;
    out.baselines = contacts.baselines();
    out.cost = few.comparison().cost();
    out.complete = true;
    return out;
}

} // namespace stylobate
