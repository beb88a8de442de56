#include "studies/workflow/machine_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <system_error>
#ifdef __linux__
#include <sched.h>
#endif

namespace stylobate {

namespace {

namespace fs = std::filesystem;

/// The microarchitecture of AMD's processors, whose model names often leave it out ("AMD EPYC"); empty: not known.
/// @param family, model as in /proc/cpuinfo. Source: Linux 6.7, arch/x86/kernel/cpu/amd.c, `bsp_init_amd`
std::string amd_microarchitecture(int family, int model)
{
    const auto within = [model](int from, int to) { return model >= from && model <= to; };
    if (family == 0x17)
        return within(0x00, 0x2f) || within(0x50, 0x5f) ? "Zen" : "Zen 2";
    if (family == 0x19)
        return within(0x00, 0x0f) || within(0x20, 0x5f) ? "Zen 3" : "Zen 4";
    if (family == 0x1a && (within(0x00, 0x2f) || within(0x40, 0x4f) || within(0x70, 0x7f)))
        return "Zen 5";
    return "";
}

/// The first line of a file of the system; nullopt: it is not there, or empty.
std::optional<std::string> first_line(const fs::path& file)
{
    std::ifstream in(file);
    std::string line;
    return std::getline(in, line) && !line.empty() ? std::optional(line) : std::nullopt;
}

/// A list of the system: "0-3,8".
std::vector<int> numbers_of(const std::string& list)
{
    constexpr int most = 1 << 16; // a file is no reason for a loop without end
    std::vector<int> numbers;
    std::istringstream parts(list);
    for (std::string part; std::getline(parts, part, ',');) {
        int from = 0, to = 0;
        char dash = 0;
        std::istringstream in(part);
        if (!(in >> from))
            continue;
        to = in >> dash >> to && dash == '-' ? to : from;
        for (int i = std::max(from, 0); i <= std::min(to, most); ++i)
            numbers.push_back(i);
    }
    return numbers;
}

/// "Node 0 MemTotal:       13592780 kB"
std::optional<double> memory_of_node(const fs::path& node)
{
    std::ifstream in(node / "meminfo");
    for (std::string line; std::getline(in, line);)
        if (const auto at = line.find("MemTotal:"); at != std::string::npos) {
            std::istringstream rest(line.substr(at + 9));
            double kilobytes = 0;
            return rest >> kilobytes ? std::optional(1024 * kilobytes) : std::nullopt;
        }
    return std::nullopt;
}

std::vector<NumaNode> nodes_in(const fs::path& folder, const std::set<int>& usable)
{
    std::vector<NumaNode> nodes;
    std::error_code absent;
    for (const auto& entry : fs::directory_iterator(folder, absent)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with("node") || name.find_first_not_of("0123456789", 4) != std::string::npos ||
            name.size() < 5)
            continue;
        NumaNode node{.number = numbers_of(name.substr(4)).front(),
                      .processors = numbers_of(first_line(entry.path() / "cpulist").value_or("")),
                      .memory_bytes = memory_of_node(entry.path())};
        node.usable =
            static_cast<int>(std::ranges::count_if(node.processors, [&](int one) { return usable.contains(one); }));
        nodes.push_back(std::move(node));
    }
    std::ranges::sort(nodes, {}, &NumaNode::number);
    return nodes;
}

/// Cores of these processors: those with the same list of siblings are threads of one.
std::optional<int> cores_of(const fs::path& folder, const std::set<int>& usable)
{
    std::set<std::string> lists;
    for (const int one : usable) {
        const fs::path topology = folder / fmt::format("cpu{}", one) / "topology";
        auto list = first_line(topology / "core_cpus_list");
        if (!list) // before Linux 5.0
            list = first_line(topology / "thread_siblings_list");
        if (!list)
            return std::nullopt;
        lists.insert(*list);
    }
    return lists.empty() ? std::nullopt : std::optional(static_cast<int>(lists.size()));
}

/// Processors of a node as few ranges: "0-7,16-23".
std::string ranges_text(const std::vector<int>& numbers)
{
    std::string text;
    for (std::size_t i = 0, end = 0; i < numbers.size(); i = end) {
        for (end = i + 1; end < numbers.size() && numbers[end] == numbers[end - 1] + 1;)
            ++end;
        text += fmt::format("{}{}", text.empty() ? "" : ",", numbers[i]);
        if (end - i > 1)
            text += fmt::format("-{}", numbers[end - 1]);
    }
    return text;
}

} // namespace

int MachineFacts::nodes_used() const
{
    return static_cast<int>(std::ranges::count_if(nodes, [](const NumaNode& node) { return node.usable > 0; }));
}

std::set<int> usable_processors()
{
    std::set<int> usable;
#ifdef __linux__
    std::vector<cpu_set_t> sets(64); // 65,536 processors
    const std::size_t bytes = sets.size() * sizeof(cpu_set_t);
    if (sched_getaffinity(0, bytes, sets.data()) == 0)
        for (int i = 0; i < static_cast<int>(8 * bytes); ++i)
            if (CPU_ISSET_S(static_cast<std::size_t>(i), bytes, sets.data()))
                usable.insert(i);
#endif
    return usable;
}

std::string processor(const fs::path& root)
{
    std::map<std::string, std::string> facts;
    std::ifstream info(root / "proc/cpuinfo");
    for (std::string line; std::getline(info, line) && !line.empty();) // of the first core
        if (const auto colon = line.find(':'); colon != std::string::npos && colon > 0)
            facts[line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1)] =
                colon + 2 < line.size() ? line.substr(colon + 2) : "";
    std::string name = facts.contains("model name") ? facts["model name"] : "unknown";
    const auto number = [&](const char* key) {
        const std::vector<int> numbers = numbers_of(facts[key]);
        return numbers.empty() ? -1 : numbers.front();
    };
    if (facts["vendor_id"] == "AuthenticAMD")
        if (const std::string kind = amd_microarchitecture(number("cpu family"), number("model")); !kind.empty())
            name += " (" + kind + ")";
    return name;
}

MachineFacts machine_facts(const fs::path& root, const std::set<int>& usable)
{
    MachineFacts machine{.processor = processor(root)};
    const fs::path cpus = root / "sys/devices/system/cpu";
    std::set<int> ours = usable;
    if (ours.empty())
        for (const int one : numbers_of(first_line(cpus / "online").value_or("")))
            ours.insert(one);
    machine.usable = static_cast<int>(ours.size());
    machine.cores = cores_of(cpus, ours);
    machine.nodes = nodes_in(root / "sys/devices/system/node", ours);
    if (!ours.empty())
        machine.governor = first_line(cpus / fmt::format("cpu{}/cpufreq/scaling_governor", *ours.begin()));
    if (const auto line = first_line(root / "proc/loadavg")) {
        std::istringstream in(*line);
        double load = 0;
        if (in >> load)
            machine.load = load;
    }
    return machine;
}

std::string machine_text(const MachineFacts& m)
{
    std::string text = "processor: " + m.processor;
    if (m.usable > 0)
        text += fmt::format("; usable here: {}{}", m.cores ? fmt::format("{} cores, ", *m.cores) : "",
                            fmt::format("{} processors as the system counts them", m.usable));
    text += "\n";
    if (m.nodes.size() == 1)
        text += "NUMA nodes: 1\n";
    for (const NumaNode& node : m.nodes)
        if (m.nodes.size() > 1)
            text +=
                fmt::format("NUMA node {}: processors {}{}, {} of them usable here\n", node.number,
                            node.processors.empty() ? "none" : ranges_text(node.processors),
                            node.memory_bytes ? fmt::format(", {:.1f} GB", *node.memory_bytes / 1e9) : "", node.usable);
    if (m.governor)
        text += fmt::format("governor of the clock: {}\n", *m.governor);
    if (m.load)
        text += fmt::format("load: {:.2f} (mean of the last minute)\n", *m.load);
    if (const std::optional<std::string> advice = numa_advice(m))
        text += *advice + "\n";
    return text;
}

Json machine_json(const MachineFacts& m)
{
    Json json = Json::object();
    json.member("processor", m.processor).member("processors", m.usable);
    add_member(json, "cores", m.cores);
    json.member("numa_nodes", json_list(m.nodes, [](const NumaNode& node) {
                    Json one = Json::object();
                    one.member("number", node.number)
                        .member("processors", json_of(node.processors))
                        .member("usable_processors", node.usable);
                    add_member(one, "memory_bytes", node.memory_bytes);
                    return one;
                }));
    m.governor ? json.member("governor", *m.governor) : json.member_as_is("governor", "null");
    add_member(json, "load", m.load);
    json.member("busy", m.busy());
    const std::optional<std::string> advice = numa_advice(m);
    return advice ? json.member("advice", *advice) : json.member_as_is("advice", "null");
}

std::optional<std::string> numa_advice(const MachineFacts& machine)
{
    const int nodes = machine.nodes_used();
    if (nodes < 2)
        return std::nullopt;
    return fmt::format("This process may run on {0} NUMA nodes. One process for each keeps threads beside their "
                       "memory: `mpirun -n {0} --map-by ppr:1:numa --bind-to numa stylobate run STUDY.toml --mpi`, or "
                       "on each node N `numactl --cpunodebind=N --membind=N stylobate run STUDY.toml --shard K/{0}`, "
                       "then `stylobate merge`. Both give the bytes of one run (docs/clusters.md).",
                       nodes);
}

} // namespace stylobate
