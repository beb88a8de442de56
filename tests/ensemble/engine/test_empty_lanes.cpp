/// Empty lanes must not slow the realizations beside them: whatever a step does only where a realization asks for it,
/// none of them asks for.

#include "bench/counted.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "kernels/planar/mechanisms/points.hpp"
#include "kernels/planar/mechanisms/two_corner.hpp"
#include "kernels/planar/overlap.hpp"
#include "kernels/planar/rigid/rigid_step.hpp"
#include "kernels/planar/scratch.hpp"
#include "kernels/planar/step.hpp"
#include "studies/workflow/bench/scenes.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace stylobate {

namespace {

/// Steps as the models of `run` in `instances/instantiate.hpp` do.
struct Here {};

template <ContactForm form>
void run_form(const Topology& topology, const Bundle& bundle)
{
    if constexpr (form == ContactForm::rigid)
        run_rigid<Counted, Here>(topology, bundle, 0, chunk_steps);
    else if (topology.model.mechanisms)
        run_steps<Counted, Mechanisms<form>>(topology, bundle, 0, chunk_steps);
    else
        run_steps<Counted, Plain<form>>(topology, bundle, 0, chunk_steps);
}

/// An empty lane of a study is stepped for two chunks. @param used whether there was a realization in it before
void expect_nothing_asked(const Study& study, bool mechanisms, bool used)
{
    static Topology topology;
    static Bundle bundle;
    KernelTable table = kernels(Isa::scalar);
    table.planar.run = [](const Topology& t, const Bundle& b, int first, int last) {
        topology = t;
        bundle = b;
        kernels(Isa::scalar).planar.run(t, b, first, last);
    };
    const Sampler sampler(study, nullptr);
    Realization r = sampler.realization(0);
    r.with_mechanisms = mechanisms;
    LaneSet lanes(study, nullptr, table, r);
    if (used)
        lanes.load(0, r);
    lanes.advance();
    lanes.advance();
    lanes.clear(0);
    counted = {};
    for (int chunk = 0; chunk < 2; ++chunk)
        switch (topology.model.form) {
        case ContactForm::area:
            run_form<ContactForm::area>(topology, bundle);
            break;
        case ContactForm::two_corner:
            run_form<ContactForm::two_corner>(topology, bundle);
            break;
        case ContactForm::points:
            run_form<ContactForm::points>(topology, bundle);
            break;
        case ContactForm::rigid:
            run_form<ContactForm::rigid>(topology, bundle);
            break;
        }
    EXPECT_EQ(counted.meant, 0);
    EXPECT_EQ(counted.subnormal, 0); // which some processors are slow with
}

TEST(EmptyLanes, AskForNothingInAnyModelAndStructure)
{
    for (const ContactForm form :
         {ContactForm::area, ContactForm::two_corner, ContactForm::points, ContactForm::rigid}) {
        std::vector<Study> studies{formed_column(form)};
        if (form != ContactForm::rigid)
            studies.insert(studies.end(), {watched_column(4), shaken_colonnade(2, 2, 4), shaken_colonnade(4, 4, 12)});
        for (Study& study : studies) {
            study.contact.form = form;
            if (form == ContactForm::rigid) { // has neither
                study.contact.normal_stiffness_n_m2 = study.contact.tangential_stiffness_n_m = 0;
            }
            for (const bool mechanisms : {false, true})
                for (const bool used : {false, true}) {
                    if (mechanisms && form == ContactForm::rigid)
                        continue;
                    SCOPED_TRACE(static_cast<int>(form));
                    SCOPED_TRACE(study.structure.columns.size());
                    SCOPED_TRACE(mechanisms ? "mechanisms" : "plain");
                    expect_nothing_asked(study, mechanisms, used);
                }
        }
    }
}

TEST(EmptyLanes, NeedNoGeneralOverlapInAnyContactForm)
{
    constexpr double b = PlanarModel::empty_half_width, limit = PlanarModel::empty_depth_limit;
    const Placement<double> at_rest{0, 0, 0, 1}; // all of an empty lane is 0
    bool fits = false;
    EXPECT_LT(stacked_overlap(at_rest, b, b, limit, fits).area, 0.1 * detail::least_area); // below it nothing touches
    EXPECT_TRUE(fits);
    FormPoints<double, 2> corners;
    EXPECT_EQ(two_corner_overlap(at_rest, b, b, limit, corners, fits).area, 0);
    EXPECT_TRUE(fits);
    FormPoints<double, 5> points;
    EXPECT_EQ(points_overlap(at_rest, b, b, limit, 0.0, points, fits).area, 0);
    EXPECT_TRUE(fits);
    // blocks of no size do
    stacked_overlap(at_rest, 0.0, 0.0, 0.0, fits);
    EXPECT_FALSE(fits);
}

} // namespace
} // namespace stylobate
