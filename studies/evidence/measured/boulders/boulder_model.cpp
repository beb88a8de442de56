#include "studies/evidence/measured/boulders/boulder_model.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/planar/planar_model.hpp"
#include "ensemble/sampling/sampler.hpp"
#include "io/files/hdf5.hpp"
#include "io/study/study_file.hpp"
#include "studies/evidence/measured/parts/table.hpp"
#include "studies/evidence/verification/trials.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

namespace stylobate::measured {

namespace {

constexpr double spacing_s = 0.005;
constexpr double gravity_m_s2 = 9.80665; // the unit "g" of the file
constexpr double stored_unit_g = 1e-4;

const std::array<std::string, boulders> prefixes{"num_sp1_", "num_sp2_"};

std::vector<double> read_acceleration(const hdf5::Handle& file, const std::string& path)
{
    const hdf5::Dims dims = hdf5::dims_of(file.id(), path);
    if (dims.size() != 1)
        throw hdf5::Error("'" + path + "' is no list");
    const hdf5::Handle dataset = hdf5::open_dataset(file.id(), path, H5T_STD_I16LE, dims);
    std::vector<double> values(dims[0]);
    if (H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
        throw hdf5::Error("cannot read '" + path + "'");
    for (double& value : values)
        value *= stored_unit_g * gravity_m_s2;
    return values;
}

Motion strong_motion(const std::vector<double>& acceleration, const std::string& source)
{
    const auto [first, last] = strong_part(acceleration, spacing_s, still_below_m_s2);
    if (first == last)
        return {};
    Motion motion = motion_of({acceleration.begin() + static_cast<std::ptrdiff_t>(first),
                               acceleration.begin() + static_cast<std::ptrdiff_t>(last)},
                              spacing_s);
    motion.source = source;
    motion.predominant_frequency_hz = 1; // nothing stretches it
    return motion;
}

std::string whole_file(const std::filesystem::path& file)
{
    const gzFile in = gzopen(file.c_str(), "rb");
    if (in == nullptr)
        throw InputError(file.string(), 0, "cannot be read");
    std::string text;
    std::array<char, 1 << 16> buffer;
    int got = 0;
    while ((got = gzread(in, buffer.data(), static_cast<unsigned>(buffer.size()))) > 0)
        text.append(buffer.data(), static_cast<std::size_t>(got));
    gzclose(in);
    if (got < 0)
        throw InputError(file.string(), 0, "cannot be decompressed");
    return text;
}

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::array<double, 3> cross(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

} // namespace

std::pair<std::size_t, std::size_t> strong_part(const std::vector<double>& a, double dt_s, double level_m_s2)
{
    const auto strong = [&](double value) { return std::fabs(value) > level_m_s2; };
    const auto first = std::find_if(a.begin(), a.end(), strong);
    if (first == a.end())
        return {0, 0};
    const auto last = std::find_if(a.rbegin(), a.rend(), strong).base();
    const auto margin = static_cast<std::ptrdiff_t>(std::lround(0.5 / dt_s));
    return {static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, first - a.begin() - margin)),
            std::min(a.size(), static_cast<std::size_t>(last - a.begin() + margin))};
}

BoulderData read_boulders(const std::filesystem::path& folder)
{
    const std::filesystem::path motions = folder / "table_motion_200Hz.h5";
    const Table table(folder / "tests.csv");
    BoulderData data;
    std::array<std::vector<std::string>, boulders> columns;
    for (const auto& [specimen, names] :
         {std::pair{std::size_t(0), std::vector<std::string>{"KN1_KS1", "KN3_KS1", "KN5_KS1", "KN10_KS1", "KN15_KS1"}},
          std::pair{std::size_t(1), std::vector<std::string>{"KN3_KS1", "KN5_KS1", "KN5_KS2", "KN10_KS1", "KN15_KS1",
                                                             "KN15_KS2", "KN15_p50", "KN20_KS1"}}})
        data.published[specimen] = names;
    try {
        const hdf5::Handle file = hdf5::open_file(motions, false);
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (!table.flag(row, "motion_available")) {
                ++data.without_motion;
                continue;
            }
            BoulderTest test;
            test.number = static_cast<int>(table.number(row, "test"));
            test.ground_motion = table.text(row, "ground_motion");
            test.pga_g = table.number(row, "pga_g_published");
            test.pgv_over_pga_s = table.number(row, "pgv_over_pga_s_published");
            test.fell = {table.flag(row, "overturned_sp1"), table.flag(row, "overturned_sp2")};
            for (std::size_t s = 0; s < boulders; ++s)
                for (const std::string& name : data.published[s])
                    test.predicted[s].push_back(table.flag(row, prefixes[s] + name));
            const std::string path = fmt::format("{:03}/acc", test.number);
            test.motion = strong_motion(read_acceleration(file, path), fmt::format("test {}", test.number));
            data.tests.push_back(std::move(test));
        }
    } catch (const hdf5::Error& error) {
        throw InputError(motions.string(), 0, error.what());
    }
    return data;
}

Mesh read_obj(const std::filesystem::path& file)
{
    Mesh mesh;
    std::istringstream text(whole_file(file));
    std::string line;
    for (long number = 1; std::getline(text, line); ++number) {
        std::istringstream words(line);
        std::string key;
        words >> key;
        if (key == "v") {
            std::array<double, 3> v{};
            if (!(words >> v[0] >> v[1] >> v[2]))
                throw InputError(file.string(), number, "a vertex needs three numbers");
            mesh.vertices.push_back(v);
        } else if (key == "f") {
            std::array<std::size_t, 3> t{};
            for (std::size_t& corner : t) {
                std::string word;
                long index = 0;
                if (words >> word)
                    index = std::atol(word.c_str()); // "7", "7/1" or "7//2": the vertex comes first
                if (index < 1 || static_cast<std::size_t>(index) > mesh.vertices.size())
                    throw InputError(file.string(), number, "a face needs three of the vertices before it");
                corner = static_cast<std::size_t>(index - 1);
            }
            mesh.triangles.push_back(t);
        }
    }
    if (mesh.triangles.size() < 4)
        throw InputError(file.string(), 0, "has fewer than four faces; a closed surface is needed");
    return mesh;
}

MeshBody body_of(const Mesh& mesh)
{
    MeshBody body;
    double six_volumes = 0;
    std::array<double, 3> moment{};
    for (const auto& t : mesh.triangles) {
        const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        const double v = dot(a, cross(b, c));
        six_volumes += v;
        for (std::size_t k = 0; k < 3; ++k)
            moment[k] += v * (a[k] + b[k] + c[k]) / 4;
    }
    body.volume_m3 = std::fabs(six_volumes) / 6;
    for (std::size_t k = 0; k < 3; ++k) {
        body.centroid_m[k] = moment[k] / six_volumes;
        const auto [low, high] = std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                                                     [k](const auto& p, const auto& q) { return p[k] < q[k]; });
        body.extent_m[k] = (*high)[k] - (*low)[k];
    }
    return body;
}

double Stance::effective_slenderness() const
{
    return std::tan(std::acos(1 / (1 + barrier)));
}

std::vector<Stance> stances(const Mesh& mesh, int directions)
{
    constexpr double degree = std::numbers::pi / 180;
    const std::array<double, 3> centre = body_of(mesh).centroid_m;
    std::vector<Stance> all;
    for (int d = 0; d < directions; ++d) {
        Stance s;
        s.azimuth_rad = 2 * std::numbers::pi * d / directions;
        const double ca = std::cos(s.azimuth_rad), sa = std::sin(s.azimuth_rad);
        double rest = 0, highest = 0;
        for (double lean = 0; lean <= 80 * degree; lean += 0.25 * degree) {
            // height of the centre over the lowest point, and how far that lies ahead
            double height = -1e300, ahead = 0;
            for (const auto& v : mesh.vertices) {
                const double u = (v[0] - centre[0]) * ca + (v[1] - centre[1]) * sa, z = v[2] - centre[2];
                const double below = u * std::sin(lean) - z * std::cos(lean);
                if (below > height) {
                    height = below;
                    ahead = u * std::cos(lean) + z * std::sin(lean);
                }
            }
            if (lean == 0)
                rest = highest = height;
            if (std::fabs(lean - degree) < 0.1 * degree)
                s.start_slenderness = ahead / height;
            if (height > highest) {
                highest = height;
                s.balance_rad = lean;
            }
        }
        s.barrier = highest / rest - 1;
        all.push_back(s);
    }
    return all;
}

namespace {

constexpr double gravity = 9.81;

std::vector<bool> fell(const std::vector<BoulderTest>& tests, std::size_t boulder)
{
    std::vector<bool> falls;
    for (const BoulderTest& test : tests)
        falls.push_back(test.fell[boulder]);
    return falls;
}

} // namespace

double BoulderModel::rocking_rate_rad_s() const
{
    return std::sqrt(0.75 * gravity / (0.5 * height_m * std::hypot(1, slenderness)));
}

Study boulder_study(const BoulderModel& model, std::uint64_t realizations)
{
    Study study;
    const double width = model.slenderness * model.height_m;
    study.realizations = realizations;
    study.structure = equal_column(1, 0, width, model.height_m, boulder_depth_m, boulder_mass_kg);
    study.contact.normal_stiffness_n_m2 = model.normal_stiffness_n_m2;
    study.contact.tangential_stiffness_n_m = model.normal_stiffness_n_m2 * width;
    study.contact.normal_damping_ratio = model.damping_ratio;
    study.contact.tangential_damping_ratio = model.damping_ratio;
    study.contact.damping = model.ends ? DampingAt::ends : DampingAt::centroid;
    study.contact.friction = boulder_friction;
    study.excitation.kind = ExcitationKind::table;
    study.excitation.file = "motion.csv"; // what --set excitation.file replaces
    if (model.eccentricity_m != 0) {
        MechanismSpec eccentricity = neutral_spec(Mechanism::eccentricity, boulder_friction);
        eccentricity.values[0] = model.eccentricity_m;
        study.mechanisms.push_back(eccentricity);
    }
    if (model.slenderness_spread > 0) {
        Perturbation width_spread;
        width_spread.quantity = Quantity::drum_width;
        width_spread.distribution = DistributionKind::lognormal;
        width_spread.sigma_ln = model.slenderness_spread;
        study.perturbations.push_back(width_spread);
    }
    // beyond balance, but well before its side hits the ground
    study.outcome.collapse_height_fraction = 0.85;
    study.text = study_text(study);
    return study;
}

Ends ensemble_ends(const Study& study, const Motion& motion, const RunOptions& run)
{
    Ends ends;
    if (motion.empty())
        return ends;
    const Experiment experiment(study, {.record = motion});
    RunPlan plan;
    plan.total = study.total();
    plan.sink = [&](const Realization&, const Outcome& outcome) { ends.add(outcome); };
    Observer nobody;
    run_ensemble(experiment, run, plan, nobody);
    if (ends.set_aside == ends.total)
        throw InputError(fmt::format("{}: every realization is invalid", motion.source));
    return ends;
}

double restitution(const BoulderModel& model)
{
    Study study = boulder_study(model);
    study.excitation = {};
    study.excitation.kind = ExcitationKind::none;
    study.excitation.duration_s = 20 / model.rocking_rate_rad_s();
    study.initial.tilt_rad = 0.5 * std::atan(model.slenderness);
    return verification::impact_restitution(Sampler(study, nullptr).realization(0), study.contact, 0);
}

BoulderTable simulate(const BoulderModel& variant, const std::vector<BoulderTest>& tests, const RunOptions& run)
{
    const auto study = [&](double slenderness) {
        BoulderModel model = variant;
        model.slenderness = slenderness;
        return boulder_study(model);
    };
    const auto motion = [&](std::size_t i) { return tests[i].motion; };
    return {variant, simulated_falls(equal_ratios(0.1, 0.45, 24), tests.size(), motion, study, run)};
}

BoulderFit best_fit(const std::vector<BoulderTable>& tables, const std::vector<BoulderTest>& tests,
                    const std::vector<bool>& use, const std::vector<double>& spreads)
{
    BoulderFit best;
    best.log_likelihood = -std::numeric_limits<double>::infinity();
    for (const BoulderTable& table : tables)
        for (const double spread : spreads)
            for (const double slip : slips) {
                BoulderFit now;
                now.slip = slip;
                for (std::size_t s = 0; s < boulders; ++s) {
                    const LikelySlenderness likely = likely_slenderness(table.falls, fell(tests, s), use, spread, slip);
                    now.model[s] = table.variant;
                    now.model[s].slenderness = table.falls.slenderness[likely.median];
                    now.model[s].slenderness_spread = spread;
                    now.log_likelihood += likely.log_likelihood;
                }
                if (now.log_likelihood > best.log_likelihood)
                    best = now;
            }
    return best;
}

} // namespace stylobate::measured
