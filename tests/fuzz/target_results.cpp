/// Results files. An input is a recipe: which file, and what is changed in it. Changes by the HDF5 library and of rows
/// are followed by right checksums and a right seal, so that they are met by all that comes behind these. Other bytes
/// are changed without them: then nothing but rows that were written may come out.

#include "io/store/result_file.hpp"
#include "io/store/result_store.hpp"
#include "tests/fuzz/hdf5_edits.hpp"
#include "tests/fuzz/text_mutation.hpp"
#include "tests/io/store/result_samples.hpp"

#include <map>

namespace stylobate::fuzz {
namespace {

struct Record {
    RowJournal::Kind kind = RowJournal::Kind::row;
    std::string content;
};

/// A file that is whole, in parts.
struct Original {
    std::string bytes;
    std::string head; ///< without the journal
    std::vector<Hdf5Object> objects;
    bool complete = false;
    std::uint64_t block = 0; ///< of the seal
    ResultLayout layout;     ///< without rows: empty
    RowPlaces places;        ///< of a complete file
    std::vector<Record> journal;
    std::map<std::uint64_t, ResultRow> rows;
};

ResultHeader header_of(const std::string& kind)
{
    ResultHeader header = sample_header(6);
    header.kind = kind;
    header.build = "test";
    if (kind == "fragility") {
        header.frequency_hz.clear();
        header.pga_m_s2.clear();
        header.motions = {{"a", "b"}, {"pga_m_s2", "cav_m_s"}, {1, 1}, {1, 2, 3, 4}, {5, 6}};
        header.warnings = {"one", "another"};
    }
    return header;
}

void write_rows(const std::filesystem::path& file, const ResultHeader& header, bool finished)
{
    const auto writer = ResultWriter::create(file, header);
    add_rows(*writer, 0, finished ? 6 : 4);
    writer->add(sample_trajectory(3, 2));
    if (!finished)
        return;
    SurfaceTable surface = sample_surface();
    if (header.selected) {
        surface.method.assign(6, IntervalMethod::surface);
        surface.half_width = 0.1;
        surface.rounds = 2;
    }
    Table table("fragility");
    table.set("measure", "pga_m_s2");
    table.set("level", 0.95);
    table.set("points", std::uint64_t{2});
    table.add("grid", std::vector<double>{1, 2});
    table.add("motion", std::vector<std::int32_t>{0, 1});
    table.add("trials", std::vector<std::uint64_t>{3, 4});
    table.add("states", std::vector<std::string>{"collapse", "any"});
    writer->finish(header.frequency_hz.empty() ? nullptr : &surface, {table});
}

void write_counts(const std::filesystem::path& file, bool finished)
{
    ResultHeader header = header_of("surface");
    header.limit_states = {"collapse", "total"};
    const auto writer = TallyWriter::create(file, header);
    for (std::uint64_t i = 0; i < (finished ? 6u : 3u); ++i)
        writer->add({i, i, i == 1 ? InvalidReason::energy : InvalidReason::none, static_cast<std::uint32_t>(i % 4),
                     static_cast<std::int32_t>(i % 3), 1.5 * static_cast<double>(i), -1, 1e-6});
    if (finished)
        writer->finish(sample_surface());
}

Original taken_apart(const std::filesystem::path& file)
{
    Original original;
    original.bytes = original.head = file_content(file);
    original.objects = objects_in(file);
    original.block = original.bytes.find("\x89HDF\r\n\x1a\n");
    const ResultFile opened = open_result(file, false);
    original.complete = opened.complete;
    original.layout = opened.layout;
    original.places = opened.places;
    const ResultReader reader(file);
    if (!opened.header.has_rows())
        return original;
    for (const ResultRow& row : reader.rows())
        original.rows[row.index] = row;
    if (opened.complete)
        return original;
    original.head.resize(check_seal(opened.handle, "original").extents.front().offset);
    RowJournal(original.head.size()).read(opened.handle, [&](const RowJournal::Record& record, auto content) {
        original.journal.push_back({record.kind, {reinterpret_cast<const char*>(content.data()), content.size()}});
    });
    return original;
}

const std::vector<Original>& originals()
{
    static const std::vector<Original> all = [] {
        std::vector<Original> made;
        const auto add = [&](const char* name, const auto& write) {
            const std::filesystem::path file = folder() / name;
            write(file);
            made.push_back(taken_apart(file));
        };
        ResultHeader selected = header_of("surface");
        selected.selected = true;
        add("whole.h5", [](const auto& file) { write_rows(file, header_of("surface"), true); });
        add("begun.h5", [](const auto& file) { write_rows(file, header_of("surface"), false); });
        add("counted.h5", [](const auto& file) { write_counts(file, true); });
        add("counting.h5", [](const auto& file) { write_counts(file, false); });
        add("adaptive.h5", [&](const auto& file) { write_rows(file, selected, true); });
        add("adapting.h5", [&](const auto& file) { write_rows(file, selected, false); });
        add("fragility.h5", [](const auto& file) { write_rows(file, header_of("fragility"), true); });
        return made;
    }();
    return all;
}

/// All that a program asks of a reader.
void read_all(const ResultReader& reader)
{
    const ResultHeader& header = reader.header();
    promise(reader.done() <= header.total, "more realizations are done than there are");
    const std::vector<ResultRow> rows = reader.rows();
    std::uint64_t one_by_one = 0;
    reader.for_each_row([&](const ResultRow&) { ++one_by_one; });
    promise(rows.size() == one_by_one, "the rows are others one by one");
    if (header.has_rows())
        promise(reader.done() == rows.size(), "another number of realizations is done than has rows");
    for (const ResultRow& row : rows) {
        promise(reader.has(row.index), "a row is there, but not its realization");
        promise(same_bits(reader.row(row.index), row), "a row is another one by its index");
        promise(row.outcome.fall_time_s.size() == header.block_names.size(), "a row has other blocks");
        promise(row.inputs.size() == header.input_names.size(), "a row has other inputs");
    }
    const SurfaceTable surface = reader.surface();
    promise(surface.trials.size() == surface.frequency_hz.size() * surface.pga_m_s2.size(),
            "a surface has another shape than its axes");
    for (const char* name : {"fragility", "sensitivity", "rare"})
        reader.table(name);
    for (const std::uint64_t index : reader.trajectory_indices())
        check_trajectory(reader.trajectory(index), header.dimensions);
    reader.unread();
    if (const Tally* tally = reader.tally())
        promise(tally->added() == reader.counted()->all().end, "other realizations are counted than are done");
}

/// Bytes of the file as it was written: changed, cut, or more behind the end.
Verdict damaged(const Original& original, const std::filesystem::path& file, ByteSource& recipe)
{
    const std::string bytes = damaged_bytes(original.bytes, recipe);
    write_file(file, bytes);
    return judged([&] {
        const ResultReader reader(file);
        read_all(reader);
        promise(bytes == original.bytes || !original.complete, "a damaged file is taken for a complete one");
        for (const ResultRow& row : reader.rows()) {
            const auto written = original.rows.find(row.index);
            promise(written != original.rows.end() && same_bits(written->second, row), "a row comes out of damage");
        }
    });
}

void change_row(FileHandle& handle, const Original& original, const RowPlaces& places, ByteSource& recipe)
{
    const std::size_t column = recipe.below(places.column.size());
    const std::uint64_t bytes = original.layout.columns()[column].bytes;
    const std::uint64_t row = recipe.below(original.layout.rows());
    std::string value = recipe.text(8);
    value.resize(std::min<std::size_t>(value.size(), bytes));
    handle.write(places.column[column] + row * bytes, std::as_bytes(std::span(value)));
}

/// Where the rows are, after changes by the HDF5 library.
RowPlaces places_in(const std::filesystem::path& path, const Original& original)
{
    try {
        return find_rows(hdf5::open_file(path, false).id(), original.layout);
    } catch (const hdf5::Error&) {
        return original.places; // where they were
    }
}

/// Rows changed, with right checksums.
void repair_chunks(const std::filesystem::path& path, const Original& original, const RowPlaces& places,
                   ByteSource& recipe)
{
    ResultFile file;
    file.layout = original.layout;
    file.places = places;
    file.handle = FileHandle::open(path, true);
    for (std::size_t changes = recipe.below(4); changes > 0 && !recipe.empty(); --changes)
        change_row(file.handle, original, file.places, recipe);
    const ResultLayout& layout = file.layout;
    for (std::uint64_t chunk = 0; chunk < layout.chunks(); ++chunk) {
        std::vector<std::byte> bytes(layout.row_bytes() * layout.rows_in(chunk));
        for (std::size_t i = 0; i < layout.columns().size(); ++i)
            file.handle.read(
                file.places.column[i] + layout.first_row(chunk) * layout.columns()[i].bytes,
                std::span(bytes).subspan(layout.begin_in_chunk(i, chunk), layout.bytes_in_chunk(i, chunk)));
        file.write_chunk(chunk, bytes);
    }
    write_seal(file.handle, original.block, file.places.extents(layout));
}

/// The journal, its records changed and with right checksums.
void append_journal(const std::filesystem::path& path, const Original& original, ByteSource& recipe)
{
    std::vector<Record> records = original.journal;
    while (!recipe.empty() && !records.empty()) {
        Record& record = records[recipe.below(records.size())];
        const std::size_t at = recipe.below(record.content.size());
        switch (const std::uint8_t how = recipe.byte(); how % 8) {
        case 0:
            record.content.resize(at);
            break;
        case 1:
            records.push_back(Record(record));
            break;
        case 2:
            record.kind = record.kind == RowJournal::Kind::row ? RowJournal::Kind::trajectory : RowJournal::Kind::row;
            break;
        case 3:
            record.content.insert(at, recipe.text(16));
            break;
        default: { // of numbers of eight bytes one
            const std::string value = recipe.text(8);
            const std::size_t begin = how % 8 < 6 ? at / 8 * 8 : at;
            record.content.replace(std::min(begin, record.content.size()), value.size(), value);
        }
        }
    }
    FileHandle handle = FileHandle::open(path, true);
    write_open_seal(handle, original.block);
    RowJournal journal(handle.size());
    for (const Record& record : records)
        journal.append(handle, record.kind, std::as_bytes(std::span(record.content)));
}

Verdict judge(std::string_view input)
{
    ByteSource recipe(input);
    const std::filesystem::path file = folder() / "results.h5";
    const Original& original = originals()[recipe.below(originals().size())];
    const std::uint8_t how = recipe.byte();
    if (how % 4 == 0)
        return damaged(original, file, recipe);
    write_file(file, original.head);
    const bool edited = how % 4 != 1;
    if (edited && !edit_hdf5_file(file, original.objects, recipe, how / 4 % 4 + 1))
        return Verdict::refused;
    if (!original.complete && !original.rows.empty()) {
        append_journal(file, original, recipe);
    } else if (original.complete && !original.rows.empty()) {
        repair_chunks(file, original, edited ? places_in(file, original) : original.places, recipe);
    } else {
        FileHandle handle = FileHandle::open(file, true);
        write_seal(handle, original.block, {});
    }
    return judged([&] { read_all(ResultReader(file)); });
}

} // namespace

const Target results_target = {"results", judge, mutated_bytes, 256, 500};

} // namespace stylobate::fuzz
