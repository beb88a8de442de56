#pragma once
// What the engine uses of zlib: the checksum of a record's samples (ISO 3309).

using uLong = unsigned long;
using uInt = unsigned int;
using Bytef = unsigned char;

inline uLong crc32(uLong crc, const Bytef* bytes, uInt count)
{
    crc = ~crc & 0xffffffffUL;
    for (uInt i = 0; bytes != nullptr && i < count; ++i) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit)
            crc = crc & 1 ? crc >> 1 ^ 0xedb88320UL : crc >> 1;
    }
    return bytes == nullptr ? 0 : ~crc & 0xffffffffUL;
}
