#include "io/store/result_file.hpp"

#include "ensemble/model/input_error.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

namespace stylobate {
namespace {

namespace names = result_names;

/// In /realizations/chunk_checksum: 2^32 + CRC-32. Zero, which no checksum is, stands for a chunk that is not written.
std::uint64_t checksum_of(std::span<const std::byte> bytes)
{
    return (std::uint64_t{1} << 32) | crc32_of(bytes);
}

std::vector<double> read_axis(hid_t file, const std::string& path)
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
    if (hdf5::has_attribute(file, names::build))
        header.build = hdf5::read_text(file, names::build);
    if (hdf5::has_attribute(file, names::study_crc32))
        header.study_crc32 = static_cast<std::uint32_t>(hdf5::read_number(file, names::study_crc32));
    if (hdf5::has_attribute(file, names::dimensions))
        header.dimensions = static_cast<int>(hdf5::read_number(file, names::dimensions));
    header.total = hdf5::read_number(file, "realizations");
    header.first = hdf5::read_number(file, "first_realization");
    header.selected = hdf5::has_attribute(file, names::selected);
    if (hdf5::has_attribute(file, names::shard)) {
        const std::string text = hdf5::read_text(file, names::shard);
        const std::optional<Shard> shard = Shard::from_text(text);
        if (!shard)
            throw hdf5::Error("'" + text + "' is no shard");
        header.shard = *shard;
    }
    if (hdf5::has_attribute(file, names::warnings))
        header.warnings = split_names(hdf5::read_text(file, names::warnings));
    const bool counted = hdf5::exists(file, names::tally);
    const hdf5::Handle input = hdf5::open_group(file, counted ? names::tally : names::input);
    std::istringstream order(hdf5::read_text(input.id(), names::input_order));
    for (std::string name; order >> name;)
        header.input_names.push_back(name);
    const hdf5::Handle outcome = hdf5::open_group(file, counted ? names::tally : names::outcome);
    header.block_names = split_names(hdf5::read_text(outcome.id(), names::blocks));
    if (!counted && hdf5::has_attribute(outcome.id(), names::beds))
        header.bed_names = split_names(hdf5::read_text(outcome.id(), names::beds));
    if (counted) {
        header.limit_states = split_names(hdf5::read_text(outcome.id(), names::limit_states));
        if (header.limit_states.empty())
            throw hdf5::Error("it counts no limit state");
    }
    if (hdf5::exists(file, names::surface)) {
        const std::string group = std::string(names::surface) + "/";
        if (hdf5::exists(file, group + direction_rows.key))
            header.direction_deg = read_axis(file, group + direction_rows.key);
        else
            header.frequency_hz = read_axis(file, group + frequency_rows.key);
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

/// A title changes nothing that is computed.
std::string without_title(const std::string& study_toml)
{
    std::istringstream in(study_toml);
    std::string out;
    for (std::string line; std::getline(in, line);)
        if (!line.starts_with("title = "))
            out += line + (in.eof() ? "" : "\n");
    return out;
}

/// Where two study texts part, for a message; nullopt if they are the same but for their titles.
std::optional<std::string> text_difference(const std::string& text_in_file, const std::string& text_asked)
{
    const std::string in_file = without_title(text_in_file), asked = without_title(text_asked);
    std::istringstream a(in_file);
    std::istringstream b(asked);
    for (int line = 1;; ++line) {
        std::string left;
        std::string right;
        const bool more_left = static_cast<bool>(std::getline(a, left));
        const bool more_right = static_cast<bool>(std::getline(b, right));
        if (!more_left && !more_right)
            return in_file == asked ? std::nullopt : std::optional("its study text ends differently");
        if (more_left != more_right || left != right)
            return "line " + std::to_string(line) + " of the study is\n    " +
                   (more_left ? left : "(the end of the text)") + "\n  in the file and\n    " +
                   (more_right ? right : "(the end of the text)") + "\n  in the study that was given";
    }
}

} // namespace

std::filesystem::path beside(const std::filesystem::path& file, const char* suffix)
{
    return file.parent_path() / (file.filename().string() + suffix);
}

std::uint32_t study_crc32_of(const ResultHeader& header)
{
    return crc32_of(std::as_bytes(std::span(header.study_toml)));
}

std::string joined_inputs(const ResultHeader& header)
{
    std::string order;
    for (const std::string& name : header.input_names)
        order += (order.empty() ? "" : " ") + name;
    return order;
}

void write_header(hid_t file, const ResultHeader& header, bool complete)
{
    hdf5::write_text(file, "format", names::format);
    hdf5::write_number(file, "format_version", H5T_STD_U32LE, format_version_of(header.dimensions));
    if (header.dimensions != 2)
        hdf5::write_number(file, names::dimensions, H5T_STD_U8LE, static_cast<std::uint64_t>(header.dimensions));
    hdf5::write_text(file, "kind", header.kind);
    hdf5::write_text(file, "study_toml", header.study_toml);
    hdf5::write_number(file, "seed", H5T_STD_U64LE, header.seed);
    hdf5::write_number(file, names::study_crc32, H5T_STD_U32LE, study_crc32_of(header));
    hdf5::write_text(file, "code_version", header.code_version);
    if (header.build)
        hdf5::write_text(file, names::build, *header.build);
    hdf5::write_number(file, "realizations", H5T_STD_U64LE, header.total);
    hdf5::write_number(file, "first_realization", H5T_STD_U64LE, header.first);
    if (header.selected)
        hdf5::write_number(file, names::selected, H5T_STD_U8LE, 1);
    if (!header.shard.whole())
        hdf5::write_text(file, names::shard, header.shard.text());
    if (!header.warnings.empty())
        hdf5::write_text(file, names::warnings, joined_names(header.warnings));
    hdf5::write_number(file, "complete", H5T_STD_U8LE, complete);
    if (header.cells() > 0) {
        hdf5::create_group(file, names::surface);
        const RowQuantity& of = header.row_quantity();
        hdf5::write_array(file, std::string(names::surface) + "/" + of.key, header.rows(), {header.rows().size()},
                          of.unit);
        hdf5::write_array(file, names::surface_pga, header.pga_m_s2, {header.pga_m_s2.size()}, "m/s2");
    }
    if (const MotionTable& motions = header.motions; !motions.names.empty()) {
        const hdf5::Handle group = hdf5::create_group(file, names::motions);
        hdf5::write_text(group.id(), names::motion_names, joined_names(motions.names));
        hdf5::write_text(group.id(), names::measure_names, joined_names(motions.measures));
        hdf5::write_array(file, names::motion_values, motions.value, {motions.names.size(), motions.measures.size()},
                          "");
        hdf5::write_array(file, names::motion_exponents, motions.exponent, {motions.measures.size()}, "");
        if (!motions.shaking_end_s.empty())
            hdf5::write_array(file, names::shaking_ends, motions.shaking_end_s,
                              {motions.names.size(), motions.shaking_end_s.size() / motions.names.size()}, "s");
    }
}

void write_surface(hid_t file, const SurfaceTable& table)
{
    const hdf5::Dims dims = {table.rows().size(), table.pga_m_s2.size()};
    const std::string group = std::string(names::surface) + "/";
    visit_fields(std::type_identity<SurfaceTable>(), [&](const char* name, auto field, auto) {
        hdf5::write_array(file, group + name, table.*field, dims, "");
    });
    const hdf5::Handle opened = hdf5::open_group(file, names::surface);
    hdf5::write_text(opened.id(), "interval", table.interval);
    if (table.method.empty())
        return;
    std::vector<std::uint8_t> methods;
    for (const IntervalMethod method : table.method)
        methods.push_back(static_cast<std::uint8_t>(method));
    hdf5::write_bytes(file, group + "method", method_type().id(), methods, dims);
    hdf5::write_real(opened.id(), "half_width", table.half_width);
    hdf5::write_number(opened.id(), "rounds", H5T_STD_U64LE, table.rounds);
}

bool has_all_cells(const SurfaceTable& surface)
{
    bool all = true;
    visit_fields(std::type_identity<SurfaceTable>(),
                 [&](auto, auto field, auto) { all = all && (surface.*field).size() == surface.cells(); });
    return all;
}

void check_table(const ResultHeader& header, const SurfaceTable& table)
{
    if (table.cells() == 0 || table.axes() != header.axes())
        throw std::invalid_argument("the surface's axes are not those that its file was created with");
    if (!has_all_cells(table))
        throw std::invalid_argument("the surface's table is not (nf x np)");
}

std::optional<std::string> study_difference(const ResultHeader& found, bool complete, const ResultHeader& asked)
{
    if (auto text = text_difference(found.study_toml, asked.study_toml))
        return text;
    if (found.kind != asked.kind)
        return "its kind is '" + found.kind + "' instead of '" + asked.kind + "'";
    if (found.dimensions != asked.dimensions)
        return "its structure has " + std::to_string(found.dimensions) + " dimensions instead of " +
               std::to_string(asked.dimensions);
    if (found.seed != asked.seed)
        return "its seed is " + std::to_string(found.seed) + " instead of " + std::to_string(asked.seed);
    const bool fewer = complete && found.selected; // a finished file has the rows that were needed
    if (found.total != asked.total && !fewer)
        return "it has " + std::to_string(found.total) + " realizations instead of " + std::to_string(asked.total);
    if (found.selected != asked.selected)
        return "its rows are selected by another method";
    if (found.limit_states != asked.limit_states)
        return found.has_rows() == asked.has_rows() ? "it counts other limit states"
               : found.has_rows()                   ? "it keeps a row of each realization"
                                                    : "it keeps no rows of its realizations";
    if (found.first != asked.first)
        return "it begins with realization " + std::to_string(found.first) + " instead of " +
               std::to_string(asked.first);
    if (found.input_names != asked.input_names)
        return "its inputs have other names";
    if (found.block_names != asked.block_names)
        return "its blocks have other names";
    if (found.bed_names != asked.bed_names)
        return "its beds have other names";
    if (found.axes() != asked.axes())
        return "its surface has other axes";
    if (found.motions != asked.motions)
        return "its motions differ";
    return std::nullopt;
}

void check_same_study(const ResultFile& file, const ResultHeader& asked)
{
    const ResultHeader& found = file.header;
    const auto refuse = [&](const std::string& text) { throw InputError(file.path.string(), 0, text); };
    if (const auto other = study_difference(found, file.complete, asked))
        refuse("holds the results of another study: " + *other + ". Remove the file, or choose another output (-o).");
    if (found.code_version != asked.code_version)
        refuse("was begun by version " + found.code_version + " and this is version " + asked.code_version +
               ", whose results may differ bitwise. " +
               (file.complete ? "It is complete; choose another output to run the study again."
                              : "Finish it with the old version, or choose another output."));
    const std::string part = "shard " + found.shard.text();
    if (file.complete || found.shard == asked.shard)
        return;
    refuse(found.shard.whole() ? "is of all of the study. Continue it without --shard, or choose another output (-o)."
                               : "is of " + part + " of the study. Continue it with --" + part +
                                     ", choose another output (-o), or merge it with the other shards.");
}

void check_unfinished(const ResultFile& file, const ResultHeader& asked)
{
    check_same_study(file, asked);
    if (file.complete)
        throw InputError(file.path.string(), 0, "is already complete. Choose another output to run the study again.");
}

std::optional<std::uint64_t> RowNumbers::of(std::uint64_t index) const
{
    if ((in_order_ || !scattered_) && (index < first_ || index - first_ >= rows_))
        return std::nullopt;
    const std::uint64_t at = index - first_;
    if (in_order_)
        return at;
    if (!after_.empty())
        return after_[at] > 0 ? std::optional(after_[at] - 1) : std::nullopt;
    const auto found = place_.find(index);
    return found == place_.end() ? std::nullopt : std::optional(found->second);
}

bool RowNumbers::add(std::uint64_t index, std::uint64_t place)
{
    // as many as the file announces may never come: there is a place for each only once there are enough of them
    constexpr std::uint64_t few = 1 << 12, sparse = 32;
    if (!scattered_ && after_.empty() && (rows_ <= few || place_.size() >= rows_ / sparse)) {
        after_.resize(rows_);
        for (const auto& [known, at] : place_)
            after_[known - first_] = at + 1;
        place_.clear();
    }
    const bool is_new =
        after_.empty() ? place_.emplace(index, place).second : std::exchange(after_[index - first_], place + 1) == 0;
    added_ += is_new;
    return is_new;
}

void RowNumbers::for_each(const std::function<void(std::uint64_t)>& f) const
{
    for (const std::uint64_t after : after_)
        if (after > 0)
            f(after - 1);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> sorted(place_.begin(), place_.end());
    std::sort(sorted.begin(), sorted.end());
    for (const auto& [index, place] : sorted)
        f(place);
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
    case Stored::i64:
        return copy(H5T_STD_I64LE);
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

ResultRow ResultFile::decode(std::uint64_t k, std::span<const std::byte> bytes) const
{
    try {
        return layout.decode(k, bytes);
    } catch (const std::invalid_argument& error) {
        refuse_damaged(error.what());
    }
}

void ResultFile::read_journal(
    const std::function<void(const ResultRow&, const RowJournal::Record&)>& row,
    const std::function<void(const RowJournal::Record&, std::span<const std::byte>)>& trajectory)
{
    journal.read(handle, [&](const RowJournal::Record& record, std::span<const std::byte> content) {
        if (record.kind == RowJournal::Kind::trajectory)
            trajectory(record, content);
        else if (content.size() != layout.row_bytes())
            refuse_damaged("a row has another size");
        else
            row(decode(0, content), record);
    });
}

void ResultFile::refuse_damaged(const std::string& text) const
{
    throw InputError(path.string(), 0,
                     "is damaged: " + text + ". Use a backup copy, or run the study again into another file.");
}

namespace {

/// @returns nothing if the file was replaced meanwhile
std::optional<ResultFile> try_to_open(const std::filesystem::path& path, bool writable)
{
    ResultFile result;
    result.path = path;
    result.handle = FileHandle::open(path, writable);
    if (writable && !result.handle.try_lock())
        throw InputError(path.string(), 0,
                         "is being written by another run; wait for its end, or choose another output");
    const Seal seal = check_seal(result.handle, path.string());
    const std::vector<Extent>& extents = seal.extents;
    try {
        try {
            result.hdf5 = hdf5::open_file(path, false);
        } catch (const hdf5::Error&) {
            FileHandle::open(path, false); // refuses where the process may open no more files, which is no damage
            throw;
        }
        if (!result.handle.is_at(path))
            return std::nullopt;
        const hid_t file = result.hdf5.id();
        if (hdf5::read_text(file, "format") != names::format)
            result.refuse_damaged("its format has another name");
        if (hdf5::read_number(file, "format_version") != seal.version)
            result.refuse_damaged("its two format versions differ");
        result.header = read_header(file);
        if (format_version_of(result.header.dimensions) != seal.version)
            result.refuse_damaged("its structure has other dimensions than its format version says");
        result.complete = hdf5::read_number(file, "complete") != 0;
        if (!result.header.has_rows()) {
            if (!extents.empty())
                result.refuse_damaged("it has no rows, but a data set for them");
            return result;
        }
        // a row has some bytes in the file, so that a larger number is wrong before anything is allocated for it
        if ((result.complete && result.header.total > result.handle.size()) ||
            result.header.block_names.size() > result.handle.size())
            result.refuse_damaged("it is too small for the rows that it announces");
        result.layout = ResultLayout(result.header);
        if (result.complete) {
            result.places = find_rows(file, result.layout);
        } else {
            if (extents.size() != 1 || extents[0].size != 0)
                result.refuse_damaged("it is not complete, but has no space for rows");
            result.journal = RowJournal(extents[0].offset);
            return result;
        }
    } catch (const hdf5::Error& error) {
        result.refuse_damaged(error.what());
    } catch (const std::invalid_argument& error) {
        result.refuse_damaged(error.what());
    }
    if (result.places.extents(result.layout) != extents)
        result.refuse_damaged("its rows are not at their expected position");
    return result;
}

} // namespace

ResultFile open_result(const std::filesystem::path& path, bool writable)
{
    // a run that keeps counts replaces its file now and then: the new one is as good
    constexpr int patience = 50;
    for (int i = 0; i < patience; ++i)
        if (std::optional<ResultFile> opened = try_to_open(path, writable))
            return std::move(*opened);
    throw InputError(path.string(), 0, "was replaced repeatedly while it was opened; try again");
}

} // namespace stylobate
