#include "io/files/hdf5_scales.hpp"
#include "io/files/toml_key.hpp"
#include "io/store/result_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace stylobate {

namespace {

namespace names = result_names;

/// What is known of a data set. Its dimensions are names of scales, separated by spaces.
struct Label {
    std::string dimensions;
    std::string long_name;
};

/// By path; '*' is any one name. Inputs and intervals (NAME_lower, NAME_upper) follow rules below.
// long: a line for each data set
std::map<std::string, Label> all_labels(int dimensions)
{
    std::map<std::string, Label> labels = {
        {"realizations/chunk_checksum", {"chunk_checksum", "checksum of each 256 rows"}},
        {"realizations/outcome/block", {"block", "block"}},
        {"realizations/outcome/bed", {"bed", "joint"}},
        {"surface/method",
         {"frequency_hz pga_m_s2", "source of the interval: 0 own trials, 1 pooled with the neighbours"}},
        {"tally/limit_state", {"limit_state", "limit state"}},
        {"tally/block", {"block", "block"}},
        {"tally/collapse_time/time_s", {"time_s", "time of the collapse"}},
        {"tally/collapse_time/count", {"time_s", "realizations with this time"}},
        {"tally/total_collapse_time/time_s", {"time_s", "time at which all columns and epistyles had fallen"}},
        {"tally/total_collapse_time/count", {"time_s", "realizations with this time"}},
        {"tally/invalid_index", {"invalid_index", "index of an invalid realization"}},
        {"tally/invalid_reason", {"invalid_index", "why it was set aside: 0 none, 1 not finite, 2 energy"}},
        {"tally/done", {"part bound", "realizations that are counted, by their place in the order of the run"}},
        {"tally/part", {"part", "part of the order of the run"}},
        {"tally/bound", {"bound", "begin, end, reached the first limit state, invalid"}},
        {"twins/original", {"original", "index of the original"}},
        {"twins/kind", {"original", "kind of the replica"}},
        {"twins/start", {"original", "separation at rest, in widths and radians"}},
        {"twins/exponent_per_s", {"original", "growth rate of the logarithm of the separation"}},
        {"twins/horizon_s", {"original", "time at which the separation reached the tolerance"}},
        {"twins/followed_s", {"original", "end of the following"}},
        {"twins/original_end_s", {"original", "end of the original"}},
        {"survival/trials", {"past frequency_hz pga_m_s2", "valid realizations"}},
        {"survival/standing", {"past frequency_hz pga_m_s2", "realizations that stand"}},
        {"survival/agreeing", {"past frequency_hz pga_m_s2", "realizations that agree with the observed state"}},
        {"survival/likelihood", {"past frequency_hz pga_m_s2", "share of the realizations that agree"}},
        {"survival/posterior", {"past frequency_hz pga_m_s2", "posterior probability"}},
        {"survival/events_likelihood", {"past pga_m_s2", "likelihood, mean over the frequencies"}},
        {"survival/events_top_ratio", {"past", "likelihood at the end of the axis over the largest one"}},
        {"survival/events_excluded_by_likelihood_m_s2",
         {"past", "PGA above which shaking is excluded, by the likelihood"}},
        {"survival/events_excluded_by_posterior_m_s2", {"past", "PGA above which shaking is excluded, with the prior"}},
        {"survival/events_excluded_below_m_s2", {"past", "PGA below which shaking is excluded as too weak"}},
        {"survival/events_probability", {"past", "posterior probability of the number of events"}},
        {"survival/frequency_likelihood", {"frequency_hz pga_m_s2", "likelihood of one event"}},
        {"survival/frequency_top_ratio", {"frequency_hz", "likelihood at the end of the axis over the largest one"}},
        {"survival/frequency_excluded_by_likelihood_m_s2",
         {"frequency_hz", "PGA above which one event is excluded, by the likelihood"}},
        {"survival/frequency_excluded_by_posterior_m_s2",
         {"frequency_hz", "PGA above which one event is excluded, with the prior"}},
        {"survival/frequency_excluded_below_m_s2",
         {"frequency_hz", "PGA below which one event is excluded as too weak"}},
        {"survival/frequency_probability", {"frequency_hz", "posterior probability of the frequency"}},
        {"survival/monument_pga_place", {"monument", "posterior probability of a PGA below the true one"}},
        {"survival/monument_frequency_place", {"monument", "posterior probability of a frequency below the true one"}},
        {"survival/monument_events_place", {"monument", "posterior probability of fewer events than the true number"}},
        {"motions/motion", {"motion", "ground motion"}},
        {"motions/measure", {"measure", "intensity measure, with its unit"}},
        {"motions/shaking", {"shaking", "shaking of a sequence"}},
        {"motions/value", {"motion measure", "intensity of the motion as it stands, in the unit of the measure"}},
        {"motions/exponent", {"measure", "power of the scale factor by which the measure grows"}},
        {"motions/shaking_end_s", {"motion shaking", "end of each shaking of a sequence"}},
        {"fragility/motion", {"motion", "number of the realization's motion in /motions"}},
        {"fragility/intensity", {"motion", "intensity of the realization's shaking"}},
        {"fragility/states", {"states", "limit state"}},
        {"fragility/meanings", {"states", "when the limit state is reached"}},
        {"fragility/trials", {"states", "valid realizations"}},
        {"fragility/reached", {"states", "realizations that reached the limit state"}},
        {"fragility/median", {"states", "median of the fragility curve"}},
        {"fragility/dispersion", {"states", "dispersion of the fragility curve"}},
        {"fragility/grid", {"grid", "intensity at which the curves are given"}},
        {"fragility/curve", {"states grid", "probability of reaching the limit state"}},
        {"fragility/stripe", {"stripe", "intensity of the stripe"}},
        {"fragility/share", {"states stripe", "share of the realizations of a stripe that reached the limit state"}},
        {"sensitivity/outcomes", {"outcomes", "outcome"}},
        {"sensitivity/units", {"outcomes", "unit of the outcome"}},
        {"sensitivity/meanings", {"outcomes", "how the outcome is counted"}},
        {"sensitivity/factors", {"factors", "perturbed quantity"}},
        {"sensitivity/indices", {"indices", "index of sensitivity"}},
        {"sensitivity/acts", {"factors", "1 if the factor ever changed an outcome"}},
        {"sensitivity/mean", {"outcomes", "mean of the outcome, in the unit of `units`"}},
        {"sensitivity/explained", {"outcomes", "share of the variance that the factors explain"}},
        {"sensitivity/first", {"outcomes factors", "Sobol's first index of the mean over the rest"}},
        {"sensitivity/total", {"outcomes factors", "Sobol's total index of the mean over the rest"}},
        {"sensitivity/value_first", {"outcomes factors", "Sobol's first index of single outcomes"}},
        {"sensitivity/value_total", {"outcomes factors", "Sobol's total index of single outcomes"}},
        {"sensitivity/mu_star",
         {"outcomes factors", "mean of the absolute elementary effects, in the unit of `units`"}},
        {"sensitivity/rms", {"outcomes factors", "root mean square of the elementary effects, in the unit of `units`"}},
        {"sensitivity/mu", {"outcomes factors", "mean of the elementary effects, in the unit of `units`"}},
        {"sensitivity/sigma",
         {"outcomes factors", "standard deviation of the elementary effects, in the unit of `units`"}},
        {"rare/repeats", {"repeats", "estimate of the probability of each repeat"}},
        {"rare/level", {"level", "level of the subset simulation"}},
        {"rare/threshold_m", {"repeats level", "lower bound of the peak displacement of the samples of a level"}},
        {"rare/share", {"repeats level", "share of the samples above the next threshold, or collapsed"}},
        {"rare/acceptance", {"repeats level", "share of accepted candidates"}},
        {"rare/stuck", {"repeats level", "share of the chains that never moved"}},
        {"trajectories/*/block", {"block", "block"}},
        {"trajectories/*/role", {"block", "role of the block: 0 drum, 1 epistyle, 2 ground"}},
        {"trajectories/*/column", {"block", "column of a drum, from the left; -1 of all others"}},
    };
    visit_numbers(
        dimensions,
        [&](const std::string& group, const char* name, const FieldFacts& facts, auto) {
            labels["realizations/" + group + name] = {"index", facts.says};
        },
        ResultRow());
    visit_lists(std::type_identity<Outcome>(),
                [&](const std::string& name, auto, const std::string& of, const FieldFacts& facts) {
                    labels["realizations/outcome/" + name] = {"index " + of, facts.says};
                });
    const Trajectory of_model(trajectory_channels(dimensions));
    visit_lists(of_model, [&](const TrajectoryChannel& channel, const auto&) {
        labels[std::string("trajectories/*/") + channel.name] = {channel.of == ListOf::times    ? "time_s"
                                                                 : channel.of == ListOf::blocks ? "block"
                                                                                                : "time_s block",
                                                                 channel.meaning};
    });
    const std::string cells = "frequency_hz pga_m_s2";
    for (const std::string group : {"surface/", "tally/", "survival/"}) {
        for (const RowQuantity& rows : {frequency_rows, direction_rows})
            labels[group + rows.key] = {rows.key, rows.meaning};
        labels[group + "pga_m_s2"] = {"pga_m_s2", "peak ground acceleration"};
    }
    visit_fields(std::type_identity<SurfaceTable>(), [&](const std::string& name, auto, const FieldFacts& facts) {
        labels["surface/" + name] = {cells, facts.says};
    });
    visit_fields(std::type_identity<Tally>(),
                 [&](const std::string& name, auto, const std::string& by, const FieldFacts& facts) {
                     labels["tally/" + name] = {cells + ' ' + by, facts.says};
                 });
    return labels;
}

/// Where the values of a scale are that the file has as an attribute of the group.
constexpr std::pair<const char*, const char*> kept_as_attribute[] = {{"block", names::blocks},
                                                                     {"bed", names::beds},
                                                                     {"limit_state", names::limit_states},
                                                                     {"motion", names::motion_names},
                                                                     {"measure", names::measure_names}};

std::string group_of(const std::string& path)
{
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? std::string() : path.substr(0, slash);
}

/// The path as it is in `labels`.
std::string as_listed(const std::string& path)
{
    const std::string in = std::string(names::trajectories) + "/";
    const std::size_t slash = path.find('/', in.size());
    return path.starts_with(in) && slash != std::string::npos ? in + "*" + path.substr(slash) : path;
}

/// @param dimensions of the structure, 2 or 3   @param rank how many dimensions the data set has
std::optional<Label> label_of(int dimensions, const std::string& path, std::size_t rank)
{
    static const std::map<std::string, Label> planar = all_labels(2), spatial = all_labels(3);
    const std::map<std::string, Label>& labels = dimensions == 3 ? spatial : planar;
    const std::string listed = as_listed(path), inputs = std::string(names::input) + "/";
    if (path.starts_with(inputs)) {
        const std::string name = path.substr(inputs.size());
        std::string words = name;
        std::ranges::replace(words, '_', ' ');
        return Label{rank == 2 ? "index " + name + "_of" : "index", "drawn " + words};
    }
    if (const auto found = labels.find(listed); found != labels.end())
        return found->second;
    for (const std::string end : {"lower", "upper"})
        if (listed.ends_with("_" + end))
            if (auto of = label_of(dimensions, path.substr(0, path.size() - end.size() - 1), rank)) {
                of->long_name = end + " end of the interval: " + of->long_name;
                return of;
            }
    return std::nullopt;
}

class Labels {
public:
    explicit Labels(hid_t file)
        : file_(file), dimensions_(hdf5::has_attribute(file, names::dimensions)
                                       ? static_cast<int>(hdf5::read_number(file, names::dimensions))
                                       : 2)
    {
        find("");
    }

    void write()
    {
        for (const std::string& path : std::set<std::string>(datasets_))
            write(path);
        scales_.write(file_);
    }

private:
    /// All data sets of a group and of those below it.
    void find(const std::string& group)
    {
        const hdf5::Handle opened = hdf5::open_group(file_, "/" + group);
        for (const std::string& name : hdf5::names_in(opened.id())) {
            const std::string path = group.empty() ? name : group + "/" + name;
            const hdf5::Handle object = hdf5::open_object(file_, path);
            if (H5Iget_type(object.id()) == H5I_GROUP)
                find(path);
            else
                datasets_.insert(path);
        }
    }

    void write(const std::string& path)
    {
        const hdf5::Dims dims = hdf5::dims_of(file_, path);
        const std::optional<Label> label = label_of(dimensions_, path, dims.size());
        if (!label)
            return;
        std::istringstream words(label->dimensions);
        std::vector<std::string> dimensions{std::istream_iterator<std::string>(words), {}};
        if (datasets_.contains(std::string(names::surface) + "/" + direction_rows.key))
            std::ranges::replace(dimensions, frequency_rows.key, direction_rows.key);
        if (dimensions.size() != dims.size())
            return;
        const hdf5::Handle object = hdf5::open_object(file_, path);
        hdf5::write_text(object.id(), "long_name", label->long_name);
        if (const auto unit = unit_of(path, object.id()))
            hdf5::write_text(object.id(), "units", *unit);
        std::vector<std::string> scales;
        for (std::size_t i = 0; i < dims.size(); ++i)
            scales.push_back(scale(path, dimensions[i], dims[i]));
        scales_.attach(path, scales);
    }

    /// Nullopt for texts, and for numbers whose unit differs from one to the next.
    std::optional<std::string> unit_of(const std::string& path, hid_t object) const
    {
        const hdf5::Handle type(H5Dget_type(object), H5Tclose);
        if (H5Tget_class(type.id()) == H5T_STRING)
            return std::nullopt;
        if (hdf5::has_attribute(object, "unit"))
            return hdf5::read_text(object, "unit");
        const std::string listed = as_listed(path);
        const auto is = [&](std::initializer_list<std::string_view> these) {
            return std::ranges::any_of(these, [&](std::string_view each) {
                return listed == each || (listed.starts_with(each) && (listed.substr(each.size()) == "_lower" ||
                                                                       listed.substr(each.size()) == "_upper"));
            });
        };
        if (is({"motions/value", "sensitivity/mean", "sensitivity/mu_star", "sensitivity/rms", "sensitivity/mu",
                "sensitivity/sigma"}))
            return std::nullopt;
        if (is({"fragility/intensity", "fragility/median", "fragility/grid", "fragility/stripe"})) {
            const hdf5::Handle group = hdf5::open_group(file_, "fragility");
            if (auto unit = unit_in_name(hdf5::read_text(group.id(), "measure")))
                return unit;
        }
        return "1";
    }

    /// The path of a dimension's scale: in the group of the data set or in one above it; else it is made in the group.
    std::string scale(const std::string& dataset, const std::string& name, hsize_t length)
    {
        for (std::string group = group_of(dataset); !group.empty(); group = group_of(group))
            if (const std::string path = group + "/" + name; datasets_.contains(path))
                return path;
        const std::string path = group_of(dataset) + "/" + name;
        std::vector<std::string> texts = texts_of(dataset, name, length);
        if (texts.size() != length)
            throw hdf5::Error("'" + dataset + "' does not have a name for each " + name);
        hdf5::write_texts(file_, path, texts);
        datasets_.insert(path);
        const hdf5::Handle made = hdf5::open_object(file_, path);
        const auto label = label_of(dimensions_, path, 1);
        hdf5::write_text(made.id(), "long_name", label ? label->long_name : name);
        scales_.attach(path, {path});
        return path;
    }

    std::vector<std::string> texts_of(const std::string& dataset, const std::string& name, hsize_t length) const
    {
        const hdf5::Handle group = hdf5::open_group(file_, group_of(dataset));
        for (const auto& [scale, attribute] : kept_as_attribute)
            if (name == scale && hdf5::has_attribute(group.id(), attribute))
                return split_names(hdf5::read_text(group.id(), attribute));
        if (name == "bound")
            return {"begin", "end", "reached", "invalid"};
        const bool is_input = dataset.starts_with(names::input);
        const std::string of = is_input ? dataset.substr(dataset.rfind('/') + 1) : name;
        std::vector<std::string> texts;
        for (hsize_t i = 0; i < length; ++i)
            texts.push_back(is_input ? fmt::format("{}[{}]", of, i) : fmt::format("{} {}", of, i + 1));
        return texts;
    }

    hid_t file_;
    int dimensions_; ///< of the structure
    std::set<std::string> datasets_;
    hdf5::DimensionScales scales_;
};

} // namespace

void write_labels(hid_t file)
{
    Labels(file).write();
}

} // namespace stylobate
