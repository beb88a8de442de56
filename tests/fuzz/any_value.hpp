#pragma once
/// Values that readers stumble over: at the ends of types and ranges, texts of other places; and ordinary ones.

#include "tests/fuzz/byte_source.hpp"

namespace stylobate::fuzz {

double any_double(ByteSource& recipe);
std::uint64_t any_count(ByteSource& recipe);
/// @param before  the text that it is put in place of, often a part of it
std::string any_text(const std::string& before, ByteSource& recipe);

} // namespace stylobate::fuzz
