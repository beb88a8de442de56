/// The code that nvcc emits for structures with a lane for every bed, run on the processor with its lanes in random
/// order: every number of every column, and every outcome, has the bits of the processor's step.

#include "tests/ensemble/engine/lanes/both_ways.hpp"
#include "tests/ensemble/engine/lanes/ptx_warp.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace columns {
ptx::Kernels kernels();
}
namespace colonnades {
ptx::Kernels kernels();
}

using namespace stylobate;

namespace {

/// As the device launches it, with other memory and another order of the lanes every time.
class PtxStep {
public:
    void operator()(const SlotMemory& m, int chunks, int count)
    {
        with_lanes(m, [&]<int width, bool lists>() {
            const ptx::Kernel& kernel =
                ptx::kernel_named(lists ? colonnades::kernels() : columns::kernels(),
                                  "step_slots<" + std::to_string(width) + ", " + (lists ? "true" : "false") + ">");
            const std::vector<char> parameters = ptx::packed(m, chunks, count);
            constexpr int slots = block_slots<width, lists>;
            machine_->run(kernel, parameters.data(), parameters.size(), (count + slots - 1) / slots,
                          warp_lanes * block_warps, block_shared_bytes<width, lists>, ++seed_);
        });
    }

private:
    std::shared_ptr<ptx::Machine> machine_ = std::make_shared<ptx::Machine>();
    unsigned seed_ = 0;
};

} // namespace

class PtxColumnsOfBlocks : public testing::TestWithParam<int> {};

TEST_P(PtxColumnsOfBlocks, HaveTheBitsOfTheProcessor)
{
    const auto device = same_in_lanes(of_blocks(GetParam(), {"study.realizations=1"}), {}, PtxStep());
    EXPECT_GT(device->asked, 5) << "nothing ended";
    RecordProperty("numbers", std::to_string(device->compared));
}

INSTANTIATE_TEST_SUITE_P(Blocks, PtxColumnsOfBlocks, testing::Values(1, 2, 4, 6, 9, 12));

TEST(PtxColumns, AlongARecordAndUnderAPulseHaveTheBitsOfTheProcessor)
{
    same_in_lanes(along_chirp({"study.realizations=1"}), {.record = chirp()}, PtxStep());
    Study pulse = of_blocks(6, {"study.realizations=1"});
    pulse.excitation.kind = ExcitationKind::ricker;
    same_in_lanes(pulse, {}, PtxStep());
}

TEST(PtxColumns, ABrokenRealizationIsSetAside)
{
    broken_are_set_aside(PtxStep());
}

TEST(PtxColumns, ReadyStudiesHaveTheBitsOfTheProcessor)
{
    for (const char* file : {"small_scale_column.toml", "rare_collapse.toml", "doric_column.toml",
                             "fragility_column.toml", "synthetic_earthquake.toml"})
        EXPECT_NE(begin_in_lanes(file, 4, PtxStep()), nullptr) << file;
}

class PtxColonnades : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(PtxColonnades, HaveTheBitsOfTheProcessor)
{
    const auto [columns, drums] = GetParam();
    const auto device =
        same_in_lanes(colonnade_of(columns, drums,
                                   {"study.realizations=1", "surface.frequency_hz={ from = 3.0, to = 3.0, count = 1 }",
                                    "surface.pga_m_s2={ from = 15.0, to = 15.0, count = 1 }"}),
                      {}, PtxStep());
    EXPECT_GT(device->asked, 0) << "nothing ended";
    RecordProperty("numbers", std::to_string(device->compared));
}

INSTANTIATE_TEST_SUITE_P(Columns, PtxColonnades, testing::Values(std::pair{2, 2}, std::pair{2, 3}, std::pair{3, 5}));

/// More columns, to their end.
TEST(PtxColumnsLong, ASurfaceHasTheBitsOfTheProcessor)
{
    const auto device = same_in_lanes(column({"study.realizations=20"}), {}, PtxStep());
    RecordProperty("numbers", std::to_string(device->compared));
}
