/// `stylobate bench`, in its shape and not in its speeds; and what is read of a machine, from made-up files of a
/// system.

#include "studies/workflow/machine_facts.hpp"
#include "tests/program/program.hpp"

namespace stylobate {
namespace {

using JsonKind = JsonValue::Kind;

class Bench : public Program {
protected:
    static void expect_rate(const JsonValue& rate)
    {
        EXPECT_GT(rate["lowest"].number, 0);
        EXPECT_GE(rate["median"].number, rate["lowest"].number);
        EXPECT_GE(rate["highest"].number, rate["median"].number);
        EXPECT_GE(rate["repeats"].number, 1);
    }

    /// Ensembles with one thread and with two.
    static void expect_surface(const JsonValue& surface)
    {
        ASSERT_EQ(surface.items.size(), 2U);
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_EQ(surface.items[i]["threads"].number, static_cast<double>(i + 1));
            EXPECT_EQ(std::fmod(surface.items[i]["realizations"].number, 16), 0) << "whole cells";
            expect_rate(surface.items[i]["realizations_per_s"]);
            expect_rate(surface.items[i]["block_steps_per_s"]);
        }
    }
};

TEST_F(Bench, JsonHasEveryRate)
{
    const Ended ended = run({"bench", "--seconds", "2", "--threads", "2", "--json", "--progress", "json", "--quiet"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    const JsonValue json = json_of(ended), info = json_of(run({"info", "--json"}));
    EXPECT_EQ(json["threads"].number, 2);
    EXPECT_EQ(json["machine"]["processor"].text, info["machine"]["processor"].text);
    EXPECT_GT(json["machine"]["processors"].number, 0);
    ASSERT_EQ(json["instruction_sets"].items.size(), info["simd"].items.size());
    for (std::size_t i = 0; i < info["simd"].items.size(); ++i) {
        const JsonValue& set = json["instruction_sets"].items[i];
        EXPECT_EQ(set["simd"].text, info["simd"].items[i].text);
        for (const char* rate : {"peak_operations_per_s", "steps_block_steps_per_s", "with_all_block_steps_per_s"})
            expect_rate(set[rate]);
        EXPECT_GT(set["of_the_peak"].number, 0);
        expect_surface(set["surface"]);
    }
    ASSERT_EQ(json["structures"].items.size(), 3U);
    for (const JsonValue& structure : json["structures"].items)
        expect_surface(structure["surface"]);
    EXPECT_EQ(names(), Words{}) << "it writes no file";

    const std::string last = ended.err.substr(ended.err.rfind('\n', ended.err.size() - 2) + 1);
    const JsonValue progress = JsonParser::parse(last);
    EXPECT_EQ(progress["unit"].text, "measurements");
    EXPECT_EQ(progress["done"].number, progress["total"].number);
    EXPECT_TRUE(progress["finished"].boolean);
}

/// The head is that of the table in README.md, which has one row for each instruction set.
TEST_F(Bench, RowsAreThoseOfTheTableOfSpeeds)
{
    const Ended ended = run({"bench", "--seconds", "1", "--threads", "1", "--simd", "scalar", "--markdown", "--quiet"});
    ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    EXPECT_EQ(ended.err, "");
    const std::string head = ended.out.substr(0, ended.out.find('\n') + 1);
    EXPECT_NE(read_bytes(STYLOBATE_SOURCE_DIR "/README.md").find("\n" + head), std::string::npos) << head;
    const std::string row = ended.out.substr(ended.out.rfind('\n', ended.out.size() - 2) + 1);
    EXPECT_TRUE(row.starts_with("| " + processor() + " | 1 | scalar | ")) << row;
    EXPECT_EQ(count_of(row, "|"), count_of(head, "|"));
}

TEST_F(Bench, RefusesBadOptions)
{
    expect_refused(Words{"bench", "--seconds", "0"}, {"--seconds 0: a measurement takes 1 to 600 s"});
    expect_refused(Words{"bench", "--seconds", "ten"}, {"--seconds"});
    expect_refused(Words{"bench", "--simd", "neon", "--threads", "0"}, {"--threads"});
    expect_refused(Words{"bench", "--json", "--markdown"}, {"--json", "--markdown"});
    expect_refused(Words{"bench", "study.toml"}, {"study.toml"});
}

/// A folder like the root of a system.
class MachineOf : public Program {
protected:
    void write(const std::string& name, const std::string& content) const
    {
        fs::create_directories((folder / name).parent_path());
        write_bytes(folder / name, content);
    }

    /// Two nodes of four threads on two cores each, and a third one that is memory alone.
    void two_nodes() const
    {
        write("proc/cpuinfo", "processor\t: 0\nvendor_id\t: AuthenticAMD\ncpu family\t: 25\nmodel\t\t: 1\n"
                              "model name\t: AMD EPYC 7763\n\nprocessor\t: 1\nmodel name\t: another\n");
        write("proc/loadavg", "2.50 1.00 0.50 1/200 4711\n");
        const std::string system = "sys/devices/system/";
        write(system + "cpu/online", "0-7\n");
        for (int i = 0; i < 8; ++i)
            write(system + "cpu/cpu" + std::to_string(i) + "/topology/core_cpus_list",
                  std::to_string(i % 4) + "," + std::to_string(i % 4 + 4) + "\n");
        write(system + "cpu/cpu0/cpufreq/scaling_governor", "powersave\n");
        write(system + "node/node0/cpulist", "0-1,4-5\n");
        write(system + "node/node0/meminfo", "Node 0 MemTotal:       1000000 kB\nNode 0 MemFree: 1 kB\n");
        write(system + "node/node1/cpulist", "2-3,6-7\n");
        write(system + "node/node2/cpulist", "\n");
        write(system + "node/possible", "0-2\n");
    }
};

TEST_F(MachineOf, NodesCoresAndLoadAreReadFromTheSystem)
{
    two_nodes();
    const MachineFacts all = machine_facts(folder, {});
    EXPECT_EQ(all.processor, "AMD EPYC 7763 (Zen 3)");
    EXPECT_EQ(all.usable, 8);
    EXPECT_EQ(all.cores, 4);
    ASSERT_EQ(all.nodes.size(), 3U);
    EXPECT_EQ(all.nodes[0].processors, (std::vector<int>{0, 1, 4, 5}));
    EXPECT_EQ(all.nodes[0].memory_bytes, 1.024e9);
    EXPECT_EQ(all.nodes[1].memory_bytes, std::nullopt);
    EXPECT_EQ(all.nodes_used(), 2);
    EXPECT_EQ(all.governor, "powersave");
    EXPECT_EQ(all.load, 2.5);
    EXPECT_TRUE(all.busy()) << "more than half of four cores";
    const std::string text = machine_text(all);
    for (const char* part :
         {"processor: AMD EPYC 7763 (Zen 3); usable here: 4 cores, 8 processors",
          "NUMA node 0: processors 0-1,4-5, 1.0 GB, 4 of them usable here", "NUMA node 2: processors none",
          "governor of the clock: powersave", "load: 2.50", "mpirun -n 2 --map-by ppr:1:numa", "--shard K/2"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    const JsonValue json = JsonParser::parse(machine_json(all).text());
    EXPECT_EQ(json["numa_nodes"].items.size(), 3U);
    EXPECT_EQ(json["numa_nodes"].items[1]["memory_bytes"].kind, JsonKind::null);
    EXPECT_EQ(json["advice"].kind, JsonKind::text);
}

/// The process is bound to one node: nothing is left to advise.
TEST_F(MachineOf, OneNodeInUseNeedsNoAdvice)
{
    two_nodes();
    const MachineFacts bound = machine_facts(folder, {2, 3, 6});
    EXPECT_EQ(bound.usable, 3);
    EXPECT_EQ(bound.cores, 2);
    EXPECT_EQ(bound.nodes[0].usable, 0);
    EXPECT_EQ(bound.nodes[1].usable, 3);
    EXPECT_EQ(numa_advice(bound), std::nullopt);
    EXPECT_EQ(bound.governor, std::nullopt) << "that of its own first processor";
}

TEST_F(MachineOf, WhatASystemDoesNotTellIsLeftOut)
{
    const MachineFacts nothing = machine_facts(folder, {});
    EXPECT_EQ(nothing.processor, "unknown");
    EXPECT_EQ(nothing.cores, std::nullopt);
    EXPECT_FALSE(nothing.busy());
    EXPECT_EQ(numa_advice(nothing), std::nullopt);
    EXPECT_EQ(machine_text(nothing), "processor: unknown\n");
    write("sys/devices/system/node/node0/cpulist", "0-99999999999,x,-3\n"); // no processors of any machine
    write("proc/cpuinfo", ":\nvendor_id: AuthenticAMD\n");
    EXPECT_EQ(machine_facts(folder, {0}).nodes.size(), 1U);
}

} // namespace
} // namespace stylobate
