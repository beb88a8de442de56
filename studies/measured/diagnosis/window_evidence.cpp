#include "studies/measured/diagnosis/window_evidence.hpp"

#include "ensemble/tracking/specimen.hpp"
#include "io/keys/words.hpp"

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

} // namespace stylobate
