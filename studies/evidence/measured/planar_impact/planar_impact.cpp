/// Page `planar_impact`: one impact of a rigid ellipse on a surface, the contact law against 1110 measured ones.

#include "io/files/atomic_file.hpp"
#include "studies/evidence/measured/parts/page_case.hpp"
#include "studies/evidence/measured/planar_impact/planar_impact_page.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace stylobate::measured {

namespace {

using namespace impact;

/// Every fitted law's prediction for the impacts of a table.
void predict_table(const ImpactStudy& study, const std::filesystem::path& table, const std::filesystem::path& out)
{
    const std::vector<Impact> impacts = read_impacts(table);
    std::vector<Arms> published;
    for (const Impact& i : impacts)
        published.push_back({i.arm_n, i.arm_t});
    const JudgedLaw& pair = study.laws[ImpactStudy::newton];
    std::vector<Prediction> predictions{
        {pair.word, predict_rigid(study.body, Restitution::total_impulse, {pair.parameters[0], pair.parameters[1]},
                                  impacts, published)}};
    for (const std::size_t which : {ImpactStudy::constant, ImpactStudy::extended})
        predictions.push_back(
            {study.laws[which].word, predict(study.body, study.models[which], study.laws[which].parameters, impacts)});
    write_predictions(out, impacts, predictions);
}

} // namespace

void planar_impact(const PagePlace& place)
{
    const std::filesystem::path table = place.data / "planar_impact" / "impacts.csv";
    const ImpactStudy study = study_impacts(read_impacts(table), [&](const std::string& done) {
        if (!place.quiet)
            fmt::print(stderr, "planar_impact: {}\n", done);
    });
    draw(study, place.images());
    if (!place.predict.empty())
        predict_table(study, place.predict, place.docs / "planar_impact_predictions.csv");
    write_whole(place.docs / "planar_impact.md", page_text(study, fmt::format("Version {}.", code_version())));
}

} // namespace stylobate::measured
