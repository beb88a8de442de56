#pragma once
/// The columns of a run's table in a folder of measured data: their names, and a map for tables with names of their
/// own. See FORMAT.md.

#include "io/files/key_reader.hpp"
#include "io/measured/measured_layout.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylobate {

/// Where the values of a column go.
struct MeasuredColumn {
    const SeriesName* series = nullptr; ///< null: the clock, or a gauge
    std::size_t block = 0;
    std::string gauge{}; ///< its name in small letters; empty: no gauge
    bool left = false;   ///< it is not read
    double factor = 1;   ///< to SI
    std::string unit{};  ///< from the name

    bool same_place(const MeasuredColumn& other) const
    {
        return !left && !other.left && series == other.series && block == other.block && gauge == other.gauge;
    }
};

/// The meaning of a name: "x3_mm", "base_acceleration_g", "force_rod_n", "time_s", in capitals or not; nullopt: none.
/// @param version of the format
std::optional<MeasuredColumn> column_of(std::string_view spelled, int version);

/// Names of columns that another program chose, and what they are: the table [columns] of campaign.toml.
class ColumnMap {
public:
    /// @param columns the table; null: there is none   @param table its reader   @param version of the format
    /// @throws InputError if a value is no name of a column, or has another unit than its key
    ColumnMap(const TomlValue* columns, const KeyReader& table, int version);

    /// What a column is: by the map, else by its own name.
    /// @param gauges of the run
    /// @throws InputError with file and line if it is not known
    MeasuredColumn find(std::string_view name, const std::string& file, long line,
                        const std::vector<ForceGauge>& gauges);
    /// The names in the map that no table had.
    std::vector<std::string> unused() const;

private:
    struct Entry {
        std::string name;
        MeasuredColumn column;
        bool used = false;
    };
    std::string remedy(std::string_view name, const std::vector<ForceGauge>& gauges) const;

    int version_;
    std::vector<Entry> entries_;
};

} // namespace stylobate
