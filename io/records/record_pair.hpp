#pragma once
/// The components of one recording: which of them belong together, by the names that agencies give to files and
/// components.

#include "ensemble/model/study.hpp"
#include "io/records/record.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace stylobate {

/// Azimuth of a horizontal component, clockwise from north, in [0, 360), by the name of its direction: "N10W" is 350,
/// "E-W" and "HNE" are 90, "360" is 0. Nothing of names without an azimuth: "L", "H1", "HN2", "UP".
std::optional<double> azimuth_of_name(std::string_view name);

/// Largest difference of two horizontal axes from a right angle [degrees].
inline constexpr double axes_tolerance_deg = 2;

/// Which component of a recording is asked for, beside the first one.
struct OtherComponent {
    std::string key;                             ///< for messages: "excitation.second"
    ComponentSpec spec;                          ///< as given in the study
    Direction direction = Direction::horizontal; ///< or vertical
    std::optional<std::string> unit;             ///< of the first component, as given in the study
};

/// Another component of the recording of which `first` is one:
///
///   file and component named   that one
///   a component alone          of the file of the first one
///   neither                    the only one of its direction in the file of the first one; where that has one
///   component,
///                              the file beside it whose name differs from its name in the direction alone
///                              ("XYZ090.AT2" and "XYZ000.AT2", "A.HNE.D.ASC" and "A.HNN.D.ASC", "B.NS2" and "B.EW2")
///
/// A second horizontal component is positive 90 degrees clockwise from the first one, seen from above: where the names
/// state that it is positive in the opposite sense, its samples are turned, and the note states it.
///
/// @throws InputError, naming the file and the key, if there is none or more than one, if it has another direction, the
///         same axis or the samples of the first one, an axis that is not orthogonal to it, or another rate, if a
///         horizontal one is shorter; and as `read_record`
Record other_component(const Record& first, const OtherComponent& other, PgaRange pga = PgaRange::usual);

} // namespace stylobate
