#pragma once
/// The fields of a structure, listed once. Files, tables, JSON, texts and documentation are made from the list.
///
/// A structure S has its list beside it, in the order of files:
///
///     template <class F>
///     void visit_fields(std::type_identity<S>, F&& f)
///     {
///         f("from_s", &S::from_s, {.says = "begin of the window"});
///         f("lower", within(&S::limits, &Limits::lower));
///     }
///
/// A reader or writer calls it with f(name, field, facts = {}), and reaches the field by `std::invoke(field, s)`.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

namespace stylobate {

/// The models of which something is, by the dimensions of the structure: the plane has 2, space 3.
enum class Models : std::uint8_t { all, plane, space };

/// Whether a model is among them. @param dimensions of the structure, 2 or 3
constexpr bool has_model(Models models, int dimensions)
{
    return models == Models::all || (models == Models::space) == (dimensions == 3);
}

struct FieldFacts {
    const char* says = "";                     ///< its meaning, in the words of files and of the documentation
    std::optional<std::string_view> unit = {}; ///< where the end of its name is not its unit
    std::optional<std::string_view> none = {}; ///< what stands for "none", and its meaning; nullopt: nothing does
    std::optional<std::string_view> more = {}; ///< the rest of its meaning, for the documentation alone
    std::uint64_t since = 0;                   ///< the first version of the file that has it
    bool is_signed = false;                    ///< whether a number may be negative
    Models models = Models::all;               ///< whose files and tables have it
};

/// The field of a member, or of a member of that.
template <class... Path>
constexpr auto within(Path... path)
{
    return [=](auto& s) -> auto&
    {
        return (s.*....*path);
    };
}

/// The unit at the end of a name, as files and tables have it: "m/s2" of "pga_m_s2"; "" of a name that ends in none.
constexpr std::string_view unit_of(std::string_view name)
{
    // longest endings first
    constexpr std::array<std::pair<std::string_view, std::string_view>, 17> endings = {{{"_kg_m3", "kg/m3"},
                                                                                        {"_n_m3", "N/m3"},
                                                                                        {"_deg", "degrees"},
                                                                                        {"_rad_s2", "rad/s2"},
                                                                                        {"_rad_s", "rad/s"},
                                                                                        {"_n_s_m", "N s/m"},
                                                                                        {"_per_s", "1/s"},
                                                                                        {"_n_m2", "N/m2"},
                                                                                        {"_m_s2", "m/s2"},
                                                                                        {"_m_s", "m/s"},
                                                                                        {"_n_m", "N/m"},
                                                                                        {"_rad", "rad"},
                                                                                        {"_hz", "Hz"},
                                                                                        {"_kg", "kg"},
                                                                                        {"_j", "J"},
                                                                                        {"_m", "m"},
                                                                                        {"_s", "s"}}};
    for (const auto& [ending, unit] : endings)
        if (name.ends_with(ending))
            return unit;
    return {};
}

} // namespace stylobate
