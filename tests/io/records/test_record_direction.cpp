/// Whether a component is horizontal or vertical: by the words of many agencies.

#include "tests/io/records/record_network_files.hpp"

namespace stylobate {
namespace {

using RecordDirection = RecordFiles;

TEST(DirectionNames, OfAgencies)
{
    for (const char* name : {"UP",
                             "Up",
                             "up",
                             "-UP",
                             "DOWN",
                             "Dwn",
                             "VER",
                             "Vert",
                             "VERTICAL",
                             "V",
                             "+V",
                             "V-",
                             "V;+",
                             "Z",
                             "-Z",
                             "U-D",
                             "UD",
                             "U/D",
                             "UP-DOWN",
                             "UD1",
                             "UD2",
                             "V2",
                             "HNZ",
                             "HGZ",
                             "HLZ",
                             "BHZ",
                             "ENZ",
                             "BNZ",
                             "HNZ.00",
                             "az",
                             "a_z",
                             "acc_z [m/s2]",
                             "acc_v",
                             "Acceleration UD (gal)",
                             "vertical acceleration [g]",
                             "400",
                             "402"})
        EXPECT_EQ(direction_of_name(name), Direction::vertical) << name;
    for (const char* name : {"0",      "090", "360",  "360 Deg", "90 deg.", "N",    "E",    "N-S",        "E-W",
                             "NS",     "EW2", "N90E", "S00W",    "N 10 W",  "N28W", "EO",   "North",      "east",
                             "H1",     "H2",  "L",    "T",       "L1",      "T3",   "LONG", "Tran",       "Transverse",
                             "Radial", "FN",  "FP",   "HNE",     "HGN",     "HN1",  "BH2",  "acc_ns (g)", "501"})
        EXPECT_EQ(direction_of_name(name), Direction::horizontal) << name;
    for (const char* name : {"", "x", "Y", "acceleration", "column 2", "a", "acc [g]", "500.5", "BN3", "720", "o",
                             "accélération (m/s²)", "aceleración"}) // no L, and no N
        EXPECT_EQ(direction_of_name(name), Direction::unknown) << name;
}

TEST_F(RecordDirection, OfTheFilesOfAgencies)
{
    const auto of = [&](const std::string& content, const std::string& name = "record.txt",
                        const std::string& unit = "") {
        std::string directions;
        for (const Record& record : read_records(file(content, name), unit))
            directions += *to_string(record.direction);
        return directions;
    };
    EXPECT_EQ(of(csmip_v1()), "hv");
    EXPECT_EQ(of(csmip_v2()), "hvh");
    EXPECT_EQ(of(bhrc()), "hvh");
    EXPECT_EQ(of(usc()), "h");
    EXPECT_EQ(of(smc()), "h");
    EXPECT_EQ(of(replaced(smc(), "component=    360", "component=     UP")), "v");
    // by the angle of the sensor from the vertical alone
    EXPECT_EQ(of(replaced(replaced(smc(), "component=    360", "component=       "), "        90       360",
                          "         0         0")),
              "v");
    EXPECT_EQ(of(geonet()), "hhv");
    EXPECT_EQ(of(cosmos()), "h");
    CosmosChannel channel;
    for (const int code : {400, 401, 402}) {
        channel.azimuth = code;
        EXPECT_EQ(of(cosmos(channel)), "v") << code;
    }
    channel.azimuth = -999;
    channel.channel = "  ?";
    channel.code = "BNZ";
    EXPECT_EQ(of(cosmos(channel)), "v");
    EXPECT_EQ(of(esm()), "h");
    EXPECT_EQ(of(esm(21, {"STREAM: HNZ"})), "v");
    EXPECT_EQ(of(esm(21, {"STREAM: HGZ"})), "v");
    EXPECT_EQ(of(esm(21, {"STREAM: "})), "u");
    EXPECT_EQ(of(knet("N-S")), "h");
    EXPECT_EQ(of(knet("U-D")), "v");
    EXPECT_EQ(of(knet("6")), "v");
    EXPECT_EQ(of(unam()), "vhh");
}

TEST_F(RecordDirection, OfAt2ByTitleOrName)
{
    const auto of = [&](const std::string& last_part, const std::string& name) {
        return read_record(file(replaced(at2(), "Array #9, 180", "Array #9, " + last_part), name), "", "").direction;
    };
    for (const char* part : {"UP", "VER", "DWN", "DOWN", "V", "Z", "-V", "Up", "vertical", "UP (USGS STATION 117)"})
        EXPECT_EQ(of(part, "a.AT2"), Direction::vertical) << part;
    for (const char* part : {"180", "0", "L", "N90E", "LN", "TR", "090 (USGS STATION 117)"})
        EXPECT_EQ(of(part, "a.AT2"), Direction::horizontal) << part;
    EXPECT_EQ(of("a component of it", "a.AT2"), Direction::unknown);
    EXPECT_EQ(of("its vertical component", "a.AT2"), Direction::vertical);
    for (const char* name : {"RSN6_IMPVALL.I_I-ELC-UP.AT2", "RSN1787_HECTOR_HECVER.AT2", "PULDWN.AT2", "TABUP.AT2",
                             "BAM-V.AT2", "kjm_up.at2"})
        EXPECT_EQ(of("a component of it", name), Direction::vertical) << name;
    for (const char* name : {"backup.AT2", "setup.AT2", "river.AT2", "UP.AT2", "ELC180.AT2"})
        EXPECT_EQ(of("a component of it", name), Direction::unknown) << name;
    // the vertical by any of them
    EXPECT_EQ(of("180", "ELC-UP.AT2"), Direction::vertical);
}

TEST_F(RecordDirection, OfColumnsByTheirNames)
{
    const auto of = [&](const std::string& names, int components, const std::string& name = "record.csv") {
        std::string directions;
        for (const Record& record : read_records(file(names + columns(12, components, ","), name), "g"))
            directions += *to_string(record.direction);
        return directions;
    };
    EXPECT_EQ(of("time,NS,EW,UD\n", 3), "hhv");
    EXPECT_EQ(of("time,acc N-S,acc E-W,acc U-D\n", 3), "hhv");
    EXPECT_EQ(of("time,L,T,V\n", 3), "hhv");
    EXPECT_EQ(of("t,ax,ay,az\n", 3), "uuv");
    EXPECT_EQ(of("", 2), "uu");
    EXPECT_EQ(of("", 1, "station_up.csv"), "v");
    EXPECT_EQ(of("", 1, "station.UD"), "v");
    EXPECT_EQ(of("# vertical component\n", 1), "v");
}

} // namespace
} // namespace stylobate
