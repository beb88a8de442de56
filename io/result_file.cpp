#include "io/result_file.hpp"

#include "ensemble/input_error.hpp"

#include <sstream>

namespace stylobate {
namespace {

namespace names = result_names;

/// In /realizations/chunk_checksum: 2^32 + CRC-32. Zero, which no checksum is, stands for a chunk that is not written.
std::uint64_t checksum_of(std::span<const std::byte> bytes)
{
    return (std::uint64_t{1} << 32) | crc32_of(bytes);
}

std::vector<double> read_axis(hid_t file, const char* path)
{
    const hdf5::Dims dims = hdf5::dims_of(file, path);
    if (dims.size() != 1)
        throw hdf5::Error(std::string("'") + path + "' is not a list");
    return hdf5::read_doubles(file, path, dims);
}

ResultHeader read_header(hid_t file)
{
    ResultHeader header;
    header.kind = hdf5::read_text(file, "kind");
    header.study_toml = hdf5::read_text(file, "study_toml");
    header.seed = hdf5::read_number(file, "seed");
    header.code_version = hdf5::read_text(file, "code_version");
    header.total = hdf5::read_number(file, "realizations");
    header.first = hdf5::read_number(file, "first_realization");
    header.selected = hdf5::has_attribute(file, names::selected);
    const hdf5::Handle input = hdf5::open_group(file, names::input);
    std::istringstream order(hdf5::read_text(input.id(), names::input_order));
    for (std::string name; order >> name;)
        header.input_names.push_back(name);
    const hdf5::Handle outcome = hdf5::open_group(file, names::outcome);
    header.block_names = split_names(hdf5::read_text(outcome.id(), names::blocks));
    if (hdf5::exists(file, names::surface)) {
        header.frequency_hz = read_axis(file, names::surface_frequency);
        header.pga_m_s2 = read_axis(file, names::surface_pga);
    }
    if (hdf5::exists(file, names::motions)) {
        const hdf5::Handle group = hdf5::open_group(file, names::motions);
        MotionTable& motions = header.motions;
        motions.names = split_names(hdf5::read_text(group.id(), names::motion_names));
        motions.measures = split_names(hdf5::read_text(group.id(), names::measure_names));
        motions.value = hdf5::read_doubles(file, names::motion_values, {motions.names.size(), motions.measures.size()});
        motions.exponent = hdf5::read_doubles(file, names::motion_exponents, {motions.measures.size()});
        if (hdf5::exists(file, names::shaking_ends))
            motions.shaking_end_s =
                hdf5::read_doubles(file, names::shaking_ends, hdf5::dims_of(file, names::shaking_ends));
    }
    return header;
}

} // namespace

std::optional<std::uint64_t> RowNumbers::of(std::uint64_t index) const
{
    if (selected_) {
        const auto found = number_.find(index);
        return found == number_.end() ? std::nullopt : std::optional(found->second);
    }
    return index >= first_ && index - first_ < rows_ ? std::optional(index - first_) : std::nullopt;
}

std::vector<Extent> RowPlaces::extents(const ResultLayout& layout) const
{
    std::vector<Extent> extents = {{checksum, layout.chunks() * sizeof(std::uint64_t)}};
    for (std::size_t i = 0; i < column.size(); ++i)
        extents.push_back({column[i], layout.rows() * layout.columns()[i].bytes});
    return joined(std::move(extents));
}

hdf5::Handle file_type(Stored stored)
{
    const auto copy = [](hid_t type) { return hdf5::Handle(H5Tcopy(type), H5Tclose); };
    switch (stored) {
    case Stored::state: {
        std::vector<std::pair<const char*, std::uint8_t>> members;
        for (const State state : {State::stood, State::rocked, State::slid, State::collapsed, State::invalid})
            members.emplace_back(to_string(state), static_cast<std::uint8_t>(state));
        members.emplace_back("not_run", state_not_run);
        return hdf5::byte_enumeration(members);
    }
    case Stored::invalid_reason: {
        std::vector<std::pair<const char*, std::uint8_t>> members;
        for (const InvalidReason reason : {InvalidReason::none, InvalidReason::not_finite, InvalidReason::energy})
            members.emplace_back(to_string(reason), static_cast<std::uint8_t>(reason));
        return hdf5::byte_enumeration(members);
    }
    case Stored::i32:
        return copy(H5T_STD_I32LE);
    case Stored::u64:
        return copy(H5T_STD_U64LE);
    case Stored::f64:
        return copy(H5T_IEEE_F64LE);
    }
    return {};
}

hdf5::Handle role_type()
{
    const auto number = [](BlockRole role) { return static_cast<std::uint8_t>(role); };
    return hdf5::byte_enumeration({{"drum", number(BlockRole::drum)},
                                   {"epistyle", number(BlockRole::epistyle)},
                                   {"ground", number(BlockRole::ground)}});
}

hdf5::Handle method_type()
{
    const auto number = [](IntervalMethod method) { return static_cast<std::uint8_t>(method); };
    return hdf5::byte_enumeration({{to_string(IntervalMethod::own), number(IntervalMethod::own)},
                                   {to_string(IntervalMethod::surface), number(IntervalMethod::surface)}});
}

hdf5::Dims column_dims(const ResultLayout& layout, const Column& column)
{
    return column.matrix ? hdf5::Dims{layout.rows(), column.width} : hdf5::Dims{layout.rows()};
}

RowPlaces find_rows(hid_t file, const ResultLayout& layout)
{
    RowPlaces places;
    for (const Column& column : layout.columns()) {
        const std::string path = std::string(names::realizations) + "/" + column.path;
        const auto dataset = hdf5::open_dataset(file, path, file_type(column.stored).id(), column_dims(layout, column));
        places.column.push_back(hdf5::offset_of(dataset.id()));
    }
    const auto dataset = hdf5::open_dataset(file, names::checksum, H5T_STD_U64LE, {layout.chunks()});
    if (hdf5::read_number(dataset.id(), names::rows_per_chunk) != ResultWriter::rows_per_chunk)
        throw hdf5::Error("its chunks have another size");
    places.checksum = hdf5::offset_of(dataset.id());
    return places;
}

std::optional<std::vector<std::byte>> ResultFile::read_chunk(std::uint64_t chunk) const
{
    std::uint64_t checksum = 0;
    handle.read(places.checksum + chunk * sizeof checksum, std::as_writable_bytes(std::span(&checksum, 1)));
    if (checksum == 0)
        return std::nullopt;
    std::vector<std::byte> bytes(layout.row_bytes() * layout.rows_in(chunk));
    for (std::size_t i = 0; i < layout.columns().size(); ++i)
        handle.read(places.column[i] + layout.first_row(chunk) * layout.columns()[i].bytes,
                    std::span(bytes).subspan(layout.begin_in_chunk(i, chunk), layout.bytes_in_chunk(i, chunk)));
    if (checksum != checksum_of(bytes))
        return std::nullopt;
    return bytes;
}

void ResultFile::write_chunk(std::uint64_t chunk, std::span<const std::byte> bytes)
{
    for (std::size_t i = 0; i < layout.columns().size(); ++i)
        handle.write(places.column[i] + layout.first_row(chunk) * layout.columns()[i].bytes,
                     bytes.subspan(layout.begin_in_chunk(i, chunk), layout.bytes_in_chunk(i, chunk)));
    const std::uint64_t checksum = checksum_of(bytes);
    handle.write(places.checksum + chunk * sizeof checksum, std::as_bytes(std::span(&checksum, 1)));
}

void ResultFile::refuse_damaged(const std::string& text) const
{
    throw InputError(path.string(), 0,
                     "is damaged: " + text + ". Take a copy, or run the study again into another file.");
}

ResultFile open_result(const std::filesystem::path& path, bool writable)
{
    ResultFile result;
    result.path = path;
    result.handle = FileHandle::open(path, writable);
    if (writable && !result.handle.try_lock())
        throw InputError(path.string(), 0,
                         "is being written by another run; wait for its end, or choose another output");
    const std::vector<Extent> extents = check_seal(result.handle, path.string());
    try {
        result.hdf5 = hdf5::open_file(path, false);
        if (!result.handle.is_at(path))
            throw InputError(path.string(), 0, "was replaced while it was opened; try again");
        const hid_t file = result.hdf5.id();
        if (hdf5::read_text(file, "format") != names::format)
            result.refuse_damaged("its format has another name");
        if (hdf5::read_number(file, "format_version") != result_format_version)
            result.refuse_damaged("its two format versions differ");
        result.header = read_header(file);
        result.complete = hdf5::read_number(file, "complete") != 0;
        // a row has some bytes in the file, so that a larger number is wrong before anything is allocated for it
        if (result.header.total > result.handle.size() || result.header.block_names.size() > result.handle.size())
            result.refuse_damaged("it cannot hold the rows that it promises");
        result.layout = ResultLayout(result.header);
        result.places = find_rows(file, result.layout);
    } catch (const hdf5::Error& error) {
        result.refuse_damaged(error.what());
    } catch (const std::invalid_argument& error) {
        result.refuse_damaged(error.what());
    }
    if (result.places.extents(result.layout) != extents)
        result.refuse_damaged("its rows are not where they should be");
    return result;
}

} // namespace stylobate
