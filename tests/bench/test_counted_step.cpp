/// The number of operations by which `stylobate bench` states the share of the peak is that of the code.

#include "bench/counted.hpp"
#include "studies/workflow/bench/scenes.hpp"

#include <gtest/gtest.h>

namespace stylobate {

TEST(CountedStep, HasTheOperationsOfTheSpecimen)
{
    EXPECT_EQ(static_cast<double>(operations_per_block_step(7).flops()), specimen_operations);
}

} // namespace stylobate
