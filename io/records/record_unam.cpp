/// Mexico's standard acceleration file (Instituto de Ingenieria, UNAM), version 2.0: lines "NAME : value" with the
/// colon in one column, values of several channels as "/V/N90E/N00E", then a table with a column for each channel.
/// Lines that are read:
///
///   CLAVE DE LA ESTACION                   : CUP5
///   NUMERO DE CANALES                      : 3
///   ORIENTACION C1-C6 (rumbo;orientacion)  : /V/N90E/N00E         and C7-C12, here and below
///   INTERVALO DE MUESTREO, C1-C6 (s)       : /0.004/0.004/0.004
///   DURACION DEL REGISTRO (s), C1-C6       : /70.00/70.00/70.00
///   NUM. TOTAL DE MUESTRAS, C1-C6          : /17500/17500/17500
///   ACEL. MAX.(Gal), C1-C6                 : /0.47/-1.19/1.22
///   UNIDADES DE LOS DATOS                  : Gal (cm/s/s)
///   FACTOR DE DECIMACION                   : 1
///   FORMATO DATOS (FORTRAN,10 campos/dato) : 3F10.3
///
/// Files occur with two rows more than the header counts. Count, duration and interval agree with each other there, and
/// the rows beyond are copies of the last one counted: the writer's padding. Such copies are left out; any other row
/// beyond the count is refused.

#include "io/records/record_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stylobate {

namespace {

constexpr std::size_t longest_header = 200;

/// The line above the table's heading; the end of the lines looked at if there is none.
std::size_t data_line(const RecordText& text)
{
    return find_line(text, 0, longest_header, "datos de aceleracion:");
}

bool recognise(const RecordText& text)
{
    constexpr std::size_t above = 20;
    return find_line(text, 0, above, "archivo estandar de aceleracion") < std::min(above, text.lines.size());
}

std::string_view value_of(std::string_view line)
{
    const std::size_t colon = line.find(" :");
    return colon == std::string_view::npos ? std::string_view() : trimmed(line.substr(colon + 2));
}

/// The line whose name begins so (lower case).
std::size_t line_of(const RecordText& text, std::size_t header, std::string_view name)
{
    for (std::size_t i = 0; i < header; ++i)
        if (lower_case(trimmed(text.lines[i])).starts_with(name))
            return i;
    return header;
}

/// @throws InputError if there is no such line, or it has no value
std::size_t needed(const RecordText& text, std::size_t header, std::string_view name)
{
    const std::size_t i = line_of(text, header, name);
    if (i == header)
        text.refuse(fmt::format("its header has no line \"{}\".", name));
    if (value_of(text.lines[i]).empty())
        text.refuse(i, "has no value behind its colon.");
    return i;
}

/// What stands for each channel, with the line of each.
struct PerChannel {
    std::vector<std::string> values;
    std::vector<std::size_t> lines;
};

/// @param name of the line up to "c1-c6", to which one of "c7-c12" belongs where there are more than six
PerChannel per_channel(const RecordText& text, std::size_t header, const std::string& name, std::size_t channels)
{
    PerChannel found;
    const std::size_t first = needed(text, header, name + "c1-c6");
    for (const std::size_t i : {first, channels > 6 ? needed(text, header, name + "c7-c12") : header}) {
        if (i == header)
            continue;
        std::string_view list = value_of(text.lines[i]);
        while (!list.empty()) {
            list.remove_prefix(list.starts_with('/') ? 1 : 0);
            const std::size_t end = std::min(list.find('/'), list.size());
            found.values.emplace_back(trimmed(list.substr(0, end)));
            found.lines.push_back(i);
            list.remove_prefix(end);
        }
    }
    if (found.values.size() != channels)
        text.refuse(first, fmt::format("{} values stand for the {} channels.", found.values.size(), channels));
    return found;
}

/// The number of rows beyond those counted, which repeat the last one counted.
/// @param last the last row counted
/// @throws InputError, naming the line, if one is another
std::size_t padding_rows(const RecordText& text, std::size_t last, std::size_t count)
{
    const std::string padding = squeezed(text.lines[last]);
    std::size_t rows = 0;
    for (std::size_t i = last + 1; i < text.lines.size(); ++i) {
        const std::string row = squeezed(text.lines[i]);
        if (!row.empty() && row != padding)
            text.refuse(i, fmt::format("\"{}\" stands below the {} rows that the header counts, and is not a copy of "
                                       "the last of them: the count is wrong, or the file is damaged.",
                                       row.substr(0, 40), count));
        rows += row.empty() ? 0 : 1;
    }
    return rows;
}

std::vector<Record> parse(const RecordText& text, const std::optional<std::string>& given)
{
    const std::size_t header = data_line(text);
    if (header >= std::min(longest_header, text.lines.size()))
        text.refuse("has no line \"DATOS DE ACELERACION:\" above its values: it is truncated or damaged.");
    const std::size_t number_line = needed(text, header, "numero de canales");
    const double stated = number(text, number_line, value_of(text.lines[number_line]));
    if (!(stated >= 1 && stated <= 12) || stated != std::floor(stated))
        text.refuse(number_line, fmt::format("the number of channels is {}; it may be 1 to 12.", stated));
    const auto channels = static_cast<std::size_t>(stated);
    const std::size_t units = needed(text, header, "unidades de los datos");
    const std::string unit = unit_of_file(text, units, parts_of(value_of(text.lines[units]), false).front(), given);
    const std::size_t factor_line = needed(text, header, "factor de decimacion");
    const double decimation = number(text, factor_line, value_of(text.lines[factor_line]));
    const std::size_t format_line = needed(text, header, "formato datos");
    const FortranFormat format = fortran_format(text, format_line, value_of(text.lines[format_line]));
    if (static_cast<std::size_t>(format.per_line) != channels)
        text.refuse(format_line,
                    fmt::format("the rows have {} values and the file {} channels.", format.per_line, channels));

    const PerChannel orientation = per_channel(text, header, "orientacion ", channels);
    const PerChannel interval = per_channel(text, header, "intervalo de muestreo, ", channels);
    const PerChannel duration = per_channel(text, header, "duracion del registro (s), ", channels);
    const PerChannel samples = per_channel(text, header, "num. total de muestras, ", channels);
    const PerChannel peak = per_channel(text, header, "acel. max.(gal), ", channels);
    const std::size_t count = sample_count(text, samples.lines[0], samples.values[0]);
    if (count > text.lines.size()) // before the product of a damaged count overflows
        text.refuse(samples.lines[0], fmt::format("{} samples are counted and the whole file has {} lines: it is "
                                                  "truncated. Obtain the complete file.",
                                                  count, text.lines.size()));
    std::vector<Record> records(channels);
    for (std::size_t c = 0; c < channels; ++c) {
        Record& record = records[c];
        record.unit = unit;
        record.station = value_of(text.lines[needed(text, header, "clave de la estacion")]);
        for (const char* name : {"fecha del sismo", "nombre de la estacion"})
            if (const std::size_t i = line_of(text, header, name); i < header)
                record.title += (record.title.empty() ? "" : ", ") + squeezed(value_of(text.lines[i]));
        // "N90E;+" tells the sense of the sensor too
        record.orientation = orientation.values[c].substr(0, orientation.values[c].find(';'));
        record.component = fmt::format("canal-{}", c + 1);
        record.dt_s = number(text, interval.lines[c], interval.values[c]) * decimation;
        check_dt(text, interval.lines[c], record.dt_s);
        record.header_pga_m_s2 = stated_peak_m_s2(number(text, peak.lines[c], peak.values[c]), "cm/s2");
        if (samples.values[c] != samples.values[0])
            text.refuse(samples.lines[c],
                        "the channels differ in their number of samples, so the rows cannot be assigned to channels.");
        const double duration_s = number(text, duration.lines[c], duration.values[c]);
        const double lasts = static_cast<double>(count) * record.dt_s;
        if (std::fabs(lasts - duration_s) > 2 * record.dt_s + 0.01) // in two decimals
            text.refuse(duration.lines[c],
                        fmt::format("{} samples every {} s last {} s, but the stated duration is {} s.", count,
                                    record.dt_s, lasts, duration_s));
    }

    // the heading of the table stands between two rules
    const std::size_t end = std::min(text.lines.size(), header + 10);
    std::size_t first = find_line(text, header + 1, end, "---");
    first = find_line(text, std::min(first + 1, end), end, "---") + 1;
    if (first > end)
        text.refuse(header, "the two rules around the heading of the table should follow.");
    const auto values = fixed_width_numbers(text, first, count * channels, format.width, format.per_line);
    if (const std::size_t rows = padding_rows(text, first + count - 1, count); rows > 0)
        for (Record& record : records)
            record.note =
                fmt::format("without the {} rows beyond the {} of the header: copies of the last one", rows, count);
    for (std::size_t i = 0; i < values.size(); ++i)
        records[i % channels].acceleration_m_s2.push_back(values[i]);
    return records;
}

} // namespace

const RecordParser unam_parser = {"unam", recognise, parse};

} // namespace stylobate
