#pragma once
/// The axes of a surface: what its rows and its columns of cells are.

#include <cstddef>
#include <vector>

namespace stylobate {

/// What the rows of a surface differ in, in the words of files and pictures.
struct RowQuantity {
    const char* key;    ///< of study files, results and tables
    const char* unit;   ///< in results
    const char* symbol; ///< behind a number: " Hz"
    const char* name;   ///< "frequency"
    const char* plural;
    const char* label;   ///< of an axis, with its unit
    const char* meaning; ///< of the values, in results
    const char* option;  ///< of the command line
};
inline constexpr RowQuantity frequency_rows{
    "frequency_hz", "Hz", " Hz", "frequency", "frequencies", "frequency [Hz]", "frequency of the shaking",
    "--frequency"};
inline constexpr RowQuantity direction_rows{"direction_deg",
                                            "degrees",
                                            "°",
                                            "direction",
                                            "directions",
                                            "direction of the shaking [°]",
                                            "direction of the shaking, from x towards z",
                                            "--direction"};

/// The values of the cells, row by row: cell = row x np + column. Without values there is no surface.
struct SurfaceAxes {
    std::vector<double> frequency_hz;  ///< (nf) of the rows; none where they are directions
    std::vector<double> pga_m_s2;      ///< (np) of the columns
    std::vector<double> direction_deg; ///< (nf) of the rows in space; none where they are frequencies

    const RowQuantity& row_quantity() const { return direction_deg.empty() ? frequency_rows : direction_rows; }
    const std::vector<double>& rows() const { return direction_deg.empty() ? frequency_hz : direction_deg; }
    std::size_t cells() const { return rows().size() * pga_m_s2.size(); }
    const SurfaceAxes& axes() const { return *this; }
    SurfaceAxes& axes() { return *this; }
    friend bool operator==(const SurfaceAxes&, const SurfaceAxes&) = default;
};

} // namespace stylobate
