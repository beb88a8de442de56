/// Measured campaigns. An input that begins with `h` is a recipe of changes of an HDF5 file; any other is a folder of
/// CSV files: lines `@NAME`, each with the content of that file behind it.

#include "io/measured/campaign_writer.hpp"
#include "io/measured/measured_check.hpp"
#include "io/measured/measured_file.hpp"
#include "io/measured/measured_layout.hpp"
#include "tests/fuzz/hdf5_edits.hpp"
#include "tests/fuzz/text_mutation.hpp"
#include "tests/io/measured/measured_samples.hpp"

#include <bit>

namespace stylobate::fuzz {
namespace {

namespace fs = std::filesystem;

bool same(double a, double b)
{
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

bool same(const std::vector<double>& a, const std::vector<double>& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) { return same(x, y); });
}

void check_same(const Campaign& a, const Campaign& b)
{
    const Specimen &s = a.specimen, &t = b.specimen;
    promise(s.name == t.name && s.joints == t.joints && same(s.gravity_m_s2, t.gravity_m_s2) &&
                s.friction_nominal == t.friction_nominal && s.base_block_half_width_m == t.base_block_half_width_m &&
                same(s.base_block_top_m, t.base_block_top_m),
            "a specimen changes when it is written");
    for (const SpecimenList& list : specimen_lists())
        promise(same(s.*list.member, t.*list.member), "a list of the specimen changes when it is written");
    for (const SpecimenNumber& number : specimen_numbers())
        promise(same(s.*number.member, t.*number.member), "a number of the specimen changes when it is written");
    const auto old = every_run(a), read = every_run(b);
    promise(a.runs.size() == b.runs.size() && old.size() == read.size(), "runs are lost when they are written");
    for (std::size_t r = 0; r < old.size(); ++r) {
        const MeasuredRun &x = *old[r], &y = *read[r];
        promise(x.test == y.test && x.joint == y.joint && x.present == y.present && x.clamped == y.clamped &&
                    x.taped == y.taped && x.dummies == y.dummies && x.released_s == y.released_s &&
                    x.forces.size() == y.forces.size(),
                "a test changes when it is written");
        for (std::size_t f = 0; f < x.forces.size(); ++f)
            promise(x.forces[f].block == y.forces[f].block && same(x.forces[f].height_m, y.forces[f].height_m) &&
                        same(x.forces[f].value_n.values, y.forces[f].value_n.values),
                    "a force changes when it is written");
        promise(x.name == y.name && x.motion_id == y.motion_id && x.repeat == y.repeat && x.kind == y.kind &&
                    same(x.rate_hz, y.rate_hz) && x.run_order == y.run_order && x.collapsed == y.collapsed &&
                    same(x.collapse_time_s, y.collapse_time_s),
                "a run changes when it is written");
        promise(same(x.time_s, y.time_s), "a clock changes when it is written");
        for (const SeriesName& name : series_names())
            promise(same(name.in(x).values, name.in(y).values), "a series changes when it is written");
    }
}

void check_sizes(const Campaign& campaign)
{
    const std::size_t blocks = block_count(campaign);
    for (const MeasuredRun* run : every_run(campaign))
        for (const SeriesName& name : series_names())
            promise(name.in(*run).empty() ||
                        name.in(*run).values.size() == run->time_s.size() * (name.per_block ? blocks : 1),
                    "a series does not fit its clock");
}

/// In this process, unlike `read_campaign`: there a crash of a child is a refusal.
Campaign read_here(const fs::path& file)
{
    Campaign campaign = read_measured_hdf5_here(file);
    check_shapes(campaign);
    check_campaign(campaign);
    return campaign;
}

void check_written_again(const Campaign& campaign)
{
    const fs::path file = folder() / "again.h5";
    write_campaign(campaign, file);
    check_same(campaign, read_here(file));
}

struct Original {
    std::string bytes;
    std::vector<Hdf5Object> objects;
};

const Original& original()
{
    static const Original made = [] {
        Campaign campaign;
        campaign.specimen = sample_specimen(2);
        const SampleMotion motion = {.amplitude_m = 0.005, .frequency_hz = 2, .start_s = 0.1, .duration_s = 0.8};
        campaign.runs = {sample_run(campaign.specimen, "000", 1, motion, 50, 1)};
        campaign.tests = sample_tests(campaign.specimen, 20);
        campaign.laboratory.stroke_m = 0.02;
        const fs::path file = folder() / "campaign.h5";
        write_campaign(campaign, file);
        return Original{file_content(file), objects_in(file)};
    }();
    return made;
}

template <class Read>
Verdict judge_read(const Read& read)
{
    Campaign campaign;
    const Verdict verdict = judged([&] {
        campaign = read();
        check_sizes(campaign);
    });
    if (verdict == Verdict::accepted)
        check_written_again(campaign);
    return verdict;
}

Verdict judge_hdf5(std::string_view input)
{
    ByteSource recipe(input);
    const fs::path file = folder() / "changed.h5";
    write_file(file, original().bytes);
    if (!edit_hdf5_file(file, original().objects, recipe, 8))
        return Verdict::refused;
    return judge_read([&] { return read_here(file); });
}

Verdict judge_folder(std::string_view input)
{
    const fs::path made = folder() / "campaign";
    fs::remove_all(made);
    fs::create_directories(made / "runs");
    while (input.starts_with('@')) {
        const std::size_t line = std::min(input.find('\n'), input.size());
        const std::string name(input.substr(1, line - 1));
        input.remove_prefix(std::min(line + 1, input.size()));
        const std::size_t end = input.starts_with('@') ? 0 : std::min(input.find("\n@"), input.size() - 1) + 1;
        const bool plain = name == "campaign.toml" || (name.starts_with("runs/") && name.size() < 40 &&
                                                       name.find_first_of("/\0", 5) == std::string::npos);
        if (plain && name != "runs/" && name != "runs/." && name != "runs/..")
            write_file(made / name, input.substr(0, end));
        input.remove_prefix(std::min(end, input.size()));
    }
    return judge_read([&] { return read_campaign(made); });
}

Verdict judge(std::string_view input)
{
    return input.starts_with('h') ? judge_hdf5(input.substr(1)) : judge_folder(input);
}

std::string mutated(std::string_view input, Random& random)
{
    static const std::vector<std::string> words = [] {
        std::vector<std::string> all = {"@campaign.toml\n",
                                        "@runs/a.csv\n",
                                        "time_s",
                                        "time_ms",
                                        "[[run]]\n",
                                        "[specimen]\n",
                                        "joints",
                                        "name",
                                        "gravity_m_s2",
                                        "rate_hz",
                                        "collapsed",
                                        "collapse_time_s",
                                        "base_source",
                                        "\"command\"",
                                        "base_clock",
                                        "run_order",
                                        "motion_id",
                                        "repeat",
                                        "kind",
                                        "friction_nominal",
                                        "format_version = 2",
                                        "\"pull\"",
                                        "\"tilt\"",
                                        "joint = 1",
                                        "present = [0, 1]",
                                        "clamped = [0]",
                                        "taped = [[0, 1]]",
                                        "[[run.dummy]]\n",
                                        "[[run.force]]\n",
                                        "block = 1",
                                        "height_m = 0.01",
                                        "force_a_n",
                                        "released_s = 0.2",
                                        "[columns]\n",
                                        "[laboratory]\n",
                                        "may_dismantle",
                                        "motion"};
        for (const SeriesName& series : series_names())
            for (const char* block : {"", "0", "1"})
                all.push_back(std::string(series.column) + block + series.suffix);
        for (const SpecimenList& list : specimen_lists())
            all.emplace_back(list.name);
        return all;
    }();
    return input.starts_with('h') ? "h" + mutated_bytes(input.substr(1), random) : mutated_text(input, random, words);
}

} // namespace

const Target campaign_target = {"campaign", judge, mutated, 4096, 500};

} // namespace stylobate::fuzz
