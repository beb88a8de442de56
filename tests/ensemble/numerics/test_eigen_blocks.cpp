/// Sizes of Eigen's blocks. That programs have the fixed ones is tested where they are linked: `RobustFit`.

#include "ensemble/numerics/eigen_blocks.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

/// What they are fixed for: with the blocks of another processor a product has other bits.
TEST(EigenBlocks, DecideTheLastDigits)
{
    const Eigen::MatrixXd tall = Eigen::MatrixXd::Random(4000, 60);
    const Eigen::MatrixXd here = tall.transpose() * tall;
    Eigen::setCpuCacheSizes(48 << 10, 2 << 20, 32 << 20);
    const Eigen::MatrixXd there = tall.transpose() * tall;
    Eigen::setCpuCacheSizes(block_caches[0], block_caches[1], block_caches[2]);
    const Eigen::MatrixXd again = tall.transpose() * tall;
    EXPECT_EQ(here, again);
    EXPECT_NE(here, there);
    EXPECT_LT((here - there).cwiseAbs().maxCoeff(), 1e-9);
}

} // namespace
} // namespace stylobate
