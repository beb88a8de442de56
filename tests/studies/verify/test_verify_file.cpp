/// `verify-file` finds each kind of error that leaves the checksums right, names it, and finds nothing where there is
/// none. (That it finds nothing in any ready study is in tests/program/test_pinned_outcomes.cpp.)

#include "studies/verify/verification.hpp"

#include "ensemble/model/input_error.hpp"
#include "io/store/result_seal.hpp"
#include "io/store/result_store.hpp"
#include "kernels/isa.hpp"
#include "studies/experiment/limit_state.hpp"
#include "tests/studies/verify/results_made.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <map>

namespace stylobate {
namespace {

using VerifyFile = MadeResults;

FileVerification verified(const std::string& file, std::uint64_t replay = 1000)
{
    VerifyOptions options;
    options.replay = replay;
    options.run = {best_isa(), 2};
    Observer patient;
    return verify_file(file, options, patient);
}

const FileCheck& check_of(const FileVerification& v, const std::string& name)
{
    for (const FileCheck& check : v.checks)
        if (check.name == name)
            return check;
    ADD_FAILURE() << "no check " << name << "\n" << text_of(v);
    return v.checks.front();
}

/// One check differs and no other, in one value, which is named.
void expect_one(const FileVerification& v, const std::string& name, const ValueDifference& want)
{
    EXPECT_FALSE(v.well());
    for (const FileCheck& check : v.checks)
        EXPECT_EQ(check.verdict == CheckVerdict::differs, check.name == name) << text_of(v);
    const FileCheck& check = check_of(v, name);
    ASSERT_EQ(check.found(), 1U) << text_of(v);
    EXPECT_EQ(check.differences[0].where, want.where);
    EXPECT_EQ(check.differences[0].realization, want.realization);
    EXPECT_EQ(check.differences[0].stored, want.stored);
    EXPECT_EQ(check.differences[0].expected, want.expected);
}

TEST_F(VerifyFile, FindsTheLastBitOfOneValueOfOneRealization)
{
    make_results(ready_study("small_scale_column", two_cells(4)), file);
    EXPECT_TRUE(verified(file).well()) << text_of(verified(file));

    double right = 0, wrong = 0;
    const std::string other = (folder / "other.h5").string();
    alter(file, other, {.row = [&](ResultRow& row) {
              if (row.index != 5)
                  return;
              right = row.outcome.energy_damping_j;
              wrong = row.outcome.energy_damping_j = std::nextafter(right, 1e300);
          }});
    expect_one(verified(other), "replay",
               {"outcome/energy_damping_j", 5, fmt::format("{}", wrong), fmt::format("{}", right)});
    const std::string text = text_of(verified(other));
    EXPECT_NE(
        text.find(fmt::format("realization 5, outcome/energy_damping_j: {} in the file, {} expected", wrong, right)),
        std::string::npos)
        << text;
    EXPECT_TRUE(verified(other, 0).well()) << "only a replay can see it";
    EXPECT_EQ(check_of(verified(other, 0), "replay").verdict, CheckVerdict::not_done);

    alter(file, folder / "input.h5", {.row = [&](ResultRow& row) {
              if (row.index == 2)
                  row.inputs[0] = -row.inputs[0];
          }});
    const FileVerification input = verified(folder / "input.h5");
    EXPECT_EQ(check_of(input, "replay").differences.at(0).where, "input/" + ResultReader(file).header().input_names[0]);
}

/// The kinetic energy of a column at rest is what rounding leaves of it, of either sign.
TEST_F(VerifyFile, TakesColumnsAtRest)
{
    const LoadedStudy quiet =
        ready_study("small_scale_column", {"study.realizations=200", "surface.frequency_hz={from=0.5,to=0.5,count=1}",
                                           "surface.pga_m_s2={from=1.0,to=1.0,count=1}"});
    make_results(quiet, file);
    int below = 0;
    ResultReader(file).for_each_row([&](const ResultRow& row) { below += row.outcome.energy_kinetic_j < 0; });
    EXPECT_GT(below, 0) << "the test shows nothing";
    EXPECT_TRUE(verified(file).well()) << text_of(verified(file));
}

TEST_F(VerifyFile, FindsRowsThatContradictThemselves)
{
    make_results(ready_study("small_scale_column", two_cells(4)), file);
    std::uint64_t fallen = 0;
    ResultReader(file).for_each_row([&](const ResultRow& row) {
        if (row.outcome.state == State::collapsed)
            fallen = row.index;
    });
    ASSERT_GT(fallen, 0U) << "one falls in the strong cell";
    const ResultRow right = ResultReader(file).row(fallen);

    const auto altered = [&](const std::function<void(Outcome&)>& edit) {
        const std::string other = (folder / "other.h5").string();
        fs::remove(other);
        alter(file, other, {.row = [&](ResultRow& row) {
                  if (row.index == fallen)
                      edit(row.outcome);
              }});
        return check_of(verified(other, 0), "rows");
    };
    const auto expect = [&](const FileCheck& check, const std::string& where) {
        ASSERT_GT(check.found(), 0U) << where;
        EXPECT_EQ(check.differences[0].where, where);
        EXPECT_EQ(check.differences[0].realization, fallen);
    };
    expect(altered([](Outcome& o) { ++o.fallen_blocks; }), "outcome/fallen_blocks");
    expect(altered([](Outcome& o) { o.collapse_time_s += 1e-9; }), "outcome/collapse_time_s");
    expect(altered([](Outcome& o) { o.first_collapse_block = o.first_collapse_block == 0 ? 1 : 0; }),
           "outcome/first_collapse_block");
    expect(altered([](Outcome& o) { o.end_time_s = o.collapse_time_s / 2; }), "outcome/end_time_s");
    expect(altered([](Outcome& o) { o.state = State::rocked; }), "outcome/state");
    expect(altered([](Outcome& o) { o.state = State::invalid; }), "outcome/invalid_reason");
    expect(altered([](Outcome& o) { o.invalid_reason = InvalidReason::energy; }), "outcome/invalid_reason");
    expect(altered([](Outcome& o) { o.top_path_m = -1; }), "outcome/top_path_m");
    expect(altered([](Outcome& o) { o.energy_kinetic_j = std::nan(""); }), "outcome/energy_kinetic_j");
    expect(altered([](Outcome& o) { o.step_s = 0; }), "outcome/step_s");
    expect(altered([](Outcome& o) { o.unseated_block = 0; }), "outcome/unseated_block");

    alter(file, folder / "cell.h5", {.row = [&](ResultRow& row) { row.cell = row.index == 1 ? 99 : row.cell; }});
    const FileVerification cell = verified(folder / "cell.h5");
    EXPECT_EQ(check_of(cell, "rows").differences.at(0).where, "cell");
    EXPECT_EQ(check_of(cell, "tables").verdict, CheckVerdict::not_done) << "there is no such cell";
    EXPECT_EQ(check_of(cell, "replay").verdict, CheckVerdict::not_done);
}

TEST_F(VerifyFile, FindsTablesThatAreNotOfTheRows)
{
    make_results(ready_study("small_scale_column", two_cells(4)), file);
    const std::uint64_t right = ResultReader(file).surface().collapses[1];
    alter(file, folder / "surface.h5", {.surface = [](SurfaceTable& table) { --table.collapses[1]; }});
    expect_one(verified(folder / "surface.h5"), "tables",
               {"surface/collapses[1]", std::nullopt, fmt::format("{}", right - 1), fmt::format("{}", right)});

    // a fragility study's table, of rows one of which did not fall
    const std::string fragility = (folder / "fragility.h5").string();
    make_results(ready_study("fragility_column",
                             {"study.realizations=6", "fragility.motions=8",
                              "fragility.intensity={measure=\"pgv\",from=0.5,to=3.0,count=2,spacing=\"log\"}"}),
                 fragility);
    EXPECT_TRUE(verified(fragility).well()) << text_of(verified(fragility));
    alter(fragility, folder / "other.h5",
          {.row = [](ResultRow& row) { row.outcome.residual_dislocation += row.index == 3 ? 0.5 : 0; },
           .table = "fragility"});
    const FileVerification other = verified(folder / "other.h5", 0);
    EXPECT_TRUE(check_of(other, "tables").differences.at(0).where.starts_with("fragility/")) << text_of(other);
}

TEST_F(VerifyFile, FindsAnAdaptiveRunThatDidNotAskForItsRealizations)
{
    make_results(ready_study("small_scale_column_adaptive",
                             two_cells(20, {"surface.adaptive={budget=40,minimum=4,half_width=0.05,borrow=true}"})),
                 file);
    EXPECT_TRUE(verified(file).well()) << text_of(verified(file));
    alter(file, folder / "fewer.h5", {.keep = [](const ResultRow& row) { return row.index != 2; }});
    const FileVerification v = verified(folder / "fewer.h5");
    EXPECT_EQ(check_of(v, "tables").differences.at(0).realization, 2U) << text_of(v);
}

TEST_F(VerifyFile, FindsAnotherStudyThanTheText)
{
    make_results(ready_study("small_scale_column", two_cells(2, {"study.title=\"wall 1\""})), file);
    alter(file, folder / "seed.h5", {.header = [](ResultHeader& header) { ++header.seed; }});
    EXPECT_EQ(check_of(verified(folder / "seed.h5"), "study").differences.at(0).where, "seed");
    alter(file, folder / "block.h5", {.header = [](ResultHeader& header) { header.block_names[0] += '!'; }});
    const FileVerification renamed = verified(folder / "block.h5");
    EXPECT_EQ(check_of(renamed, "study").differences.at(0).stored, "its blocks have other names") << text_of(renamed);
    EXPECT_EQ(check_of(renamed, "replay").verdict, CheckVerdict::not_done);

    // the text changed in place, its checksum left, and the file sealed again
    std::string bytes = bytes_of(file);
    const std::size_t title = bytes.find("wall 1");
    ASSERT_NE(title, std::string::npos);
    bytes[title + 5] = '2';
    put_bytes(file, bytes);
    {
        std::uint32_t block = 0, count = 0;
        std::memcpy(&block, bytes.data() + 20, 4);
        std::memcpy(&count, bytes.data() + 32, 4);
        std::vector<Extent> extents(count);
        std::memcpy(extents.data(), bytes.data() + 40, count * sizeof(Extent));
        FileHandle handle = FileHandle::open(file, true);
        write_seal(handle, block, extents);
    }
    const FileVerification v = verified(file);
    EXPECT_EQ(check_of(v, "study").differences.at(0).where, "study_crc32") << text_of(v);
    EXPECT_EQ(check_of(v, "replay").verdict, CheckVerdict::passed) << "a title changes no realization";
}

TEST_F(VerifyFile, FindsATrajectoryThatIsNotThatOfItsRealization)
{
    make_results(ready_study("free_rocking", {}), file);
    EXPECT_TRUE(verified(file).well()) << text_of(verified(file));
    alter(file, folder / "other.h5", {.trajectory = [](Trajectory& t) { t["x_m"][7] += 1e-6; }});
    const FileVerification v = verified(folder / "other.h5");
    ASSERT_EQ(check_of(v, "replay").found(), 1U) << text_of(v);
    EXPECT_EQ(check_of(v, "replay").differences[0].where, "trajectories/0/x_m[7]");
}

TEST_F(VerifyFile, FindsWrongCounts)
{
    const LoadedStudy loaded = ready_study("small_scale_column", two_cells(6, {"output.realizations=\"none\""}));
    make_results(loaded, file);
    const FileVerification good = verified(file);
    EXPECT_TRUE(good.well()) << text_of(good);
    EXPECT_NE(check_of(good, "replay").text.find("2 whole cells"), std::string::npos) << text_of(good);
    const FileVerification one = verified(file, 11);
    EXPECT_NE(check_of(one, "replay").text.find("1 whole cell "), std::string::npos) << text_of(one);
    const FileVerification none = verified(file, 5);
    EXPECT_NE(check_of(none, "replay").text.find("fits into --replay"), std::string::npos) << text_of(none);

    // the same counts but for one realization; the surface is that of the counts
    const std::string rows = (folder / "rows.h5").string();
    make_results(ready_study("small_scale_column", two_cells(6)), rows);
    const auto counted = [&](const std::string& to, const std::function<void(TallyEntry&)>& edit) {
        const ResultHeader header = loaded.result_header();
        const std::unique_ptr<Kind> kind = make_kind(loaded.study(), header);
        const auto writer = TallyWriter::create(to, header);
        ResultReader(rows).for_each_row([&](const ResultRow& row) {
            TallyEntry entry = tally_entry(row);
            edit(entry);
            writer->add(entry);
        });
        kind->add(writer->tally());
        writer->finish(*kind->surface());
        return verified(to);
    };
    EXPECT_TRUE(counted(folder / "same.h5", [](TallyEntry&) {}).well());
    const FileVerification slid = counted(folder / "slid.h5", [](TallyEntry& entry) {
        if (entry.index == 1)
            entry.reached ^= 1U << static_cast<unsigned>(LimitState::slid);
    });
    ASSERT_EQ(check_of(slid, "replay").found(), 1U) << text_of(slid);
    EXPECT_EQ(check_of(slid, "replay").differences[0].where, "tally/reached[0, 0] (slid)");
    const FileVerification fell = counted(folder / "fell.h5", [](TallyEntry& entry) {
        if (entry.reached & 1U)
            entry.first_block = -1;
    });
    EXPECT_EQ(check_of(fell, "counts").differences.at(0).where, "tally/first_fallen[0, 0]") << text_of(fell);
    const FileVerification energy =
        counted(folder / "energy.h5", [](TallyEntry& entry) { entry.energy_residual *= 1 + 0x1p-50; });
    EXPECT_EQ(check_of(energy, "replay").differences.at(0).where, "tally/energy_residual") << text_of(energy);
}

TEST_F(VerifyFile, TakesPartsOfARun)
{
    // shards, with rows and with counts
    for (const char* kept : {"all", "none"}) {
        const std::string shard = (folder / (std::string("shard_") + kept + ".h5")).string();
        make_results(
            ready_study("small_scale_column", two_cells(8, {std::string("output.realizations=\"") + kept + '"'})),
            shard, {2, 3});
        const FileVerification v = verified(shard);
        EXPECT_TRUE(v.well()) << text_of(v);
        EXPECT_FALSE(v.complete);
        EXPECT_EQ(check_of(v, "tables").verdict, CheckVerdict::not_done);
    }
    // unfinished files of kinds whose realizations depend on earlier ones
    for (const auto& [input, settings] :
         {std::pair{"rare_collapse", std::vector<std::string>{"rare.samples=200", "rare.repeats=5"}},
          std::pair{"small_scale_column_adaptive",
                    two_cells(20, {"surface.adaptive={budget=40,minimum=4,half_width=0.05,borrow=true}"})}}) {
        const LoadedStudy loaded = ready_study(input, settings);
        const std::string whole = (folder / (std::string(input) + "_whole.h5")).string();
        make_results(loaded, whole);
        const std::string part = (folder / (std::string(input) + "_part.h5")).string();
        const ResultReader reader(whole);
        const auto writer = ResultWriter::create(part, loaded.result_header());
        std::uint64_t kept = 0;
        for (const ResultRow& row : reader.rows())
            if (++kept % 7 != 0)
                writer->add(row);
        writer->flush();
        const FileVerification v = verified(part, 12);
        EXPECT_FALSE(check_of(v, "rows").found() > 0) << text_of(v);
        for (const ValueDifference& d : check_of(v, "replay").differences)
            EXPECT_EQ(d.where, "realizations") << text_of(v);
    }
}

TEST_F(VerifyFile, SaysThatARecordIsMissing)
{
    const std::string record = (folder / "record.txt").string();
    {
        std::ofstream out(record);
        for (int i = 0; i < 400; ++i)
            out << 0.01 * i << ' ' << 3 * std::sin(0.12566 * i) << '\n';
    }
    const std::vector<std::string> settings = {"study.realizations=1",
                                               "structure.blocks=3",
                                               "contact.normal_stiffness_n_m2=1e8",
                                               "excitation.unit=\"m/s2\"",
                                               "excitation.file=" + record,
                                               "surface.frequency_hz={from=4.0,to=4.0,count=1}",
                                               "surface.pga_m_s2={from=3.0,to=9.0,count=2}"};
    make_results(ready_study("record", settings), file);
    EXPECT_TRUE(verified(file).well()) << text_of(verified(file));
    fs::rename(record, folder / "moved.txt");
    const FileVerification v = verified(file);
    EXPECT_TRUE(v.well()) << text_of(v);
    EXPECT_EQ(check_of(v, "replay").verdict, CheckVerdict::not_done);
    EXPECT_NE(check_of(v, "replay").text.find("no such file"), std::string::npos) << text_of(v);
    EXPECT_EQ(check_of(v, "tables").verdict, CheckVerdict::passed) << text_of(v);

    VerifyOptions options{.settings = {"excitation.file=" + (folder / "moved.txt").string()}, .run = {best_isa(), 1}};
    Observer patient;
    const FileVerification moved = verify_file(file, options, patient);
    EXPECT_EQ(check_of(moved, "replay").verdict, CheckVerdict::passed) << text_of(moved);
    options.settings = {"study.seed=2"};
    EXPECT_THROW(verify_file(file, options, patient), InputError);
}

TEST_F(VerifyFile, SaysThatAnotherVersionWroteIt)
{
    make_results(ready_study("small_scale_column", two_cells(2)), file);
    alter(file, folder / "old.h5", {.header = [](ResultHeader& header) {
              header.code_version = "0.0.1";
              header.build.reset();
          }});
    const FileVerification v = verified(folder / "old.h5");
    EXPECT_TRUE(v.well()) << text_of(v);
    EXPECT_FALSE(v.same_version);
    EXPECT_NE(text_of(v).find("written by stylobate 0.0.1\n  This is version "), std::string::npos) << text_of(v);
}

TEST_F(VerifyFile, TheSampleIsSpreadOverTheCells)
{
    make_results(ready_study("small_scale_column", two_cells(8)), file);
    const ResultReader reader(file);
    std::set<std::vector<std::uint64_t>> seen;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const std::vector<std::uint64_t> sample = replay_sample(reader, 5, seed);
        ASSERT_EQ(sample.size(), 5U);
        EXPECT_EQ(sample, replay_sample(reader, 5, seed));
        const auto weak = std::ranges::count_if(sample, [](std::uint64_t index) { return index < 8; });
        EXPECT_TRUE(weak == 2 || weak == 3) << weak;
        seen.insert(sample);
    }
    EXPECT_GT(seen.size(), 15U);
    EXPECT_EQ(replay_sample(reader, 100, 1).size(), 16U);
    EXPECT_TRUE(replay_sample(reader, 0, 1).empty());
}

TEST_F(VerifyFile, StopsWhenItIsAskedTo)
{
    make_results(ready_study("small_scale_column", two_cells(8)), file);
    VerifyOptions options{.settings = {}, .run = {best_isa(), 1}};
    Impatient at_once(0);
    const FileVerification v = verify_file(file, options, at_once);
    EXPECT_TRUE(v.stopped);
    EXPECT_TRUE(v.well()) << text_of(v);
    EXPECT_EQ(check_of(v, "replay").verdict, CheckVerdict::not_done);
}

} // namespace
} // namespace stylobate
