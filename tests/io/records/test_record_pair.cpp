/// Which components belong to one recording, by the names of agencies.

#include "io/records/record_pair.hpp"

#include "tests/io/records/record_network_files.hpp"

#include <optional>

namespace stylobate {
namespace {

class RecordPair : public RecordFiles {
protected:
    Record first(const std::filesystem::path& path, const std::optional<std::string>& component = {})
    {
        return read_record(path, component, {});
    }
    Record second_of(const Record& record, const ComponentSpec& spec = {})
    {
        return other_component(record, {"excitation.second", spec, Direction::horizontal, {}});
    }
    Record vertical_of(const Record& record, const ComponentSpec& spec = {})
    {
        return other_component(record, {"excitation.vertical", spec, Direction::vertical, {}});
    }
    /// The message with which a second component is refused.
    std::string second_refused(const Record& record, const ComponentSpec& spec = {})
    {
        try {
            second_of(record, spec);
        } catch (const InputError& error) {
            return error.what();
        }
        ADD_FAILURE() << "not refused";
        return {};
    }
    /// An .AT2 file of a direction, its samples shifted by some.
    std::filesystem::path at2_file(const std::string& name, const std::string& direction, int n = 23,
                                   const std::string& dt = ".0100")
    {
        const std::string size = fmt::format("NPTS={:6}, DT=   {} SEC,", n, dt);
        std::string text = replaced(at2(size, n), ", 180", ", " + direction);
        double own = 0.001; // another component has other samples: its second one
        for (const char c : direction)
            own = 0.5 * own + c * 1e-5;
        return file(replaced(text, fmt::format("{:15.7E}", sample(1)), fmt::format("{:15.7E}", own)), name);
    }
};

TEST_F(RecordPair, AzimuthsByTheNamesOfAgencies)
{
    const struct {
        const char* name;
        double azimuth;
    } named[] = {{"N", 0},        {"E", 90},    {"S", 180},    {"W", 270},        {"N-S", 0},    {"E-W", 90},
                 {"NS2", 0},      {"EW1", 90},  {"N10W", 350}, {"N80E", 80},      {"S00E", 180}, {"S45W", 225},
                 {"N 28 W", 332}, {"360", 0},   {"090", 90},   {"90 Deg", 90},    {"HNE", 90},   {"HGN", 0},
                 {"BHE", 90},     {"North", 0}, {"east", 90},  {"acc_ns (g)", 0}, {"EO", 90},    {"N90E", 90},
                 {"N00E", 0},     {"S80E", 100}};
    for (const auto& each : named) {
        const std::optional<double> azimuth = azimuth_of_name(each.name);
        ASSERT_TRUE(azimuth) << each.name;
        EXPECT_EQ(*azimuth, each.azimuth) << each.name;
    }
    for (const char* name : {"", "L", "T", "H1", "H2", "HN1", "UP", "V", "HNZ", "Radial", "FN", "acceleration", "400"})
        EXPECT_FALSE(azimuth_of_name(name)) << name;
}

TEST_F(RecordPair, TheOtherComponentOfOneFile)
{
    const std::filesystem::path csmip = file(csmip_v2()); // horizontal, vertical, horizontal
    const std::vector<Record> all = read_records(csmip, {});
    ASSERT_EQ(all.size(), 3U);
    const std::size_t n = all[2].acceleration_m_s2.size(); // fewer than of the first one
    EXPECT_LT(n, all[0].acceleration_m_s2.size());
    EXPECT_EQ(second_of(all[2]).component, all[0].component);
    expect_says(second_refused(all[0]),
                {all[2].component, fmt::format("{} samples, fewer than", n), "as the first one"});
    EXPECT_EQ(vertical_of(all[0]).component, all[1].component);
    EXPECT_EQ(vertical_of(all[0]).acceleration_m_s2, all[1].acceleration_m_s2);

    const std::vector<Record> nz = read_records(file(geonet(), "nz.V2A"), {});
    EXPECT_EQ(second_of(nz[1]).component, nz[0].component); // the shorter one of both
    EXPECT_EQ(vertical_of(nz[1]).component, nz[2].component);

    const std::vector<Record> mexico = read_records(file(unam(), "mx.txt"), {}); // V, N90E, N00E
    EXPECT_EQ(second_of(mexico[2]).orientation, "N90E");
    EXPECT_EQ(vertical_of(mexico[2]).orientation, "V");
}

TEST_F(RecordPair, TheSenseIsClockwiseFromTheFirstComponent)
{
    const std::filesystem::path path = file(unam());
    const Record east = first(path, "N90E"), north = first(path, "N00E");
    EXPECT_EQ(second_of(north).acceleration_m_s2, east.acceleration_m_s2); // east is clockwise from north
    EXPECT_EQ(second_of(north).note, east.note);
    const Record turned = second_of(east); // north is not from east
    ASSERT_EQ(turned.acceleration_m_s2.size(), north.acceleration_m_s2.size());
    for (std::size_t i = 0; i < north.acceleration_m_s2.size(); ++i)
        EXPECT_EQ(turned.acceleration_m_s2[i], -north.acceleration_m_s2[i]);
    ASSERT_TRUE(turned.note);
    EXPECT_NE(turned.note->find("sign turned"), std::string::npos);
}

TEST_F(RecordPair, TheFilesThatAreNamedLikeIt)
{
    // PEER: the azimuth at the end of the name
    const Record peer = first(at2_file("RSN6_IMPVALL.I_ELC180.AT2", "180"));
    at2_file("RSN6_IMPVALL.I_ELC270.AT2", "270");
    at2_file("RSN6_IMPVALL.I_ELC-UP.AT2", "UP");
    at2_file("RSN7_IMPVALL.I_ELC270.AT2", "270"); // another earthquake
    at2_file("RSN6_IMPVALL.I_ELC270.txt", "270"); // another kind of file
    EXPECT_EQ(second_of(peer).file, (folder_ / "RSN6_IMPVALL.I_ELC270.AT2").string());
    EXPECT_EQ(vertical_of(peer).file, (folder_ / "RSN6_IMPVALL.I_ELC-UP.AT2").string());

    // ESM: the code of the stream
    const Record italy = first(file(esm(), "IT.ABC.00.HNE.D.1.ACC.ASC"));
    file(esm(22, {"STREAM: HNN"}), "IT.ABC.00.HNN.D.1.ACC.ASC");
    file(esm(21, {"STREAM: HNZ"}), "IT.ABC.00.HNZ.D.1.ACC.ASC");
    EXPECT_EQ(second_of(italy, {(folder_ / "IT.ABC.00.HNN.D.1.ACC.ASC").string(), {}, {}}).orientation, "HNN");
    EXPECT_EQ(vertical_of(italy).orientation, "HNZ");

    // KiK-net: six files, in the borehole and on the surface
    for (int channel = 1; channel <= 6; ++channel)
        file(knet(std::to_string(channel)),
             fmt::format("ABC0010301.{}{}", std::array{"NS", "EW", "UD"}[(channel - 1) % 3], (channel - 1) / 3 + 1));
    const Record surface = first(folder_ / "ABC0010301.NS2");
    EXPECT_EQ(surface.component, "NS2");
    EXPECT_EQ(vertical_of(surface).file, (folder_ / "ABC0010301.UD2").string());
    EXPECT_EQ(second_refused(surface).find("no second horizontal"), std::string::npos)
        << "the file is found, and refused for its samples";
}

TEST_F(RecordPair, WhatIsNoPairIsRefused)
{
    const Record one = first(at2_file("A180.AT2", "180"));
    // no companion
    expect_says(second_refused(one),
                {"A180.AT2", "excitation.second", "no second horizontal component", "excitation.second = { file"});
    // shorter, at another rate
    at2_file("A090.AT2", "090", 20);
    expect_says(second_refused(one), {"A090.AT2", "excitation.second", "20 samples, fewer than the 23"});
    at2_file("A090.AT2", "090", 23, ".0050");
    expect_says(second_refused(one), {"A090.AT2", "every 0.005 s", "every 0.01 s"});
    // longer ones are taken
    at2_file("A090.AT2", "090", 30);
    EXPECT_EQ(second_of(one).acceleration_m_s2.size(), 30U);
    // two that fit
    at2_file("A270.AT2", "270");
    expect_says(second_refused(one), {"more than one second horizontal", "A090.AT2", "A270.AT2"});
    // two files of one component: by the axis, and by the samples
    const std::string same = at2_file("B000.AT2", "000").string();
    expect_says(second_refused(one, {same, {}, {}}),
                {"B000.AT2", "has the axis of", "\"180\" and \"000\"", "Two files of one component"});
    expect_says(second_refused(one, {one.file, {}, {}}), {"A180.AT2", "has the samples of"});
    // not orthogonal, vertical
    const std::string oblique = at2_file("C055.AT2", "055").string(), up = at2_file("D-UP.AT2", "UP").string();
    expect_says(second_refused(one, {oblique, {}, {}}), {"C055.AT2", "is not orthogonal to", "\"180\" and \"055\""});
    expect_says(second_refused(one, {up, {}, {}}), {"D-UP.AT2", "is the vertical one"});
    EXPECT_THROW(vertical_of(one, {oblique, {}, {}}), InputError);
    // a degree beside the right angle is the sensor's
    EXPECT_EQ(second_of(one, {at2_file("E091.AT2", "091").string(), {}, {}}).orientation, "091");
}

} // namespace
} // namespace stylobate
