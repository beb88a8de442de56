/// Bad input: one message that says where, what, and what to do; exit status 2; nothing written or changed.

#include "ensemble/planar/device/device.hpp"
#include "tests/program/program.hpp"

#include "io/store/result_store.hpp"
#include "io/study/study_file.hpp"

#include <random>

namespace stylobate {
namespace {

class Faults : public Program {
protected:
    /// The main study with one line changed, as study.toml.
    void write_study(const std::string& line, const std::string& changed) const
    {
        std::string text = read_bytes(column_study);
        const std::size_t at = text.find("\n" + line);
        ASSERT_NE(at, std::string::npos) << line;
        text.replace(at + 1, line.size(), changed);
        write_bytes(folder / "study.toml", text);
    }

    /// Where a line is in the main study: "study.toml:41".
    static std::string place(const std::string& line)
    {
        const std::string text = read_bytes(column_study);
        const std::size_t at = text.find("\n" + line);
        EXPECT_NE(at, std::string::npos) << line;
        return "study.toml:" + std::to_string(count_of(text.substr(0, at + 1), "\n") + 1);
    }

    void write_results(const Words& more = {}) const
    {
        const Ended ended = run(run_words(column_study, eight_realizations, more));
        ASSERT_EQ(ended.status, 0) << testing::PrintToString(ended);
    }

    static Words words_for(const Words& settings, const Words& more = {"-o", "out.h5"})
    {
        return run_words(column_study, settings, more);
    }

    /// Settings of a small study under the record in the folder.
    static Words under(const std::string& record)
    {
        Words settings = two_under_a_record;
        settings.push_back("excitation.file=" + record);
        return run_words(record_study, settings, {"-o", "out.h5"});
    }
};

TEST_F(Faults, WrongLinesOfAStudy)
{
    struct Case {
        std::string line, changed;
        Words parts;
    };
    const Case cases[] = {
        {"friction = 0.68", "fricton = 0.68", {"fricton", "Did you mean friction"}},
        {"drum_width_m = 0.048", "drum_width = 0.048", {"drum_width", "drum_width_m"}},
        {"drum_width_m = 0.048", "drum_width_mm = 48", {"drum_width_mm", "drum_width_m"}},
        {"blocks = 7", "blocks = \"seven\"", {"structure.blocks", "\"seven\"", "[1, "}},
        {"blocks = 7", "blocks = 7.5", {"structure.blocks", "7.5", "whole number"}},
        {"drum_height_m = 0.029", "drum_height_m = -0.029", {"drum_height_m", "-0.029", "(0, 40]"}},
        {"drum_height_m = 0.029", "drum_height_m = 290", {"drum_height_m", "290", "(0, 40]", "0.290", "2.9"}},
        {"drum_mass_kg = 0.1355", "drum_mass_kg = nan", {"drum_mass_kg", "nan"}},
        {"realizations = 256", "realizations = 0", {"study.realizations", "0", "[1, "}},
        {"realizations = 256", "realizations = -1", {"study.realizations", "-1", "[1, "}},
        {"kind = \"surface\"", "kind = \"surfaces\"", {"study.kind", "surfaces", "surface"}},
        {"friction = 0.68", "friction = 0.68 0.7", {}},
        {"friction = 0.68", "friction = 0.68\nfriction = 0.7", {"friction"}},
        {"[contact]", "[contacts]", {"contacts", "contact"}},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.changed);
        write_study(c.line, c.changed);
        Words parts = c.parts;
        // the line it stands in; of a key that comes twice, the second one
        if (c.changed.find('\n') == std::string::npos)
            parts.push_back(place(c.line) + ": ");
        expect_refused({"run", "study.toml", "-o", "out.h5"}, parts);
    }
}

TEST_F(Faults, WrongSettings)
{
    for (const auto& [setting, parts] : std::vector<std::pair<std::string, Words>>{
             {"study.realisations=2", {"realisations", "Did you mean realizations"}},
             {"study.realizations=0", {"study.realizations = 0", "[1, "}},
             {"contact.friction=much", {"contact.friction", "much"}},
             {"friction", {"friction", "KEY=VALUE"}},
             {"structure.drum_width_m=48", {"drum_width_m = 48", "(0, 40]", "0.048"}},
             {"structure.drum_height_m=29", {"drum_height_m", "= 29 is in metres", "mm (0.029 m)", "study.allow"}},
             {"run.step_s=5e-4", {"run.step_s = 0.0005", "safe bound", "run.allow_step_above_bound"}},
             {"excitation.kind=record", {"excitation.start", "not used", "record"}},
         }) {
        SCOPED_TRACE(setting);
        expect_refused(words_for({setting}), parts);
    }
}

TEST_F(Faults, StudiesThatAreNone)
{
    write_bytes(folder / "empty.toml", "");
    write_bytes(folder / "binary.toml", std::string("\x7f"
                                                    "ELF\x02\x01\x00\x00",
                                                    8));
    expect_refused({"run", "nowhere.toml"}, {"nowhere.toml", "No such file"});
    expect_refused({"run", "."}, {"folder"});
    expect_refused({"run", "empty.toml"}, {"empty.toml"});
    expect_refused({"run", "binary.toml"}, {"binary.toml"});
}

TEST_F(Faults, WrongCommandLines)
{
    write_results({"-o", "out.h5"});
    expect_refused(Words{}, {"command", "run, merge, check, compare, replay, verify-file, record, calibrate, diagnose, "
                                        "risk, past, export, report, new, "
                                        "schema, info"});
    expect_refused({"rum", column_study}, {"'rum'", "Did you mean run"});
    expect_refused({"simulate"}, {"'simulate'"});
    expect_refused({"run"}, {"STUDY", "stylobate run --help"});
    expect_refused({"run", column_study, "--outptu", "x.h5"}, {"--outptu", "stylobate run --help"});
    expect_refused({"run", column_study, "another.toml"}, {"another.toml"});
    expect_refused({"run", column_study, "--simd", "avx51"}, {"--simd", "avx51", "avx512"});
    expect_refused({"run", column_study, "--threads", "0"}, {"--threads", "0", "1"});
    expect_refused({"run", column_study, "--threads", "two"}, {"--threads", "two"});
    expect_refused({"run", column_study, "--backend", "gpu"}, {"--backend", "gpu", "cpu", "cuda"});
    expect_refused({"replay", "out.h5", "--realization", "0", "--backend", "cuda"}, {"--backend", "cuda", "cpu"});
    expect_refused({"run", STYLOBATE_SOURCE_DIR "/studies/inputs/twins_column.toml", "--backend", "cuda"},
                   {"--backend cuda", "[twins]"});
    if (const CudaDevices gpus = cuda_devices(); gpus.names.empty())
        expect_refused({"run", column_study, "--backend", "cuda"}, {"--backend cuda", gpus.reason});
    expect_refused({"replay", "out.h5"}, {"--realization"});
    expect_refused({"replay", "out.h5", "--realization", "8"}, {"--realization 8", "0 to 7", "out.h5"});
    expect_refused({"replay", "out.h5", "--realization", "-1"}, {"--realization -1", "0 to 7"});
    expect_refused({"replay", "out.h5", "--realization", "1.5"}, {"--realization", "1.5"});
    expect_refused({"replay", "out.h5", "--realization", "99999999999999999999"},
                   {"--realization: 99999999999999999999 is not a whole number in [-9223372036854775808, "});
    expect_refused({"replay", "out.h5", "--nth", "1e30"}, {"--nth: 1e30 is not a whole number in ["});
    expect_refused({"verify-file", "out.h5", "--seed", "18446744073709551616"},
                   {"--seed: 18446744073709551616 is not a whole number in [0, 18446744073709551615]"});
    expect_refused({"verify-file", "out.h5", "--seed", "-1"}, {"--seed: -1 is not a whole number in [0, "});
    expect_refused({"export", "out.h5"}, {"--to"});
    expect_refused({"export", "out.h5", "--to", "bmp"}, {"bmp", "csv", "png", "svg", "pdf"});
    expect_refused({"export", "out.h5", "--to", "png", "--picture", "cake"}, {"cake", "strip"});
    expect_refused({"export", "out.h5", "--to", "png", "--realization", "8"}, {"--realization 8", "0 to 7"});
    expect_refused({"export", "out.h5", "--to", "png", "--realization", "-3"}, {"--realization", "-3"});
    expect_refused({"export", "out.h5", "--to", "png", "--picture", "slice", "--frequency", "nan"}, {"frequency"});
    expect_refused({"export", "out.h5", "--to", "png", "--picture", "slice", "--frequency", "fast"}, {"fast"});
    expect_refused({"record"}, {"FILE"});
}

TEST_F(Faults, OutputsThatCannotBeWritten)
{
    write_results({"-o", "out.h5"});
    write_bytes(folder / "file", "not a folder");
    for (const auto& [output, parts] :
         std::vector<std::pair<std::string, Words>>{{"nowhere/a.h5", {"nowhere", "no such folder"}},
                                                    {"file/a.h5", {"file", "not a folder"}},
                                                    {".", {"folder"}}})
        expect_refused(words_for(eight_realizations, {"-o", output}), parts);
    expect_refused({"replay", "out.h5", "--realization", "0", "-o", "nowhere/t.h5"}, {"nowhere", "no such folder"});
    expect_refused({"replay", "out.h5", "--realization", "0", "-o", "out.h5"}, {"out.h5", "the input file"});
    expect_refused({"export", "out.h5", "--to", "png", "-o", "nowhere/a.png"}, {"nowhere/a.png"});
    expect_refused({"export", "out.h5", "--to", "png", "-o", "./out.h5"}, {"out.h5", "the input file"});
    expect_refused({"export", "out.h5", "--to", "csv", "-o", "nowhere/a"}, {"nowhere/a", "no such folder 'nowhere'"});
    expect_refused({"export", "out.h5", "--to", "vtk", "-o", "nowhere/a"}, {"nowhere/a", "no such folder 'nowhere'"});
    expect_refused({"export", "out.h5", "--to", "html", "-o", "nowhere/a.html"}, {"no such folder 'nowhere'"});
    expect_refused({"report", "out.h5", "-o", "nowhere/a.html"}, {"nowhere/a.html", "no such folder 'nowhere'"});
    expect_refused({"new", "single", "-o", "nowhere/a.toml"}, {"nowhere/a.toml", "no such folder 'nowhere'"});
    for (const Words& words :
         {Words{"export", "out.h5", "--to", "png", "-o", "file/a.png"}, Words{"report", "out.h5", "-o", "file/a.html"},
          Words{"new", "single", "-o", "file/a.toml"}, Words{"export", "out.h5", "--to", "csv", "-o", "file/a"}})
        expect_refused(words, {"file' is a file, not a folder"});
    fs::create_directory(folder / "folder.html");
    expect_refused({"report", "out.h5", "-o", "folder.html"}, {"folder.html", "it is a folder"});
    expect_refused({"export", "out.h5", "--to", "csv", "-o", "file"}, {"file"});
    expect_refused({"export", "out.h5", "--to", "csv", "-o", "out.h5"}, {"out.h5"});
}

TEST_F(Faults, WhatThePermissionsForbid)
{
    if (::geteuid() == 0 && ::prctl(PR_CAPBSET_READ, 8) != 1)
        GTEST_SKIP() << "permissions do not bind this user";
    write_results({"-o", "out.h5"});
    write_bytes(folder / "study.toml", read_bytes(column_study));
    write_bytes(folder / "record.at2", Burst{}.at2());
    fs::create_directory(folder / "closed");
    fs::permissions(folder / "closed", fs::perms::owner_read | fs::perms::owner_exec);
    const auto refuse = [&](const Words& words, const Words& parts) {
        expect_refused({.arguments = words, .no_privilege = true}, parts);
    };
    refuse(words_for(eight_realizations, {"-o", "closed/a.h5"}), {"closed", "cannot be written", "Permission denied"});
    refuse({"replay", "out.h5", "--realization", "0", "-o", "closed/t.h5"}, {"closed", "Permission denied"});
    refuse({"export", "out.h5", "--to", "png", "-o", "closed/a.png"}, {"closed/a.png", "Permission denied"});
    refuse({"export", "out.h5", "--to", "csv", "-o", "closed/a"}, {"closed/a", "Permission denied"});
    // where no output is given, the folder that is closed is the working folder: it is named
    const fs::path above = folder / "closed";
    fs::permissions(above, fs::perms::owner_all);
    for (const char* file : {"study.toml", "record.at2", "out.h5"})
        fs::copy_file(folder / file, above / file);
    fs::permissions(above, fs::perms::owner_read | fs::perms::owner_exec);
    const std::string named = fs::canonical(above).string();
    for (const Words& words :
         {Words{"run", "study.toml"}, Words{"new", "single"}, Words{"report", "out.h5"},
          Words{"export", "out.h5", "--to", "png"}, Words{"export", "out.h5", "--to", "csv"},
          Words{"export", "out.h5", "--to", "vtk"}, Words{"replay", "out.h5", "--realization", "0", "-o", "t.h5"},
          Words{"merge", "out.h5", "-o", "m.h5", "--partial"}}) {
        const Ended ended = run_program({.arguments = words, .no_privilege = true}, above);
        EXPECT_EQ(ended.status, 2) << words.front() << testing::PrintToString(ended);
        if (words.front() != "merge") { // refuses what is no shard before
            EXPECT_NE(ended.err.find(named), std::string::npos) << words.front() << testing::PrintToString(ended);
        }
        EXPECT_EQ(ended.err.find("stylobate: .:"), std::string::npos) << ended.err;
    }
    for (const char* file : {"study.toml", "record.at2", "out.h5"})
        fs::permissions(folder / file, fs::perms::none);
    // (a snapshot of the folder still reads them where the test itself has the privilege; else the files are left out)
    if (::geteuid() != 0)
        return;
    refuse({"run", "study.toml"}, {"study.toml", "Permission denied"});
    refuse({"record", "record.at2"}, {"record.at2", "permissions"});
    refuse(under("record.at2"), {"record.at2", "permissions"});
    refuse({"replay", "out.h5", "--realization", "0"}, {"out.h5", "Permission denied"});
    refuse(words_for(eight_realizations), {"out.h5", "Permission denied"});
}

TEST_F(Faults, RecordsThatCannotBeRead)
{
    const std::string good = Burst{}.at2();
    const auto with = [&](const std::string& part, const std::string& other) {
        std::string text = good;
        EXPECT_NE(text.find(part), std::string::npos);
        return text.replace(text.find(part), part.size(), other);
    };
    const auto line_in = [&](const std::string& file) { return file + ":4: "; };
    fs::create_directory(folder / "folder");
    struct Case {
        std::string file, content;
        Words parts;
    };
    for (const Case& c : {
             Case{"cut.at2", good.substr(0, good.size() / 2), {line_in("cut.at2"), "NPTS", "1001", "truncated"}},
             Case{"cut_number.at2", good.substr(0, good.size() - 8), {"cut_number.at2"}},
             Case{"fewer.at2", with("NPTS= 1001", "NPTS= 1000"), {line_in("fewer.at2"), "1000", "1001"}},
             Case{"more.at2", with("NPTS= 1001", "NPTS= 2000"), {line_in("more.at2"), "2000", "1001", "truncated"}},
             Case{"none.at2", with("NPTS= 1001", "NPTS= 0"), {line_in("none.at2"), "NPTS"}},
             Case{"unit.at2", with("UNITS OF G", "UNITS OF CM"), {"unit.at2:3: ", "cm"}},
             Case{"dt.at2", with("DT= 0.0100", "DT= 10"), {line_in("dt.at2"), "10"}},
             Case{"nan.at2", with("0.0000000E+00", "          nan"), {"nan.at2", "nan"}},
             Case{"letters.at2", good + "and so on\n", {"letters.at2", "and"}},
             Case{"empty.at2", "", {"empty.at2"}},
             Case{"binary.at2", std::string(1000, '\0'), {"binary.at2"}},
             Case{"prose.txt", "This is no record.\nIt has two lines.\n", {"prose.txt"}},
             Case{"plain.txt", Burst{}.columns(), {"plain.txt", "unit", "cm/s2"}},
         }) {
        SCOPED_TRACE(c.file);
        write_bytes(folder / c.file, c.content);
        expect_refused({"record", c.file}, c.parts);
        expect_refused({"record", c.file, "--json"}, c.parts);
        expect_refused(under(c.file), c.parts);
    }
    expect_refused({"record", "nowhere.at2"}, {"nowhere.at2", "no such file"});
    expect_refused({"record", "folder"}, {"folder"});
    expect_refused(under("nowhere.at2"), {"nowhere.at2", "no such file", "--set excitation.file=PATH"});
    expect_refused(under("folder"), {"folder"});
    // one bad file among good ones: its message, and the answers of the others
    write_bytes(folder / "good.at2", good);
    for (const Words& files : {Words{"record", "good.at2", "cut.at2"}, {"record", "cut.at2", "good.at2"}}) {
        const Ended mixed = run(files);
        EXPECT_EQ(mixed.status, 2);
        EXPECT_NE(mixed.err.find("cut.at2"), std::string::npos) << mixed.err;
        EXPECT_EQ(mixed.err.find("good.at2"), std::string::npos) << mixed.err;
        EXPECT_NE(mixed.out.find("good.at2\n"), std::string::npos) << mixed.out;
        EXPECT_NE(mixed.out.find("PGA "), std::string::npos) << mixed.out;
    }
    const Ended both = run(Words{"record", "cut.at2", "cut.at2"}); // a message for each
    EXPECT_EQ(both.status, 2) << both.err;
    EXPECT_EQ(both.out, "") << both.out;
    EXPECT_EQ(count_of(both.err, "stylobate: cut.at2:"), 2U) << both.err;
    expect_refused({"record", "good.at2", "--component", "360"}, {"good.at2", "360", "090"});
    expect_refused({"record", "good.at2", "--unit", "cm/s2"}, {"good.at2", "cm/s2", "g"});
    expect_refused({"record", "good.at2", "--unit", "furlong"}, {"furlong", "m/s2"});
    Words contradiction = under("good.at2");
    contradiction.insert(contradiction.end(), {"--set", "excitation.unit=m/s2"});
    expect_refused(contradiction, {"good.at2", "m/s2", "g"});
}

TEST_F(Faults, ResultsOfAnotherStudyAndCompleteOnes)
{
    write_results({"-o", "out.h5"});
    const auto complete = contents();
    const Ended again = run(words_for(eight_realizations)); // nothing is left to do, and that is no mistake
    EXPECT_EQ(again.status, 0) << testing::PrintToString(again);
    EXPECT_NE(again.out.find("already complete"), std::string::npos) << again.out;
    EXPECT_TRUE(contents() == complete);
    Words other = eight_realizations;
    other.push_back("contact.friction=0.7");
    expect_refused(words_for(other), {"out.h5", "another study", "friction = 0.68", "friction = 0.7"});
    other.back() = "study.seed=2";
    expect_refused(words_for(other), {"out.h5", "another study", "seed = 1", "seed = 2"});
    write_bytes(folder / "notes.h5", "my notes");
    expect_refused(words_for(eight_realizations, {"-o", "notes.h5"}), {"notes.h5", "is not a results file"});
    write_bytes(folder / "empty.h5", "");
    expect_refused(words_for(eight_realizations, {"-o", "empty.h5"}), {"empty.h5", "is empty", "results file"});
    for (const Words& words : {Words{"replay", "notes.h5", "--realization", "0"},
                               Words{"export", "notes.h5", "--to", "csv"}, Words{"export", "notes.h5", "--to", "png"}})
        expect_refused(words, {"notes.h5", "is not a results file"});
    for (const Words& words :
         {Words{"replay", "none.h5", "--realization", "0"}, Words{"export", "none.h5", "--to", "csv"}})
        expect_refused(words, {"none.h5", "no such file"});
    const std::string rocking = STYLOBATE_SOURCE_DIR "/studies/inputs/free_rocking.toml";
    ASSERT_EQ(run({"run", rocking, "-o", "single.h5"}).status, 0);
    expect_refused({"export", "single.h5", "--to", "png", "--picture", "surface"},
                   {"single.h5", "single", "strip", "of a surface"});
}

TEST_F(Faults, DamagedResults)
{
    write_results({"-o", "good.h5"});
    const std::string good = read_bytes(folder / "good.h5");
    std::mt19937_64 random(5);
    for (int i = 0; i < 20; ++i) {
        std::string bad = good;
        if (i % 4 == 0)
            bad.resize(random() % good.size());
        else
            bad[random() % bad.size()] ^= static_cast<char>(1u << random() % 8);
        write_bytes(folder / "bad.h5", bad);
        expect_refused({"replay", "bad.h5", "--realization", "3"}, {"bad.h5"});
        expect_refused({"export", "bad.h5", "--to", "csv"}, {"bad.h5"});
        expect_refused(words_for(eight_realizations, {"-o", "bad.h5"}), {"bad.h5"});
    }
}

/// Malformed files in bulk, from a fixed seed.
class Malformed : public Program {
protected:
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

    static std::vector<std::string> lines_of(const std::string& text)
    {
        std::vector<std::string> lines;
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
            lines.push_back(text.substr(begin, end - begin));
            begin = end;
        }
        return lines;
    }
    static std::string joined(const std::vector<std::string>& lines)
    {
        std::string text;
        for (const std::string& line : lines)
            text += line;
        return text;
    }

    std::string flipped(std::string text)
    {
        for (std::size_t n = 1 + below(3); n > 0; --n)
            text[below(text.size())] ^= static_cast<char>(1u << below(8));
        return text;
    }
    /// Two words, each in its place: what stands before and after the blank or "=" of two lines.
    std::string swapped(const std::string& text)
    {
        std::vector<std::string> lines = lines_of(text);
        std::string &a = lines[below(lines.size())], &b = lines[below(lines.size())];
        const bool values = below(2) == 0;
        const auto cut = [&](const std::string& line) {
            const std::size_t at = line.find(" = ");
            return at == std::string::npos ? line.size() / 2 : at;
        };
        const std::size_t i = cut(a), j = cut(b);
        if (&a == &b)
            return text;
        const std::string tail_a = a.substr(i), tail_b = b.substr(j);
        a.resize(i);
        b.resize(j);
        if (values) {
            a += tail_b;
            b += tail_a;
        } else {
            std::swap(a, b);
            a += tail_a;
            b += tail_b;
        }
        return joined(lines);
    }
    std::string line_lost_or_doubled(const std::string& text)
    {
        std::vector<std::string> lines = lines_of(text);
        const auto at = lines.begin() + static_cast<std::ptrdiff_t>(below(lines.size()));
        if (below(2) == 0)
            lines.erase(at);
        else
            lines.insert(at, std::string(*at));
        return joined(lines);
    }
    std::string mutated(const std::string& text, int how)
    {
        switch (how % 4) {
        case 0:
            return text.substr(0, below(text.size()));
        case 1:
            return flipped(text);
        case 2:
            return swapped(text);
        default:
            return line_lost_or_doubled(text);
        }
    }

    std::mt19937_64 random_{20240918};
};

TEST_F(Malformed, Studies)
{
    const std::string good = R"([study]
kind = "surface"
seed = 7
realizations = 3
[structure]
kind = "column"
blocks = 3
fixed_blocks = 1
drum_width_m = 0.048
drum_height_m = 0.029
depth_m = 0.05
drum_mass_kg = 0.1355
[contact]
normal_stiffness_n_m2 = 1e6
tangential_stiffness_n_m = 4.8e4
normal_damping_ratio = 0.1
tangential_damping_ratio = 0.2
friction = 0.68
[excitation]
kind = "harmonic"
start = "smooth"
end = "abrupt"
ramp_cycles = 1
cycles = 3
[surface]
frequency_hz = { from = 5.0, to = 8.0, count = 2, spacing = "log" }
pga_m_s2 = { from = 3.0, to = 9.0, count = 2, spacing = "linear" }
[perturbation]
friction = { distribution = "normal", cov = 0.10, min = 0.3, per = "joint" }
normal_stiffness = { distribution = "lognormal", sigma_ln = 0.3, per = "structure" }
drum_offset = { distribution = "normal", sd_m = 0.0002, per = "block" }
phase = { distribution = "uniform", per = "structure" }
[outcome]
collapse = { height_fraction = 0.6 }
)";
    int refused = 0, done = 0;
    for (int i = 0; i < 120; ++i) {
        const std::string text = i == 0 ? good : mutated(good, i);
        write_bytes(folder / "study.toml", text);
        const auto before = contents();
        ProgramRun program{.arguments = {"run", "study.toml", "-o", "out.h5", "--json", "--threads", "2"}};
        program.signal = SIGINT; // some become long
        program.when = when_there(folder / "out.h5");
        const Ended ended = run(program);
        SCOPED_TRACE("study " + std::to_string(i) + ":\n" + text + "\n" + testing::PrintToString(ended));
        if (ended.status == 2) {
            ++refused;
            ASSERT_EQ(ended.out, "");
            expect_one_message(ended.err, ended.err);
            EXPECT_NE(ended.err.find("study.toml"), std::string::npos);
            ASSERT_TRUE(contents() == before);
            continue;
        }
        ASSERT_TRUE(ended.status == 0 || ended.status == 3 || ended.status == 130);
        ++done;
        // what was run is what the file says, all of it and no more
        ASSERT_EQ(names(), (Words{"out.h5", "study.toml"}));
        const Study study = parse_study(text, "study.toml");
        const ResultReader reader(folder / "out.h5");
        EXPECT_EQ(reader.header().study_toml, study.text);
        EXPECT_EQ(reader.header().total, study.total());
        EXPECT_EQ(reader.complete(), ended.status != 130);
        const JsonValue json = json_of(ended);
        EXPECT_EQ(json["total"].number, static_cast<double>(study.total()));
        for (const ResultRow& row : reader.rows())
            EXPECT_TRUE(row.outcome.state == State::invalid || (std::isfinite(row.outcome.peak_top_displacement_m) &&
                                                                std::isfinite(row.outcome.energy_residual)));
        fs::remove(folder / "out.h5");
    }
    EXPECT_GT(refused, 60);
    EXPECT_GT(done, 5); // such as a changed digit
}

TEST_F(Malformed, Records)
{
    Burst burst;
    burst.samples = 151;
    burst.width_s = 0.4;
    const std::string good_at2 = burst.at2(), good_columns = burst.columns();
    int refused = 0, read = 0;
    for (int i = 0; i < 160; ++i) {
        const bool at2 = i % 2 == 0;
        const std::string& good = at2 ? good_at2 : good_columns;
        const std::string text = i < 2 ? good : mutated(good, i / 2);
        const std::string file = at2 ? "record.at2" : "record.txt";
        write_bytes(folder / file, text);
        Words words = {"record", file, "--json"};
        Words settings = two_under_a_record;
        settings.push_back("excitation.file=" + file);
        if (!at2) {
            words.insert(words.end(), {"--unit", "m/s2"});
            settings.push_back("excitation.unit=m/s2");
        }
        const auto before = contents();
        const Ended ended = run(words);
        SCOPED_TRACE("record " + std::to_string(i) + ":\n" + text + "\n" + testing::PrintToString(ended));
        ASSERT_TRUE(contents() == before);
        // a file of stated length is never taken for a whole one when it is cut, and no file that is cut inside a line
        const std::string rest = good.substr(std::min(text.size(), good.size()));
        const bool cut = i >= 2 && (i / 2) % 4 == 0 && good.starts_with(text);
        const bool inside = !text.empty() && text.back() != '\n' && text.find_last_not_of(' ') + 1 == text.size();
        if (cut && rest != "\n" && (at2 || (inside && rest[0] != '\n'))) {
            ASSERT_EQ(ended.status, 2);
        }
        if (ended.status == 2) {
            ++refused;
            ASSERT_EQ(ended.out, "");
            expect_one_message(ended.err, ended.err);
            EXPECT_NE(ended.err.find(file), std::string::npos);
            if (i % 5 == 0) { // and a study under it is refused for the same reason
                const Ended other = run(run_words(record_study, settings, {"-o", "out.h5"}));
                EXPECT_EQ(other.status, 2);
                EXPECT_TRUE(contents() == before);
            }
            fs::remove(folder / file);
            continue;
        }
        ASSERT_EQ(ended.status, 0);
        ++read;
        // the numbers are those that a plain look into the file finds
        const JsonValue json = json_of(ended);
        ASSERT_EQ(json.items.size(), 1u);
        const JsonValue& r = json.items[0];
        std::vector<double> values;
        double first_s = 0, last_s = 0, dt_s = 0, npts = 0;
        bool data = !at2;
        for (const std::string& line : lines_of(text)) {
            if (!data) {
                std::string lower = line;
                for (char& c : lower)
                    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
                data = lower.find("npts") != std::string::npos;
                if (data) {
                    npts = std::strtod(lower.c_str() + lower.find('=') + 1, nullptr);
                    dt_s = std::strtod(lower.c_str() + lower.rfind('=') + 1, nullptr);
                }
                continue;
            }
            char* at = const_cast<char*>(line.c_str());
            for (char* end = at;; at = end) {
                const double number = std::strtod(at, &end);
                if (end == at)
                    break;
                values.push_back(number);
            }
        }
        if (!at2) {
            ASSERT_EQ(values.size() % 2, 0u);
            first_s = values[0];
            last_s = values[values.size() - 2];
            for (std::size_t k = 0; 2 * k < values.size(); ++k)
                values[k] = values[2 * k + 1];
            values.resize(values.size() / 2);
            dt_s = (last_s - first_s) / static_cast<double>(values.size() - 1);
        } else {
            ASSERT_EQ(static_cast<double>(values.size()), npts);
        }
        double pga = 0;
        for (const double value : values)
            pga = std::max(pga, std::abs(value) * (at2 ? 9.80665 : 1));
        EXPECT_EQ(r["unit"].text, at2 ? "g" : "m/s2");
        EXPECT_EQ(r["samples"].number, static_cast<double>(values.size()));
        EXPECT_NEAR(r["pga_m_s2"].number, pga, 1e-9 * pga);
        EXPECT_NEAR(r["dt_s"].number, dt_s, 0.01 * dt_s);
        for (const char* key :
             {"pgv_m_s", "pgd_m", "arias_m_s", "d5_95_s", "predominant_frequency_hz", "mean_frequency_hz"})
            EXPECT_EQ(r[key].kind, JsonValue::Kind::number) << key; // a value that is not finite would be null
        fs::remove(folder / file);
    }
    EXPECT_GT(refused, 60);
    EXPECT_GT(read, 10);
}

} // namespace
} // namespace stylobate
