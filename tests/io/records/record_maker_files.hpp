#pragma once
/// Small files in the manner of many makers, made up: what is public and has no agency's format of its own.

#include "tests/io/records/record_network_files.hpp"

namespace stylobate {

/// Turkey's NSMN: a header in words, a column for each component [gal], 1000 times `sample`.
inline std::string nsmn(int n = 21)
{
    return fmt::format("STRONG GROUND MOTION RECORDS OF TURKIYE\n"
                       "PLACE                   : SOME WHERE\n"
                       "EARTHQUAKE DATE         : 01/01/2003 10:00:00 (GMT)\n"
                       "NUMBER OF DATA          : {}\n"
                       "SAMPLING INTERVAL (sec) : 0.01\n"
                       "RAW PGA VALUES (gal)    : (N-S) 50.0 (E-W) 50.0 (U-D) 50.0\n\n"
                       "     N-S          E-W          U-D\n",
                       n) +
           rows(3 * n, 3, [](int i) { return fmt::format("{:12.6f} ", 1000 * sample(i / 3 + i % 3)); });
}

/// The European data base, files "cor": five values to a line [m/s2].
inline std::string european(int n = 23, const std::string& quantity = "Accelaration time series in m/s/s")
{
    return fmt::format("Event Date & Time             : 2003-01-01 10:00:00\n"
                       "Station Code / Name           : 1 / Some Where\n"
                       "Orientation                   : NS\n"
                       "Filter Cut-off Frequency (Hz) : 0.100 - 18.000\n"
                       "Time Increment (s)            : 0.005\n"
                       "Number of Data                : {}\n"
                       "PGA (m/s/s)                   : 5.0000000E-02\n"
                       "{}\n",
                       n, quantity) +
           rows(n, 5, [](int i) { return fmt::format(" {:.7E}", sample(i)); });
}

/// A name, the size, one value to a line.
inline std::string named_size(int n = 23, const std::string& size = "23 0.0050")
{
    return "motion 1\n" + size + "\n" + rows(n, 1, [](int i) { return fmt::format("{:.6f}", sample(i)); });
}

/// Chile's RENADIC: the text and numbers of CSMIP's volume 1, then pairs of time and value [g/10], 10F7.3.
inline std::string renadic(int n = 23, const std::string& above = "")
{
    return fmt::format("UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 01/02/2003\n"
                       "MADE-UP EVENT\n01/01/2003 10:00:00 (GMT)\n          TRIGGER TIME: 1/01/2003 10:00:10.000 GMT\n"
                       "STATION NO. 1        0.000N    0.000E  QDR       S/N  1 (3  CHNS OF 3  AT STA)\n"
                       "SOME WHERE\nCHAN  1: EW       (STA CHN:  1)\nAGENCY\n"
                       "HYPOCENTER:   0.000N    0.000E  H=   0.0KM   ML= 0.00\n"
                       "INSTR PERIOD = 0.0390 SEC,  DAMPING =0.700,  SENSITIVITY =1.250 VDC/G\n"
                       "NO. OF POINTS = {:6}  RECORD LENGTH = {:6.3f} SEC\n"
                       "UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = -0.005 G, AT  0.000 SEC\n"
                       "RMS ACCEL OF COMPLETE RECORD = 0.006 G\n",
                       n, 0.01 * n) +
           header_numbers(100, 16, 5, 0, {}) + header_numbers(50, 8, 10, 3, {}) + above +
           rows(2 * n, 10,
                [](int i) {
                    return i % 2 == 0 ? fmt::format("{:7.3f}", 0.01 * (i / 2)) : fmt::format("{:7.3f}", sample(i / 2));
                }) +
           "/&  ----------  END OF DATA FOR CHAN  1  ----------\n";
}

/// A table of time and quantities, with a line of names above.
inline std::string named_columns(const std::string& names, int components, const std::string& separator = ",",
                                 int n = 12)
{
    return names + "\n" + columns(n, components, separator);
}

/// Numbers with an exponent letter D, as Fortran writes double precision: "-1.2500000D-02".
inline std::string with_d_exponents(std::string text)
{
    for (std::size_t i = 1; i + 1 < text.size(); ++i)
        if (text[i] == 'E' && text[i - 1] >= '0' && text[i - 1] <= '9' && (text[i + 1] == '-' || text[i + 1] == '+'))
            text[i] = 'D';
    return text;
}

inline std::string with_decimal_commas(std::string text)
{
    for (std::size_t i = 1; i + 1 < text.size(); ++i)
        if (text[i] == '.' && text[i - 1] >= '0' && text[i - 1] <= '9' && text[i + 1] >= '0' && text[i + 1] <= '9')
            text[i] = ',';
    return text;
}

inline std::string in_utf16(const std::string& text, bool mark)
{
    std::string wide = mark ? "\xff\xfe" : "";
    for (const char c : text)
        wide += {c, '\0'};
    return wide;
}

} // namespace stylobate
