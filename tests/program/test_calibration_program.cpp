/// `stylobate calibrate`, interrupted once something is kept, and gone on with.

#include "io/measured/campaign_writer.hpp"
#include "tests/ensemble/tracking/synthetic_campaign.hpp"
#include "tests/io/measured/measured_samples.hpp"
#include "tests/program/program.hpp"

#include "io/measured/measured_file.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <thread>

namespace stylobate {
namespace {

class CalibrationProgram : public Program {
protected:
    /// Runs the program and interrupts it as soon as a file of its is larger than so much. @return its exit status
    int interrupted_at(Words words, const fs::path& file, std::uintmax_t bytes, const fs::path& said) const
    {
        words.insert(words.begin(), STYLOBATE_PROGRAM);
        std::vector<char*> argv;
        for (std::string& word : words)
            argv.push_back(word.data());
        argv.push_back(nullptr);
        const pid_t child = ::fork();
        if (child == 0) {
            const int err = ::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
            if (::chdir(folder.c_str()) == 0 && ::dup2(err, STDERR_FILENO) >= 0)
                ::execv(argv[0], argv.data());
            ::_exit(127);
        }
        int status = 0;
        std::error_code absent;
        while (::waitpid(child, &status, WNOHANG) == 0) {
            const std::uintmax_t size = fs::file_size(file, absent);
            if (!absent && size > bytes) {
                ::kill(child, SIGINT);
                ::waitpid(child, &status, 0);
                break;
            }
            std::this_thread::yield();
        }
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
};

TEST_F(CalibrationProgram, WhatAnInterruptKeepsIsSaidAndUsedLong)
{
    SyntheticCampaign c;
    c.runs = 2;
    write_campaign(measure(c), folder / "m.h5");
    const Words words = {"calibrate", "m.h5", "-o", "c.h5", "--threads", "1"};
    const fs::path sets = folder / "c_sets.bin";

    // the first line of the file is there at once; a set of this campaign is some kilobytes
    EXPECT_EQ(interrupted_at(words, sets, 1000, folder / "said.txt"), 130);
    const std::string said = read_bytes(folder / "said.txt");
    EXPECT_NE(said.find("parameter sets are kept in c_sets.bin. The same command continues"), std::string::npos)
        << said;
    EXPECT_TRUE(fs::exists(sets));
    EXPECT_FALSE(fs::exists(folder / "c.h5"));
    EXPECT_FALSE(fs::exists(folder / "c_calibrated.toml"));

    const Ended ended = run(words);
    EXPECT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_NE(ended.out.find("from an earlier run"), std::string::npos) << ended.out;
    fs::remove(folder / "said.txt");
    EXPECT_EQ(names(), (Words{"c.h5", "c_calibrated.toml", "m.h5"}));

    // in one go: the same results
    const Ended again = run({"calibrate", "m.h5", "-o", "d.h5", "--threads", "1", "--quiet"});
    EXPECT_EQ(again.status, 0) << testing::PrintToString(again);
    EXPECT_NE(again.out.find("d_calibrated.toml: the calibrated study"), std::string::npos) << again.out;
    EXPECT_EQ(again.err, "");
    EXPECT_EQ(read_bytes(folder / "c_calibrated.toml"), read_bytes(folder / "d_calibrated.toml"));
}

} // namespace
} // namespace stylobate
