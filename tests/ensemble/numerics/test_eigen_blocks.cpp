/// Sizes of Eigen's blocks, which must not be those of this machine.

#include "ensemble/numerics/eigen_blocks.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

TEST(EigenBlocks, AreTheSameOnEveryMachine)
{
    EXPECT_EQ(Eigen::l1CacheSize(), block_caches[0]);
    EXPECT_EQ(Eigen::l2CacheSize(), block_caches[1]);
    EXPECT_EQ(Eigen::l3CacheSize(), block_caches[2]);
}

/// What this is for: with the blocks of another processor a product has other bits.
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
