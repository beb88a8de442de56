#pragma once
/// Small ground-motion files of each format, made up, and what is in them.

#include "ensemble/model/input_error.hpp"
#include "io/records/record.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace stylobate {

constexpr double g = 9.80665;

/// A folder of its own for each test, and the two ends of a file: its records, or the message that refuses it.
class RecordFiles : public ::testing::Test {
protected:
    void SetUp() override
    {
        folder_ = std::filesystem::temp_directory_path() /
                  fmt::format("stylobate-record-{}-{}", getpid(),
                              ::testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path file(const std::string& content, const std::string& name = "record.txt")
    {
        std::filesystem::remove(folder_ / name); // some file systems are slow to overwrite
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return folder_ / name;
    }

    /// The message with which the content is refused; a failure if it is taken.
    std::string refusal(const std::string& content, const std::string& unit = "", const std::string& component = "")
    {
        try {
            read_record(file(content), component, unit);
        } catch (const InputError& error) {
            return error.what();
        }
        ADD_FAILURE() << "not refused:\n" << content.substr(0, 400);
        return {};
    }

    std::filesystem::path folder_;
};

/// The message with which a text in memory is refused, whichever of its components is at fault; empty if it is taken.
inline std::string message_for(const std::string& content, const std::string& unit = "")
{
    try {
        read_records(content, "record.txt", unit);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

inline void expect_says(const std::string& message, const std::vector<std::string>& parts)
{
    for (const std::string& part : parts)
        EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: " << message;
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by)
{
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

/// With another line end than "\n".
inline std::string with_ends(const std::string& text, const std::string& end)
{
    std::string changed;
    for (const char c : text)
        changed += c == '\n' ? end : std::string(1, c);
    return changed;
}

/// Sample i of all files made here [file's unit]: whole thousandths, so that they are exact in print. The first of the
/// largest values, -0.05, is sample 0.
inline double sample(int i)
{
    return (i * 37 % 101 - 50) / 1000.0;
}

inline void expect_samples(const Record& record, std::size_t n, double factor, int shift = 0)
{
    ASSERT_EQ(record.acceleration_m_s2.size(), n);
    for (std::size_t i = 0; i < n; ++i)
        ASSERT_NEAR(record.acceleration_m_s2[i], factor * sample(static_cast<int>(i) + shift), 1e-12) << i;
}

/// n values as `print` writes them, so many to a line.
inline std::string rows(int n, int per_line, const std::function<std::string(int)>& print)
{
    std::string text;
    for (int i = 0; i < n; ++i) {
        text += print(i);
        if (i % per_line == per_line - 1 || i == n - 1)
            text += '\n';
    }
    return text;
}

inline std::string at2(const std::string& size_line, int n, const std::string& end = "\n", int per_line = 5)
{
    return with_ends("PEER NGA STRONG MOTION DATABASE RECORD\n"
                     "Imperial Valley-02, 5/19/1940, El Centro Array #9, 180\n"
                     "ACCELERATION TIME SERIES IN UNITS OF G\n" +
                         size_line + "\n" + rows(n, per_line, [](int i) { return fmt::format("{:15.7E}", sample(i)); }),
                     end);
}

inline std::string at2(int n = 23)
{
    return at2(fmt::format("NPTS={:6}, DT=   .0100 SEC,", n), n);
}

inline std::string columns(int n = 12, int components = 1, const std::string& separator = "  ", double first_time = 0)
{
    std::string text;
    for (int i = 0; i < n; ++i) {
        text += fmt::format("{:.4f}", first_time + 0.005 * i);
        for (int c = 0; c < components; ++c)
            text += fmt::format("{}{:.4f}", separator, sample(i + c));
        text += "\n";
    }
    return text;
}

/// Rows of zeros as the headers of agencies have them, with some of them set: {place counted from 0, value}.
inline std::string header_numbers(int n, int per_line, int width, int decimals,
                                  const std::vector<std::pair<int, double>>& set, double others = 0)
{
    return rows(n, per_line, [&](int i) {
        double value = others;
        for (const auto& [place, v] : set)
            if (place == i)
                value = v;
        return fmt::format("{:{}.{}f}", value, width, decimals);
    });
}

/// A channel of CSMIP volume 1: g, 8F9.6, 200 samples a second.
inline std::string csmip_v1_channel(int number, const std::string& orientation, int n, int shift = 0)
{
    double peak = 0;
    for (int i = 0; i < n; ++i)
        peak = std::max(peak, std::fabs(sample(i + shift)));
    return fmt::format("Uncorrected Accelerogram Data             Processed: 01/02/03, XYZ\n"
                       "Record of Wed Jan 1, 2003 10:00:00.0 PST\n"
                       "Preliminary Processing            (Origin:  To be determined)\n"
                       "00001-L0000-03001.01                 Start time:  1/ 1/03\n"
                       "Station No. 00001   38.000N, 123.000W      s/n 0  (2 Chns of  2 at Sta)\n"
                       "Some Where                                Agency\n"
                       "Chan {:2}: {}\n"
                       "Made-up Event of Jan 1, 2003\n"
                       "Hypocenter:  To be determined.               ML:  To be determined.\n"
                       "Instr Period =  .0100 sec,  Damping =  .600,  Sensitivity = 1.00  v/g\n"
                       "No. of Points =  {}  Record Length = {:.3f} sec   at 200 Samples/sec\n"
                       "Units of uncor data are sec and g .        Max  =  {:6.3f} g , at    .000 sec.\n"
                       "RMS calc for complete record =        .\n",
                       number, orientation, n, n / 200.0, peak) +
           header_numbers(100, 16, 5, 0, {}) + header_numbers(50, 8, 10, 7, {{6, peak}}) +
           fmt::format("{:6} Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)  \n", n) +
           rows(n, 8, [=](int i) { return fmt::format("{:9.6f}", sample(i + shift)); }) +
           fmt::format("/&  ----------  End of Data for Channel {:2}  ----------\n", number);
}

inline std::string csmip_v1()
{
    return csmip_v1_channel(1, "360 Deg", 23) + csmip_v1_channel(2, " Up", 21, 4);
}

/// One of the three series of a volume 2 channel, in thousandths of its unit times 1000.
inline std::string csmip_v2_series(const std::string& name, const std::string& unit, int n, int shift)
{
    return fmt::format("{:5} POINTS OF {} DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: {})\n", n, name, unit) +
           rows(n, 8, [=](int i) { return fmt::format("{:10.3f}", 1000 * sample(i + shift)); });
}

/// A channel of CSMIP volume 2: cm/s2, 8F10.3, 50 samples a second, with velocity and displacement.
inline std::string csmip_v2_channel(int number, const std::string& orientation, int n, int shift = 0,
                                    double peak_cm_s2 = -50)
{
    std::string text = fmt::format("CORRECTED ACCELEROGRAM   00001-S0000-03001.01       CHAN {:2}: {:7}     FROM\n"
                                   "UNCORRECTED ACCELEROGRAM DATA              PROCESSED:  1/02/03\n"
                                   "MADE-UP EARTHQUAKE\n"
                                   "STATION NO. 00001   38.000N, 123.000W     S/N 0\n"
                                   "SOME WHERE\n"
                                   "CHAN {:2}: {}\n"
                                   "MADE-UP EARTHQUAKE     JAN 1, 2003 10:00 PST\n"
                                   "{:6} POINTS OF INSTRUMENT- AND BASELINE-CORRECTED ACCEL, VELOC AND DISPL DATA\n"
                                   "AT EQUALLY-SPACED INTERVALS OF    .020  SEC.\n"
                                   "PEAK ACCELERATION = {:9.3f}    CM/SEC/SEC  AT     .000   SEC.\n"
                                   "PEAK   VELOCITY   =    50.000      CM/SEC    AT     .000   SEC.\n\n",
                                   number, orientation, number, orientation, n, peak_cm_s2);
    text += header_numbers(100, 16, 5, 0, {}) + header_numbers(100, 8, 10, 3, {});
    text += csmip_v2_series("ACCEL", "CM/SEC/SEC", n, shift);
    text += csmip_v2_series("VELOC", "CM/SEC", n, shift + 1);
    text += csmip_v2_series("DISPL", "CM", n, shift + 2);
    return text + fmt::format("/&  ----------  END OF DATA FOR CHANNEL {:2}  ----------\n", number);
}

/// Three channels whose counts differ, as those of one film do.
inline std::string csmip_v2()
{
    return csmip_v2_channel(1, " 90 DEG", 25) + csmip_v2_channel(2, "UP", 24, 3, 49) +
           csmip_v2_channel(3, "  0 DEG", 24, 0);
}

/// A component of BHRC volume 1: g/10, 10E13.6 without the leading zero, 200 samples a second.
inline std::string bhrc_component(const std::string& component, int n, int shift = 0)
{
    const auto fortran = [](double value) { // .921041E-02
        if (value == 0)
            return std::string(" .000000E+00");
        const int exponent = static_cast<int>(std::floor(std::log10(std::fabs(value)))) + 1;
        return fmt::format("{}.{:06.0f}E{:+03}", value < 0 ? '-' : ' ',
                           std::round(std::fabs(value) / std::pow(10, exponent - 6)), exponent);
    };
    const auto cut = [](const std::string& numbers) { // the agency's own lines stop at column 70
        std::string text, line;
        for (const char c : numbers) {
            if (c == '\n')
                text += line.substr(0, 70) + '\n';
            if (c == '\n')
                line.clear();
            else
                line += c;
        }
        return text;
    };
    return fmt::format("* VOL1DS FILE:  0001/01\nInst Type = XYZ\nOrigin Time : 2003/01/01   10:00:00\n\n{}\n      \n"
                       "COMP {}                                                               \n"
                       "Some Where                Station   37.000 N 47.000 E   Altitude 10m   Azimuth L 50    T 140\n"
                       "Epicenter 38.000 N 46.000 E   FD 10 Km Mw6.0\n"
                       "INSTR PERIOD =  .020 SEC   DAMPING =  .640\n"
                       "NO. OF POINTS = {:6}      DURATION = {:7.3f}\n"
                       "UNITS ARE SECONDS AND G/10\n      \n",
                       component.substr(0, 1), component, n, n / 200.0) +
           cut(header_numbers(100, 16, 5, 0, {})) +
           cut(rows(50, 8, [&](int i) { return fmt::format("{:>13}", fortran(i == 8 ? 200 : 0)); })) +
           rows(n, 10, [&](int i) { return fmt::format("{:>13}", fortran(sample(i + shift))); }) + "/&\n";
}

inline std::string bhrc()
{
    return bhrc_component("L1", 22) + bhrc_component("V2", 22, 1) + bhrc_component("T3", 20, 2);
}

/// Milliseconds from sample to sample in turn, as of a film.
constexpr int usc_steps_ms[] = {4, 4, 5, 4, 13};

inline int usc_time_ms(int i)
{
    int time = 0;
    for (int k = 0; k < i; ++k)
        time += usc_steps_ms[k % 5];
    return time;
}

/// A component of USC volume 1: time and value, 1X,10F7.3. Values in g/10.
inline std::string usc(int n = 21, const std::function<int(int)>& time_ms = usc_time_ms,
                       const std::function<double(int)>& value = sample)
{
    return fmt::format("FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:                        \n"
                       "MADE-UP EARTHQUAKE                                                      21      \n"
                       "JAN 1, 2003 -1000 GMT                                                   22      \n"
                       "XYZ101  03.001.0 N                                                      18      \n"
                       "STATION USC# 0001   38 00 00N, 118 00 00N                               39      \n"
                       "SOME WHERE                                                              34\n"
                       "COMP N90E                                                               9       \n"
                       "MADE-UP EARTHQUAKE   JAN 1, 2003 -1000 GMT                              46      \n"
                       "EPICENTER -   38 00 00N, 118 00 00W                                     35      \n"
                       "INSTR PERIOD =  .038 SEC  DAMPING =   .558  SENSITIVITY =   1.75CM/G    69      \n"
                       "NO. OF POINTS = {:6}      DURATION ={:8.3f} SEC                      50      \n"
                       "UNITS ARE SEC AND G/10                                                  22      \n"
                       "RMS ACCLN. OF COMPLETE RECORD =     .400 G/10                           45      \n",
                       n, time_ms(n - 1) / 1000.0) +
           header_numbers(100, 16, 5, 0, {}) + header_numbers(50, 8, 10, 3, {}) + rows(n, 5, [&](int i) {
               return fmt::format("{}{:7.3f}{:7.3f}", i % 5 == 0 ? " " : "", time_ms(i) / 1000.0, value(i));
           });
}

/// A value as 1PE10.4E1 writes it: "-2.2223E+0".
inline std::string smc_value(double value)
{
    const int exponent = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::fabs(value)) + 1e-12));
    return fmt::format("{}{:.4f}E{:+}", value < 0 ? '-' : ' ', std::fabs(value) / std::pow(10, exponent), exponent);
}

/// USGS SMC: cm/s2, 8E10.4, the values 1000 times `sample`.
inline std::string smc(int n = 21, const std::string& kind = "2 CORRECTED ACCELEROGRAM", double unknown = 1.7e38,
                       double rate = 200, double peak_cm_s2 = 50)
{
    const std::vector<std::pair<int, double>> integers = {{12, 90}, {13, 360}, {15, 2}, {16, n}};
    const auto real = [&](int i) {
        const double value = i == 1 ? rate : i == 29 ? peak_cm_s2 : i == 31 ? -49 : unknown;
        const int exponent = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::fabs(value)))) + 1;
        return fmt::format("{:>15}", fmt::format("{:.7f}E{:+03}", value / std::pow(10, exponent), exponent));
    };
    return fmt::format("{:80}\n*\nXYZ0A\n     2003   1   1    1000 Made-up, XY\nMoment Mag=      6.0\n"
                       "station = Some Where, 1 Street         component=    360\n"
                       "epicentral dist =     10.0       pk     =     50.0\ninst type=XYZ\n*\n*\n*\n",
                       kind) +
           header_numbers(48, 8, 10, 0, integers, -32768) + rows(50, 5, real) + "|\n|made up\n" +
           rows(n, 8, [](int i) { return smc_value(1000 * sample(i)); });
}

/// Largest |acceleration|.
inline double pga_of(const Record& record)
{
    double pga = 0;
    for (const double a : record.acceleration_m_s2)
        pga = std::max(pga, std::fabs(a));
    return pga;
}

} // namespace stylobate
