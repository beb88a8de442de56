#pragma once
/// Small files of the strong-motion networks, made up: GeoNet, COSMOS, ESM, K-NET and KiK-net, UNAM.

#include "tests/io/records/record_files.hpp"

namespace stylobate {

/// A component of GeoNet's volume 1 or 2: accelerations of 10 000 `sample` mm/s2, 50 samples a second.
inline std::string geonet_component(int volume, const std::string& direction, int n, int shift = 0)
{
    double peak = 0;
    for (int i = 0; i < n; ++i)
        peak = std::fabs(sample(i + shift)) > std::fabs(peak) ? sample(i + shift) : peak;
    const auto series = [&](int count, int from) {
        return rows(count, 10, [=](int i) { return fmt::format("{:8.1f}", 10000 * sample(i + from)); });
    };
    const int others = volume == 2 ? n - 1 : 0; // velocities and displacements
    const std::string top =
        volume == 2 ? fmt::format("Instrument corrected data at 0.020 sec intervals\n"
                                  "Band-pass filter transition bands are .10-.25 Hz and 24.50-25.50 Hz\n"
                                  "Component {:5} Longitudinal Accelerometer Axis\n"
                                  "Acceleration:  peak {:8.1f} mm/s/s at   0.00 sec     rms    100.0 mm/s/s\n"
                                  "Velocity:      peak   100.00 mm/s   at   0.00 sec     rms    10.00 mm/s\n"
                                  "Displacement:  peak   10.000 mm     at   0.00 sec     rms    1.000 mm\n",
                                  direction, 10000 * peak)
                    : fmt::format("Raw readings in units of 1.00 mm/s/s  at intervals of 0.020 s\n"
                                  "Data is unfiltered\n"
                                  "Component {}\n"
                                  "Acceleration:  Peak {:8.1f} mm/s/s at   0.00 s     RMS   100.00 mm/s/s\n"
                                  "Velocity record unevaluated\nDisplacement record unevaluated\n",
                                  direction, 10000 * peak);
    const double duration_s = 0.02 * (volume == 2 ? n - 1 : n); // each volume counts in its own way
    return fmt::format("{} accelerogram 20030101_100000_XYZ1_20 Agency\n"
                       "Site XYZ1      40 00 00S  170 00 00E     Cusp file:  20030101_100000_XYZ1\n"
                       "Some Where\nInstrument Made_up\n"
                       "Resolution: 18-bit   Instr Period: 0.0050 s   Damping: 0.700\n"
                       "Accelerogram 20030101_100000_XYZ1_20                 Processed 2003 January 02\n"
                       "5 km south of Some Where\n2003 January 01         10:00:00 UT\n"
                       "Epicentre  40 10 00S 170 00 00E  Bearing S00W  Dist   19km  Depth   15km Mw 6.00\n"
                       "Number of points {:5}    Duration {:6.2f} sec\n",
                       volume == 2 ? "Corrected" : "Uncorrected", n, duration_s) +
           top + header_numbers(40, 10, 8, 0, {{30, 4 * n}, {33, n}, {34, others}, {35, others}}) +
           header_numbers(60, 10, 8, 4, {{0, 200}, {23, duration_s}, {24, 0.005}, {25, 0.02}}) + series(n, shift) +
           series(others, shift + 1) + series(others, shift + 2);
}

inline std::string geonet(int volume = 2)
{
    return geonet_component(volume, "N28W", 23) + geonet_component(volume, "S62W", 20, 3) +
           geonet_component(volume, "Up", 21, 7);
}

/// A channel of COSMOS V1.2.
struct CosmosChannel {
    int volume = 2, quantity = 1, unit_code = 4;
    std::string unit = "cm/sec2(04)", name = "acceleration", format = "(1E15.6)";
    std::string channel = "  1", code = "HNE"; ///< "  ?" and "BNZ" where only the channel's code is known
    int azimuth = 360, n = 20, shift = 0;
    double factor = 1000; ///< of `sample` in the file
    double dt_ms = 5;
    std::string below; ///< blocks below the acceleration
};

inline std::string cosmos_values(const CosmosChannel& c, const std::string& name, const std::string& unit)
{
    const int per_line = c.format[1] - '0';
    return fmt::format("{:8} {} pts, approx {:4.0f} secs, units={},Format={}\n", c.n, name,
                       std::floor(c.n * c.dt_ms / 1000), unit, c.format) +
           rows(c.n, per_line, [&](int i) {
               const double value = c.factor * sample(i + c.shift);
               return c.format.find('F') == std::string::npos ? fmt::format("{:15.6e}", value)
                                                              : fmt::format("{:10.5f}", value);
           });
}

inline std::string cosmos(const CosmosChannel& c = {})
{
    double peak = 0;
    for (int i = 0; i < c.n; ++i)
        peak = std::fabs(sample(i + c.shift)) > std::fabs(peak) ? sample(i + c.shift) : peak;
    const std::vector<std::pair<int, double>> integers = {
        {0, c.volume}, {1, c.quantity}, {2, c.unit_code}, {3, 120}, {53, c.azimuth}};
    // the recorder's own interval, 20 ms, is another than that of the values
    const std::vector<std::pair<int, double>> reals = {
        {33, 0.02}, {61, c.dt_ms}, {62, c.n * c.dt_ms / 1000}, {63, c.factor * peak}};
    return fmt::format("{} {}    (Format v01.20 with 13 text lines)\n"
                       "Record of Made-up Earthquake of Wed Jan 1, 2003 10:00 UTC\n"
                       "Hypocenter: 38.000 -123.000 H= 10km Mw=6.0\n"
                       "Origin: 2003/01/01 10:00:00 UTC\n"
                       "Statn No: 05-000001 Code:XY-ABC     AGENCY Some Where\n"
                       "Coords: 38.000  -123.000   Site geology:\n"
                       "Recorder: XYZ\nRcrd start time: 2003/01/01 10:00:10.000 UTC (Q=5) RcrdId:\n"
                       "Sta Chan {}: (see headers) (Rcrdr Chan {}) Location:\n"
                       "Raw record length = 1.000 sec, Uncor max = 1, at 0.000 sec.\n"
                       "Processed: 2003/01/02, Max = 1 at 0.000 sec\nRecord filtered\n"
                       "Values used when parameter or data value is unknown/unspecified:   -999, -999.00\n",
                       c.volume == 2   ? "Corrected"
                       : c.volume == 1 ? "Uncorrected"
                                       : "Raw",
                       c.name, c.channel, c.channel) +
           " 100 Integer-header values follow on  10 lines, Format= (10I8)\n" +
           header_numbers(100, 10, 8, 0, integers, -999) +
           " 100 Real-header values follow on  17 lines, Format= (6F13.6)  \n" +
           header_numbers(100, 6, 13, 6, reals, -999) +
           fmt::format("   1 Comment line(s) follow, each starting with a \"|\":\n|<SCNL>ABC.{}.XY.--\n", c.code) +
           cosmos_values(c, c.name, c.unit) + c.below + fmt::format("End-of-data for Chan{} {}\n", c.channel, c.name);
}

/// ESM: cm/s2, 1000 times `sample`, 200 samples a second. `changes` are lines that stand in place of those with their
/// keys; a line without a value is one of the format's many empty ones.
inline std::string esm(int n = 21, const std::vector<std::string>& changes = {})
{
    std::vector<std::string> lines = {"EVENT_NAME: MADE-UP",
                                      "EVENT_ID: 1",
                                      "EVENT_DATE_YYYYMMDD: 20030101",
                                      "EVENT_TIME_HHMMSS: 100000",
                                      "HYPOCENTER_REFERENCE: ",
                                      "NETWORK: XY",
                                      "STATION_CODE: ABC",
                                      "STATION_NAME: Some Where",
                                      "LOCATION: ",
                                      "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: 20030101_100001.000",
                                      "SAMPLING_INTERVAL_S: 0.005000",
                                      fmt::format("NDATA: {}", n),
                                      fmt::format("DURATION_S: {:.3f}", n * 0.005),
                                      "STREAM: HNE",
                                      "UNITS: cm/s^2",
                                      "INSTRUMENT: sensor = XYZ [Unknown] | digitizer = Unknown [Unknown]",
                                      "PGA_CM/S^2: -50.000000",
                                      "TIME_PGA_S: 0.000000",
                                      "HEADER_FORMAT: DYNA 1.2",
                                      "DATA_TYPE: ACCELERATION",
                                      "ORIGINAL_DATA_MEDIATOR: http://example.org/"};
    while (lines.size() < 59)
        lines.push_back(fmt::format("OTHER_{}: ", lines.size()));
    for (int i = 1; i <= 5; ++i)
        lines.push_back(fmt::format("USER{}: ", i));
    std::string text;
    for (std::string line : lines) {
        for (const std::string& change : changes)
            if (change.substr(0, change.find(':')) == line.substr(0, line.find(':')))
                line = change;
        text += line + "\n";
    }
    return text + rows(n, 1, [](int i) { return fmt::format("{:.6f}", 1000 * sample(i)); });
}

/// K-NET: 50 samples a second for 2 s, 50 000 `sample` counts of 0.02 gal above an offset that is larger than they are.
inline std::string knet(const std::string& direction = "N-S", int n = 100,
                        const std::string& max = "Max. Acc. (gal)   ", double max_gal = 49.8)
{
    return fmt::format("Origin Time       2003/01/01 10:00:00\nLat.              38.000\nLong.             142.000\n"
                       "Depth. (km)       36\nMag.              6.0\nStation Code      ABC001\n"
                       "Station Lat.      38.0000\nStation Long.     141.0000\nStation Height(m) 79\n"
                       "Record Time       2003/01/01 10:00:15\nSampling Freq(Hz) 50Hz\nDuration Time(s)  2\n"
                       "Dir.              {}\nScale Factor      2000(gal)/100000\n{}{}\n"
                       "Last Correction   2003/01/01 10:00:15\nMemo.             \n",
                       direction, max, max_gal) +
           rows(n, 8, [](int i) { return fmt::format("{:8.0f} ", 50000 * sample(i) - 7771); });
}

/// UNAM: three channels in gal, 1000 times `sample`, 250 samples a second, and so many rows of padding.
inline std::string unam(int n = 20, int padding = 2)
{
    const auto line = [](const std::string& name, const std::string& value) {
        return fmt::format("{:39}: {}\n", name, value);
    };
    const auto thrice = [](const std::string& value) { return fmt::format("/{0}/{0}/{0}   ", value); };
    std::string text = "****************************************\n"
                       "                       INSTITUTO DE INGENIERIA, UNAM\n"
                       "ARCHIVO ESTANDAR DE ACELERACION:\n";
    text += line("VERSION DEL FORMATO", "2.0") + "\n";
    text += line("NOMBRE DE LA ESTACION", "SOME WHERE") + line("CLAVE DE LA ESTACION", "ABC1");
    text += line("NUMERO DE CANALES", "3");
    text += line("ORIENTACION C1-C6 (rumbo;orientacion)", "/V;+/N90E;+/N00E;-");
    text += line("ORIENTACION C7-C12 (rumbo;orientacion)", "");
    text += line("INTERVALO DE MUESTREO, C1-C6 (s)", thrice("0.004"));
    text += line("FECHA DEL SISMO [GMT]", "2003/01/01");
    text += line("DURACION DEL REGISTRO (s), C1-C6", thrice(fmt::format("{:.2f}", n * 0.004)));
    text += line("NUM. TOTAL DE MUESTRAS, C1-C6", thrice(fmt::format("{}", n)));
    text += line("ACEL. MAX.(Gal), C1-C6", "/-50.0/49.0/50.0   ");
    text += line("UNIDADES DE LOS DATOS", "Gal (cm/s/s)") + line("FACTOR DE DECIMACION", "1");
    text += line("FORMATO DATOS (FORTRAN,10 campos/dato)", "3F10.3");
    text += "COMENTARIOS:\n\n\n================\nDATOS DE ACELERACION:\n---------+---------+---------+\n"
            "   CANAL-1   CANAL-2   CANAL-3\n         V      N90E      N00E\n---------+---------+---------+\n";
    for (int i = 0; i < n + padding; ++i) {
        const int k = std::min(i, n - 1);
        text += fmt::format("{:10.3f}{:10.3f}{:10.3f}\n", 1000 * sample(k), 1000 * sample(k + 1), 1000 * sample(k + 2));
    }
    return text;
}

} // namespace stylobate
