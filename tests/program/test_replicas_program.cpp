/// A surface with twins as its user runs it: the same bytes whatever the threads and interruptions, its originals are
/// the surface's, every twin can be replayed, tables, pictures and page; refusals.

#include "tests/program/program.hpp"

#include "io/store/result_store.hpp"

#include <cmath>

namespace stylobate {
namespace {

constexpr int realizations = 6;
constexpr std::uint64_t originals = 16 * realizations;
const std::vector<std::string> small_replicas = short_surface(realizations);
const std::vector<std::string> twins = with(small_replicas, {"twins.moves_m=[1e-9, 1e-4]", "twins.followed=2"});

class ReplicasProgram : public ColumnProgram {};

TEST_F(ReplicasProgram, ThreadsInstructionSetsAndInterruptionsChangeNoByte)
{
    expect_no_byte_changes([](const std::string& results, const char* threads, const std::string& simd) {
        return words(twins, results, threads, simd);
    });
}

TEST_F(ReplicasProgram, ItsOriginalsAreTheSurface)
{
    const Ended ended = run(words(twins, "twins.h5", "2"));
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    ASSERT_EQ(run(words(small_replicas, "plain.h5", "2")).status, 0);
    const ResultReader with_twins(folder / "twins.h5"), plain(folder / "plain.h5");
    ASSERT_EQ(with_twins.rows().size(), 7 * originals);
    for (const ResultRow& row : plain.rows())
        EXPECT_TRUE(same_bits(row, with_twins.row(row.index))) << row.index;
    EXPECT_EQ(with_twins.surface().trials, plain.surface().trials) << "twins are no trials";
    EXPECT_EQ(with_twins.surface().collapses, plain.surface().collapses);

    // what it says of its twins is what its rows say
    const JsonValue json = json_of(ended);
    EXPECT_EQ(json["limit_states"]["trials"].number, static_cast<double>(originals));
    const JsonValue& said = json["twins"]["kinds"];
    ASSERT_EQ(said.items.size(), 6U);
    for (std::uint64_t kind = 0; kind < 6; ++kind) {
        double flips = 0, pairs = 0;
        for (std::uint64_t i = 0; i < originals; ++i) {
            const State original = with_twins.row(i).outcome.state;
            const State twin = with_twins.row((kind + 1) * originals + i).outcome.state;
            if (original == State::invalid || twin == State::invalid)
                continue;
            pairs += 1;
            flips += (original == State::collapsed) != (twin == State::collapsed);
        }
        EXPECT_EQ(said.items[kind]["flips"].number, flips) << kind;
        EXPECT_EQ(said.items[kind]["pairs"].number, pairs) << kind;
        // so few pairs in a cell say nothing of it, though most of them agree
        EXPECT_EQ(said.items[kind]["cells"]["certain"].number, 0) << realizations << " pairs in each cell";
        EXPECT_GT(said.items[kind]["cells"]["too few pairs to say"].number, 0);
    }
    EXPECT_EQ(with_twins.table("twins").list_shape("original")[0], 16U * 2 * 2);
}

TEST_F(ReplicasProgram, EveryTwinIsReplayed)
{
    ASSERT_EQ(run(words(twins, "t.h5", "2")).status, 0);
    for (std::uint64_t kind = 0; kind <= 6; ++kind) {
        const Ended ended = run({"replay", "t.h5", "--realization", std::to_string(kind * originals + 41), "--json"});
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
        EXPECT_TRUE(json_of(ended)["same_bits"].boolean) << kind;
    }
    EXPECT_EQ(run({"replay", "t.h5", "--realization", std::to_string(7 * originals)}).status, 2);
}

TEST_F(ReplicasProgram, TablesPicturesAndPage)
{
    ASSERT_EQ(run(words(twins, "t.h5", "2")).status, 0);
    ASSERT_EQ(run({"export", "t.h5", "--to", "csv"}).status, 0);
    EXPECT_EQ(count_of(bytes("t_csv/twins.csv"), "\n"), 1 + 16 * 6U);
    EXPECT_EQ(count_of(bytes("t_csv/predictability.csv"), "\n"), 1 + 16 * 2U);
    for (const char* picture : {"twins", "predictability", "surface"}) {
        ASSERT_EQ(run({"export", "t.h5", "--to", "png", "--picture", picture}).status, 0) << picture;
        EXPECT_GT(bytes(std::string("t_") + picture + ".png").size(), 10000U) << picture;
    }
    ASSERT_EQ(run({"report", "t.h5", "-o", "t.html"}).status, 0);
    const std::string page = bytes("t.html");
    EXPECT_NE(page.find("Predictability of the verdict"), std::string::npos);
    EXPECT_NE(page.find("moved by 1e-09 m"), std::string::npos);
    EXPECT_NE(page.find(std::to_string(originals) + " valid realizations"), std::string::npos);

    ASSERT_EQ(run(words(small_replicas, "plain.h5", "2")).status, 0);
    expect_refused(Words{"export", "plain.h5", "--to", "png", "--picture", "twins"}, {"plain.h5", "[twins]"});
    ASSERT_EQ(run(words(with(twins, {"twins.followed=0"}), "none.h5", "2")).status, 0);
    expect_refused(Words{"export", "none.h5", "--to", "png", "--picture", "predictability"}, {"twins.followed"});
}

TEST_F(ReplicasProgram, BadInputIsRefusedWithItsRange)
{
    const auto refused = [&](const std::vector<std::string>& settings, const std::vector<std::string>& says) {
        expect_refused(words(with(small_replicas, settings), "none.h5", "1"), says);
    };
    refused({"twins.moves_m=[1e-3, 1e-6]"}, {"twins.moves_m", "ascending", "1e-06"});
    refused({"twins.moves_m=[1e-6, 1e-6]"}, {"twins.moves_m", "ascending"});
    refused({"twins.moves_m=[-1e-6]"}, {"twins.moves_m", "is outside [0, 0.012]"});
    refused({"twins.moves_m=[1]"}, {"twins.moves_m", "a quarter of the drum's width"});
    refused({"twins.moves=[1e-6]"}, {"Did you mean moves_m?"});
    refused({"twins.block=0"}, {"twins.block = 0", "is fixed to the base"});
    refused({"twins.block=4"}, {"twins.block = 4 is outside [0, 3]"});
    refused({"twins.step_ratio=1.1"}, {"twins.step_ratio = 1.1 is outside [0.01, 1]"});
    refused({"twins.followed=7"}, {"twins.followed = 7 is outside [0, 6]"});
    refused({"twins.tolerance=0"}, {"twins.tolerance"});
    refused({"twins.forms=2"}, {"twins.forms"});
    refused({"twins.precision=true", "mechanisms.stribeck={dynamic_friction=0.5,velocity_m_s=0.05}"},
            {"twins.precision", "single precision"});
    refused({"twins.forms=true", "run.precision=\"single\""}, {"run.precision"});
    refused({"twins.forms=true", "surface.adaptive={budget=400}"}, {"surface.adaptive"});
    refused({"twins.forms=true", "output.realizations=\"none\""}, {"output.realizations"});
    expect_refused(
        run_words(STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml", {"twins.forms=true"}, {"-o", "none.h5"}),
        {"[twins]", "kind = \"single\""});
    Words device = words(twins, "none.h5", "1").arguments;
    device.insert(device.end(), {"--backend", "cuda"});
    expect_refused(device, {"--backend cuda"});
}

} // namespace
} // namespace stylobate
