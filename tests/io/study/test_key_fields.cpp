/// The member that a key fills: read, written, needed, excluded and left alone by the description of its key.

#include "ensemble/model/input_error.hpp"
#include "io/keys/words.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace stylobate {
namespace {

struct Vase {
    double height_m = 0.3;
    double mass_kg = 0;
    int handles = 2;
    std::optional<double> crack_m;
    std::vector<double> bands_m = {0.1, 0.2};
    std::string painter;
    bool whole = true;
    Spacing spacing = Spacing::log;
};

const NumberKey vase_height("height_m", &Vase::height_m, {0, 2, true}, "height");
const NumberKey vase_mass("mass_kg", &Vase::mass_kg, {0, 9, true}, "mass", {.needed = true});
const WholeKey vase_handles("handles", &Vase::handles, {0, 4}, "handles", {.used = {{"vase.kind", {"amphora"}}}});
const NumberKey vase_crack("crack_m", &Vase::crack_m, {0, 1, true}, "crack", {.absent = "none", .excludes = {"whole"}});
const ListKey vase_bands("bands_m", &Vase::bands_m, {0, 1, true}, "bands");
const TextKey vase_painter("painter", &Vase::painter, "painter", {.absent = "not known"});
const BooleanKey vase_whole("whole", &Vase::whole, "whole");
const WordKey<Spacing> vase_spacing("spacing", &Vase::spacing, spacing_names, "spacing");
const TableKey vase("vase", "a vase",
                    {&vase_height, &vase_mass, &vase_handles, &vase_crack, &vase_bands, &vase_painter, &vase_whole,
                     &vase_spacing});

/// "NAME = VALUE; " of each field.
std::string written(const Vase& of)
{
    std::string text;
    for (const TomlKey* key : vase.keys)
        if (const std::optional<std::string> value = key->field.text(*key, &of))
            text += key->name + " = " + *value + "; ";
    return text;
}

TEST(KeyFields, AreReadAndWrittenByTheDescriptionOfTheirKeys)
{
    const auto read = [](const std::string& text, const KeyUse& use = {}) {
        const TomlValue root = parse_toml("[vase]\n" + text, "vase.toml");
        Vase made;
        KeyReader(&root, "", root.place).table(vase).read_fields(vase, made, use);
        return made;
    };
    EXPECT_EQ(written(read("mass_kg = 1\n")), "height_m = 0.3; mass_kg = 1.0; handles = 2; bands_m = [0.1, 0.2]; "
                                              "whole = true; spacing = \"log\"; ");
    EXPECT_EQ(written(read("height_m = 0.5\nmass_kg = 2\nhandles = 3\ncrack_m = 0.1\nbands_m = [0.3]\n"
                           "painter = \"Exekias\"\nspacing = \"linear\"\n")),
              "height_m = 0.5; mass_kg = 2.0; handles = 3; crack_m = 0.1; bands_m = [0.3]; painter = \"Exekias\"; "
              "whole = true; spacing = \"linear\"; ");
    EXPECT_EQ(read("mass_kg = 1\nhandles = 3\n", {{{"vase.kind", "amphora"}}}).handles, 3);
    EXPECT_EQ(read("mass_kg = 1\nhandles = 3\n", {{{"vase.kind", "bowl"}}}).handles, 2) << "is not used there";
    EXPECT_EQ(read("", KeyUse{}.without({&vase_mass})).mass_kg, 0);

    const auto refusal_of = [&](const std::string& text) {
        try {
            read(text);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refusal_of("height_m = 1\n"), "vase.toml:1: vase.mass_kg is missing.\n  Give a number in (0, 9].");
    EXPECT_EQ(refusal_of("mass_kg = 1\nwhole = false\ncrack_m = 0.2\n"),
              "vase.toml:4: vase.crack_m = 0.2 and whole exclude each other.\n  Give one of the two.");
    EXPECT_EQ(vase_height.absent, "0.3");
    EXPECT_TRUE(vase_mass.needed());
    EXPECT_EQ(vase_bands.absent, "[0.1, 0.2]");
}

} // namespace
} // namespace stylobate
