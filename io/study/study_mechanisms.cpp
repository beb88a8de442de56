#include "ensemble/model/plan_face.hpp"
#include "io/keys/mechanism_keys.hpp"
#include "io/keys/words.hpp"
#include "io/study/study_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

const char* place_word(MechanismPlace place)
{
    return place == MechanismPlace::joint ? "joint" : "block";
}

class Reader {
public:
    Reader(const KeyReader& section, Study& study) : section_(section), study_(study), layout_(lay_out(study.structure))
    {
    }

    void read()
    {
        for (const MechanismRule& rule : mechanism_rules())
            if (section_.has(rule.name))
                read_mechanism(rule);
    }

private:
    int places(MechanismPlace place) const
    {
        return static_cast<int>(place == MechanismPlace::joint ? layout_.beds.size() : layout_.blocks.size());
    }

    /// "The structure has 6 joints: 0 is drum 2 on drum 1, 5 is drum 7 on drum 6."
    std::string what_there_is(MechanismPlace place) const
    {
        const auto name = [&](int i) {
            const auto k = static_cast<std::size_t>(i);
            if (place == MechanismPlace::block)
                return layout_.blocks[k].name;
            const PlacedBed& bed = layout_.beds[k];
            return fmt::format("{} on {}", layout_.blocks[static_cast<std::size_t>(bed.upper)].name,
                               bed.lower < 0 ? "the ground" : layout_.blocks[static_cast<std::size_t>(bed.lower)].name);
        };
        const int count = places(place);
        const std::string last = count > 1 ? fmt::format(", {} is {}", count - 1, name(count - 1)) : std::string();
        return fmt::format("The structure has {} {}{}: 0 is {}{}.", count, place_word(place), count == 1 ? "" : "s",
                           name(0), last);
    }

    void check_excitation(const MechanismRule& rule) const
    {
        const ExcitationKind kind = study_.excitation.kind;
        if (rule.place != MechanismPlace::base || rule.mechanism == Mechanism::table_tilt)
            return;
        const std::string unused =
            fmt::format("is not used by excitation.kind = \"{}\"", word_for(excitation_kind_names, kind));
        if (kind == ExcitationKind::none)
            section_.refuse(rule.name, unused, "Remove it: the base does not move.");
        const bool pulse = kind == ExcitationKind::half_sine || kind == ExcitationKind::full_sine ||
                           kind == ExcitationKind::ricker || kind == ExcitationKind::pulse;
        if (rule.mechanism == Mechanism::harmonic_distortion && pulse)
            section_.refuse(
                rule.name, unused,
                "Remove it: a pulse has no harmonics. Oscillating motions have harmonics: harmonic, tapered, "
                "sweep, noise, record, table.");
    }

    void read_mechanism(const MechanismRule& rule)
    {
        check_excitation(rule);
        if (rule.mechanism == Mechanism::face_damping && study_.contact.damping == DampingAt::ends)
            section_.refuse(rule.name, "and contact.damping = \"ends\" exclude each other",
                            "\"ends\" is a share of 1 in every joint. Give one of the two.");
        if (rule.mechanism == Mechanism::mortar && study_.contact.form != ContactForm::area)
            section_.refuse(rule.name,
                            fmt::format("is not available with contact.form = \"{}\"",
                                        word_for(contact_form_names, study_.contact.form)),
                            "Remove it, or give contact.form = \"area\".");
        const TableKey& key = mechanism_key(rule.mechanism);
        std::vector<MechanismSpec> specs;
        std::vector<bool> taken(static_cast<std::size_t>(rule.place == MechanismPlace::base ? 1 : places(rule.place)));
        const bool list = section_.find(rule.name)->type == TomlValue::Type::array;
        if (list && rule.place == MechanismPlace::base)
            section_.refuse(rule.name, "is a list, and there is one base", "Give one table: { key = value, ... }.");
        const std::vector<KeyReader> tables = list ? section_.tables(key) : std::vector<KeyReader>{section_.table(key)};
        if (tables.empty())
            section_.refuse(rule.name, "is empty", "Remove it, or give { key = value, ... }.");
        for (const KeyReader& keys : tables) {
            MechanismSpec spec = read_one(keys, rule);
            read_places(keys, rule, taken, spec.places);
            check_room(keys, spec);
            const auto same = std::find_if(specs.begin(), specs.end(),
                                           [&](const MechanismSpec& other) { return other.values == spec.values; });
            if (same == specs.end())
                specs.push_back(std::move(spec));
            else
                same->places.insert(same->places.end(), spec.places.begin(), spec.places.end());
        }
        for (MechanismSpec& spec : specs) {
            std::sort(spec.places.begin(), spec.places.end());
            if (spec.places == usual_places(rule, layout_))
                spec.places.clear();
        }
        std::sort(specs.begin(), specs.end(),
                  [](const MechanismSpec& a, const MechanismSpec& b) { return a.places < b.places; });
        study_.mechanisms.insert(study_.mechanisms.end(), specs.begin(), specs.end());
    }

    MechanismSpec read_one(const KeyReader& keys, const MechanismRule& rule)
    {
        const MechanismKey& key = mechanism_key(rule.mechanism);
        const bool vertical = rule.mechanism == Mechanism::vertical_motion;
        MechanismSpec spec = neutral_spec(rule.mechanism, study_.contact.friction);
        if (vertical && keys.has(vertical_keys::file)) {
            read_vertical(keys);
            return spec;
        }
        if (vertical)
            keys.refuse_unused({"ratio"}, "a vertical motion without a file");
        bool acts = false;
        std::vector<std::string> acting;
        for (std::size_t i = 0; i < rule.parameters.size(); ++i) {
            const NumberKey& parameter = key.parameters[i];
            if (!parameter.used_where(model_key, dimensions_word(study_.structure)))
                continue;
            // the neutral value may be the study's, not the key's default
            spec.values[i] = keys.read_or(parameter, spec.values[i]);
            if (rule.parameters[i].role == ParameterRole::needed)
                spec.values[i] = keys.read(parameter);
            if (rule.parameters[i].role == ParameterRole::acting) {
                acting.push_back(parameter.name);
                acts = acts || keys.has(parameter);
            }
        }
        if (acting.size() == 1 && !acts)
            keys.missing(acting.front(), key.parameters.front().range.hint);
        if (!acts)
            keys.refuse_all(fmt::format("{} has no value.\n  Give one of {}.", keys.path(), fmt::join(acting, ", ")));
        return spec;
    }

    void read_vertical(const KeyReader& keys)
    {
        if (keys.has("ratio"))
            keys.refuse("ratio", "and file exclude each other", "Give one of the two.");
        VerticalSpec vertical;
        const MechanismKey& key = mechanism_key(Mechanism::vertical_motion);
        keys.read_fields<ComponentSpec>(key, vertical);
        keys.read_fields(key, vertical);
        vertical.unit = acceleration_unit(vertical.unit);
        study_.vertical = vertical;
    }

    /// @param taken places that were named before   @param[out] all where it acts, each named
    void read_places(const KeyReader& keys, const MechanismRule& rule, std::vector<bool>& taken,
                     std::vector<int>& all) const
    {
        if (rule.place == MechanismPlace::base)
            return;
        const std::string one = place_word(rule.place), several = one + "s";
        const std::string there_is = what_there_is(rule.place);
        const auto last = static_cast<std::uint64_t>(places(rule.place) - 1);
        if (keys.has(one))
            all = {static_cast<int>(keys.whole(one, 0, last, there_is))};
        for (const std::uint64_t place : keys.whole_list_or_none(several, 0, last, there_is))
            all.push_back(static_cast<int>(place));
        const bool named = !all.empty();
        if (!named)
            all = usual_places(rule, layout_);
        if (all.empty())
            keys.refuse_all(
                fmt::format("{} acts nowhere: there are no epistyles side by side. Give the place by {}.\n  "
                            "{}",
                            keys.path(), one, there_is));
        for (const int place : all) {
            const auto k = static_cast<std::size_t>(place);
            const std::string& key = keys.has(one) ? one : several;
            if (rule.place == MechanismPlace::block && layout_.blocks[k].fixed)
                keys.refuse(key, fmt::format("contains {}, which is fixed to the shaking table", place), there_is);
            if (const auto why = why_not(rule, layout_, place))
                keys.refuse(key, fmt::format("contains {}, which {}", place, *why), there_is);
            if (taken[k]) {
                const std::string twice = fmt::format("{} {} occurs twice", one, place);
                if (named)
                    keys.refuse(key,
                                fmt::format("is not the first of {}: {}", section_.path() + "." + rule.name, twice),
                                "Give one entry for each place.");
                keys.refuse_all(fmt::format("{} acts everywhere, and {}.\n  Give the place by {} or {}.", keys.path(),
                                            twice, one, several));
            }
            taken[k] = true;
        }
    }

    /// What is lost of a face leaves some of it, and the centre of mass lies in its block.
    void check_room(const KeyReader& keys, const MechanismSpec& spec) const
    {
        if (const auto why = contradiction(rule_of(spec.mechanism), spec.values))
            keys.refuse_all(fmt::format("{}: {}.", keys.path(), *why));

        const auto width = [&](int block) {
            return block < 0 ? HUGE_VAL : layout_.blocks[static_cast<std::size_t>(block)].width_m;
        };
        for (const int place : spec.places) {
            if (spec.mechanism == Mechanism::corner_loss) {
                const PlacedBed& bed = layout_.beds[static_cast<std::size_t>(place)];
                const double face = std::min(width(bed.lower), width(bed.upper));
                if (!(spec.values[0] + spec.values[1] < face))
                    keys.refuse(keys.has("left_m") ? "left_m" : "right_m",
                                fmt::format("leaves nothing of joint {}, whose face is {} m", place, face),
                                "left_m and right_m together are less than the face.");
            }
            if (spec.mechanism == Mechanism::clamp &&
                std::abs(spec.values[4]) > layout_.blocks[static_cast<std::size_t>(place)].height_m / 2)
                keys.refuse("height_m", fmt::format("is outside block {}", place),
                            "Give no more than half its height.");
            if (spec.mechanism == Mechanism::rod &&
                spec.values[2] > layout_.blocks[static_cast<std::size_t>(place)].height_m)
                keys.refuse("height_m", fmt::format("is above block {}", place), "Give at most its height.");
            if (spec.mechanism == Mechanism::eccentricity && study_.structure.spatial())
                check_centre(keys, spec, place);
            else if (spec.mechanism == Mechanism::eccentricity && !(std::abs(spec.values[0]) < width(place) / 2))
                keys.refuse("offset_m", fmt::format("is outside block {}, which is {} m wide", place, width(place)),
                            "Give less than half of its width.");
        }
    }

    /// In space the centre of mass lies above the bottom face of its block.
    void check_centre(const KeyReader& keys, const MechanismSpec& spec, int place) const
    {
        const PlacedBlock& block = layout_.blocks[static_cast<std::size_t>(place)];
        const PlanFace face{block.shape == Shape::round, 0, 0, block.width_m / 2, block.depth_m / 2};
        if (!(outside_m(face, spec.values[0], spec.values[1]) < 0))
            keys.refuse(keys.has("offset_m") ? "offset_m" : "offset_z_m", fmt::format("is outside block {}", place),
                        "Give less than half of its width.");
    }

    const KeyReader& section_;
    Study& study_;
    const Layout layout_;
};

} // namespace

void read_mechanisms(const KeyReader& section, Study& study)
{
    Reader(section, study).read();
}

} // namespace stylobate
