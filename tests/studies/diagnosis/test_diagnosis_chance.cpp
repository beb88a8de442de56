/// The file in which what chance gives is kept: it may be interrupted, and is used for nothing but what it is of.

#include "tests/ensemble/tracking/synthetic_campaign.hpp"
#include "tests/io/measured/measured_samples.hpp"

#include "studies/calibration/calibration.hpp"
#include "studies/diagnosis/decision/chance.hpp"

#include <gtest/gtest.h>

namespace stylobate {
namespace {

struct Counted {
    Chance chance;
    std::vector<std::uint64_t> told;
};

class ChanceFile : public testing::Test {
protected:
    ChanceFile() : campaign(measure({.runs = 2, .drums = 2, .strong_s = 0.6})), study(default_study(campaign)) {}

    Counted chance(std::uint64_t campaigns, const std::string& file, const Campaign& of, std::uint64_t seed = 1)
    {
        Counted out;
        Observer observer;
        ChanceOptions options;
        options.campaigns = campaigns;
        options.seed = seed;
        if (!file.empty())
            options.cache = folder / file;
        options.run = {best_isa(), 1};
        out.chance = chance_of(
            of, study, options,
            [&](std::uint64_t n, std::uint64_t cached) {
                if (n > cached) // what the file held is told first
                    out.told.push_back(n);
            },
            observer);
        EXPECT_TRUE(out.chance.complete);
        EXPECT_EQ(out.chance.campaigns, campaigns);
        return out;
    }
    Counted chance(std::uint64_t campaigns, const std::string& file) { return chance(campaigns, file, campaign); }

    MeasuredFolder folder{"chance"};
    Campaign campaign;
    Study study;
};

TEST_F(ChanceFile, GoesOnWhereItWasInterrupted)
{
    const Counted whole = chance(4, "");
    EXPECT_EQ(whole.chance.cached, 0u);
    EXPECT_GT(whole.chance.simulations, 0u);
    EXPECT_EQ(whole.told, (std::vector<std::uint64_t>{1, 2, 3, 4}));
    ASSERT_FALSE(whole.chance.gains.gains().empty());

    const Counted first = chance(2, "kept.txt");
    const std::string after_two = content_of(folder / "kept.txt");
    const Counted rest = chance(4, "kept.txt");
    EXPECT_EQ(rest.chance.cached, 2u);
    EXPECT_EQ(rest.told, (std::vector<std::uint64_t>{3, 4}));
    EXPECT_EQ(rest.chance.simulations, whole.chance.simulations - first.chance.simulations);
    EXPECT_EQ(rest.chance.gains.gains(), whole.chance.gains.gains()); // to the last bit
    EXPECT_EQ(rest.chance.contacts, whole.chance.contacts);
    EXPECT_TRUE(content_of(folder / "kept.txt").starts_with(after_two));

    const Counted kept = chance(4, "kept.txt");
    EXPECT_EQ(kept.chance.cached, 4u);
    EXPECT_EQ(kept.chance.simulations, 0u);
    EXPECT_EQ(kept.chance.gains.gains(), whole.chance.gains.gains());
    // of more than are wanted the first ones are taken
    EXPECT_EQ(chance(2, "kept.txt").chance.gains.gains(), first.chance.gains.gains());
}

TEST_F(ChanceFile, OfSomethingElseIsNotUsed)
{
    chance(1, "kept.txt");
    const auto cached = [&](const Campaign& of, std::uint64_t seed = 1) {
        std::filesystem::copy_file(folder / "kept.txt", folder / "copy.txt",
                                   std::filesystem::copy_options::overwrite_existing);
        return chance(1, "copy.txt", of, seed).chance.cached;
    };
    EXPECT_EQ(cached(campaign), 1u);
    EXPECT_EQ(cached(campaign, 2), 0u);
    Campaign other = campaign;
    other.specimen.mass_kg[0] *= 1.001;
    EXPECT_EQ(cached(other), 0u);
    other = campaign;
    other.runs[1].base_displacement_m.values[100] += 1e-6;
    EXPECT_EQ(cached(other), 0u);
    other = campaign;
    other.runs[0].blocks.x_m.noise_sd = 1e-4;
    EXPECT_EQ(cached(other), 0u);
    // what the cameras saw is no part of it: healthy campaigns do not depend on it
    other = campaign;
    other.runs[0].blocks.x_m.values[100] += 1e-5;
    EXPECT_EQ(cached(other), 1u);
}

TEST_F(ChanceFile, GarbageIsNotUsed)
{
    const Counted two = chance(2, "kept.txt");
    const std::string good = content_of(folder / "kept.txt");
    const std::size_t first_line = good.find('\n') + 1, second_line = good.find('\n', first_line) + 1;
    const auto with = [&](const std::string& text) {
        write_content(folder / "bad.txt", text);
        const Counted counted = chance(2, "bad.txt");
        EXPECT_EQ(counted.chance.gains.gains(), two.chance.gains.gains());
        EXPECT_EQ(content_of(folder / "bad.txt"), good);
        return counted.chance.cached;
    };
    EXPECT_EQ(with(""), 0u);
    EXPECT_EQ(with("nothing of the kind\n"), 0u);
    EXPECT_EQ(with(good.substr(0, first_line) + "garbage\n"), 0u);
    EXPECT_EQ(with(good.substr(0, first_line) + "area\tbalance\tdrag\tmuch\n"), 0u);
    EXPECT_EQ(with(good.substr(0, second_line) + "garbage\twithout\tend"), 1u);
    EXPECT_EQ(with(good.substr(0, second_line)), 1u);
    EXPECT_EQ(with(good.substr(0, good.size() - 4)), 1u); // cut within a number
    EXPECT_EQ(with(good.substr(0, first_line) + "area\tbalance\tdrag\t3.5x\n"), 0u);
    EXPECT_EQ(with(good.substr(0, first_line) + "area\tbalance\tdrag\tnan\n"), 0u);
}

} // namespace
} // namespace stylobate
