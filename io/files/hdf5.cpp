#include "io/files/hdf5.hpp"

#include <algorithm>

namespace stylobate::hdf5 {
namespace {

/// Keeps the library from printing its error stack while it lives.
class Quiet {
public:
    Quiet()
    {
        H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;

private:
    H5E_auto2_t function_ = nullptr;
    void* data_ = nullptr;
};

herr_t keep_first(unsigned n, const H5E_error2_t* error, void* text)
{
    if (n == 0 && error->desc)
        *static_cast<std::string*>(text) = error->desc;
    return 0;
}

/// Calls the library in silence; a negative answer becomes an exception with the innermost reason.
template <class Function>
auto call(const std::string& what, Function function)
{
    const Quiet quiet;
    const auto answer = function();
    if (answer < 0) {
        std::string reason;
        H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
        H5Eclear2(H5E_DEFAULT);
        throw Error(what + (reason.empty() ? "" : " (" + reason + ")"));
    }
    return answer;
}

template <class Function>
Handle handle(const std::string& what, herr_t (*close)(hid_t), Function function)
{
    return Handle(call(what, function), close);
}

Handle file_access()
{
    Handle access = handle("no file access list", H5Pclose, [] { return H5Pcreate(H5P_FILE_ACCESS); });
    call("no file locking setting", [&] { return H5Pset_file_locking(access.id(), false, true); });
    return access;
}

/// For what the library converts on its way, which all texts are. Its own buffers are 1 MB, taken and zeroed anew for
/// each data set; most data sets here have some hundred bytes.
Handle small_buffer()
{
    constexpr std::size_t bytes = 65536;
    Handle transfer = handle("no transfer list", H5Pclose, [] { return H5Pcreate(H5P_DATASET_XFER); });
    call("no transfer buffer", [&] { return H5Pset_buffer(transfer.id(), bytes, nullptr, nullptr); });
    return transfer;
}

void write_values(hid_t dataset, const std::string& path, hid_t type, const void* values)
{
    const Handle transfer = small_buffer();
    call("cannot write '" + path + "'",
         [&] { return H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, transfer.id(), values); });
}

void read_values(hid_t dataset, const std::string& path, hid_t type, void* values)
{
    const Handle transfer = small_buffer();
    call("cannot read '" + path + "'", [&] { return H5Dread(dataset, type, H5S_ALL, H5S_ALL, transfer.id(), values); });
}

Handle dataspace(const Dims& dims)
{
    return handle("no data space", H5Sclose,
                  [&] { return H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr); });
}

Handle scalar()
{
    return handle("no data space", H5Sclose, [] { return H5Screate(H5S_SCALAR); });
}

Handle text_type()
{
    Handle type = handle("no text type", H5Tclose, [] { return H5Tcopy(H5T_C_S1); });
    call("no text type", [&] { return H5Tset_size(type.id(), H5T_VARIABLE); });
    call("no text type", [&] { return H5Tset_cset(type.id(), H5T_CSET_UTF8); });
    return type;
}

Handle open_attribute(hid_t object, const std::string& name)
{
    return handle("no attribute '" + name + "'", H5Aclose, [&] { return H5Aopen(object, name.c_str(), H5P_DEFAULT); });
}

Handle open_any(hid_t parent, const std::string& path)
{
    return handle("no data set '" + path + "'", H5Dclose, [&] { return H5Dopen2(parent, path.c_str(), H5P_DEFAULT); });
}

Handle type_of(hid_t dataset, const std::string& path)
{
    return handle("no type of '" + path + "'", H5Tclose, [&] { return H5Dget_type(dataset); });
}

Dims shape(hid_t dataset, const std::string& path)
{
    const Handle space = handle("no shape of '" + path + "'", H5Sclose, [&] { return H5Dget_space(dataset); });
    const int rank = call("no shape of '" + path + "'", [&] { return H5Sget_simple_extent_ndims(space.id()); });
    Dims dims(static_cast<std::size_t>(rank));
    if (rank > 0)
        call("no shape of '" + path + "'", [&] { return H5Sget_simple_extent_dims(space.id(), dims.data(), nullptr); });
    return dims;
}

/// @throws Error unless the library converts the type to a double
void check_is_number(hid_t type, const std::string& what)
{
    const H5T_class_t kind = H5Tget_class(type);
    if (kind != H5T_INTEGER && kind != H5T_FLOAT && kind != H5T_ENUM)
        throw Error(what + " does not hold numbers");
}

/// Type of an attribute that has one value. @throws Error if it has several or none
Handle type_of_one(hid_t attribute, const std::string& name)
{
    const std::string what = "cannot read the attribute '" + name + "'";
    const Handle space = handle(what, H5Sclose, [&] { return H5Aget_space(attribute); });
    if (H5Sget_simple_extent_npoints(space.id()) != 1)
        throw Error("the attribute '" + name + "' is not one value");
    return handle(what, H5Tclose, [&] { return H5Aget_type(attribute); });
}

std::string read_variable_text(hid_t attribute, hid_t type, const std::string& what)
{
    char* value = nullptr;
    call(what, [&] { return H5Aread(attribute, type, &value); });
    const std::string text = value ? value : "";
    H5free_memory(value);
    return text;
}

void write_attribute(hid_t object, const std::string& name, hid_t stored, hid_t native, const void* value)
{
    const std::string what = "cannot write the attribute '" + name + "'";
    const Handle space = scalar();
    const Handle attribute = handle(
        what, H5Aclose, [&] { return H5Acreate2(object, name.c_str(), stored, space.id(), H5P_DEFAULT, H5P_DEFAULT); });
    call(what, [&] { return H5Awrite(attribute.id(), native, value); });
}

/// The types of numbers in files and in memory.
struct NumberTypes {
    hid_t stored, native;
};
template <class T>
NumberTypes types_of()
{
    if constexpr (std::is_same_v<T, double>)
        return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE};
    else if constexpr (std::is_same_v<T, std::uint64_t>)
        return {H5T_STD_U64LE, H5T_NATIVE_UINT64};
    else
        return {H5T_STD_I32LE, H5T_NATIVE_INT32};
}

template <class T>
void write_new(hid_t parent, const std::string& path, hid_t stored, hid_t native, const std::vector<T>& values,
               const Dims& dims, const std::string& unit)
{
    hsize_t count = 1;
    for (const hsize_t n : dims)
        count *= n;
    if (count != values.size())
        throw std::invalid_argument(path + " does not have the number of values of its shape");
    const Handle dataset = create_dataset(parent, path, stored, dims);
    if (count > 0)
        write_values(dataset.id(), path, native, values.data());
    if (!unit.empty())
        write_text(dataset.id(), "unit", unit);
}

/// How many values a data set has. What it promises will be allocated, so it must be there: no filter in use packs a
/// byte's worth tighter than deflate. @throws Error if it is not
std::size_t count_in(hid_t dataset, hid_t type, const Dims& dims, const std::string& path)
{
    constexpr double tightest = 1100;
    double count = 1;
    for (const hsize_t n : dims)
        count *= static_cast<double>(n);
    if (count * static_cast<double>(H5Tget_size(type)) > tightest * static_cast<double>(H5Dget_storage_size(dataset)))
        throw Error("'" + path + "' announces more values than the file contains");
    return static_cast<std::size_t>(count);
}

template <class T>
std::vector<T> read_whole(hid_t parent, const std::string& path, hid_t stored, hid_t native, const Dims& dims)
{
    const Handle dataset = open_dataset(parent, path, stored, dims);
    const std::size_t count = count_in(dataset.id(), stored, dims, path);
    std::vector<T> values(count);
    if (count > 0)
        read_values(dataset.id(), path, native, values.data());
    return values;
}

// Whether a data set or an attribute could not be closed since a file was opened: its last bytes were written then, and
// a destructor cannot report it; closing the file does.
thread_local bool lost_write = false;

} // namespace

Handle& Handle::operator=(Handle&& other) noexcept
{
    if (this != &other) {
        reset();
        id_ = std::exchange(other.id_, H5I_INVALID_HID);
        closer_ = other.closer_;
    }
    return *this;
}

void Handle::reset() noexcept
{
    if (id_ >= 0) {
        const Quiet quiet;
        if (closer_(std::exchange(id_, H5I_INVALID_HID)) < 0)
            lost_write = true;
    }
}

void Handle::close()
{
    const hid_t id = std::exchange(id_, H5I_INVALID_HID);
    call("cannot close", [&] { return closer_(id); });
    if (std::exchange(lost_write, false))
        throw Error("a part of it could not be written");
}

Handle create_file(const std::filesystem::path& file, std::uint64_t user_block)
{
    lost_write = false;
    const Handle access = file_access();
    const Handle creation = handle("no file creation list", H5Pclose, [] { return H5Pcreate(H5P_FILE_CREATE); });
    call("bad user block", [&] { return H5Pset_userblock(creation.id(), user_block); });
    return handle("cannot create an HDF5 file", H5Fclose,
                  [&] { return H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()); });
}

Handle open_file(const std::filesystem::path& file, bool writable)
{
    lost_write = false;
    const Handle access = file_access();
    return handle("cannot open as HDF5", H5Fclose,
                  [&] { return H5Fopen(file.c_str(), writable ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access.id()); });
}

Handle create_group(hid_t parent, const std::string& path)
{
    return handle("cannot create the group '" + path + "'", H5Gclose,
                  [&] { return H5Gcreate2(parent, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT); });
}

Handle open_group(hid_t parent, const std::string& path)
{
    return handle("no group '" + path + "'", H5Gclose, [&] { return H5Gopen2(parent, path.c_str(), H5P_DEFAULT); });
}

namespace {

Kind kind_of_type(hid_t type, const std::string& what)
{
    if (H5Tequal(type, H5T_IEEE_F64LE) > 0)
        return Kind::real;
    if (H5Tequal(type, H5T_STD_U64LE) > 0 || H5Tequal(type, H5T_STD_U32LE) > 0)
        return Kind::count;
    if (H5Tequal(type, H5T_STD_I32LE) > 0)
        return Kind::integer;
    if (H5Tequal(type, text_type().id()) > 0)
        return Kind::text;
    if (H5Tget_class(type) == H5T_ENUM && H5Tget_size(type) == 1)
        return Kind::word;
    throw Error(what + " is not of a type that it can have");
}

} // namespace

Kind kind_of(hid_t parent, const std::string& path)
{
    const Handle dataset = open_any(parent, path);
    const Handle type = type_of(dataset.id(), path);
    return kind_of_type(type.id(), "'" + path + "'");
}

Kind kind_of_attribute(hid_t object, const std::string& name)
{
    const Handle attribute = open_attribute(object, name);
    const Handle type =
        handle("no type of the attribute '" + name + "'", H5Tclose, [&] { return H5Aget_type(attribute.id()); });
    return kind_of_type(type.id(), "the attribute '" + name + "'");
}

std::vector<std::string> attributes_of(hid_t object)
{
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
        static_cast<std::vector<std::string>*>(list)->push_back(name);
        return 0;
    };
    call("cannot list the attributes of a group",
         [&] { return H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names); });
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<std::string> names_in(hid_t group)
{
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
        static_cast<std::vector<std::string>*>(list)->push_back(name);
        return 0;
    };
    call("cannot list a group",
         [&] { return H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names); });
    std::sort(names.begin(), names.end());
    return names;
}

bool exists(hid_t parent, const std::string& path)
{
    return call("cannot look for '" + path + "'", [&] { return H5Lexists(parent, path.c_str(), H5P_DEFAULT); }) > 0;
}

bool is_group(hid_t parent, const std::string& path)
{
    return H5Iget_type(open_object(parent, path).id()) == H5I_GROUP;
}

Handle create_dataset(hid_t parent, const std::string& path, hid_t type, const Dims& dims, const void* fill)
{
    const std::string what = "cannot create '" + path + "'";
    const Handle creation = handle(what, H5Pclose, [] { return H5Pcreate(H5P_DATASET_CREATE); });
    call(what, [&] { return H5Pset_layout(creation.id(), H5D_CONTIGUOUS); });
    call(what, [&] { return H5Pset_alloc_time(creation.id(), H5D_ALLOC_TIME_EARLY); });
    call(what, [&] { return H5Pset_fill_time(creation.id(), fill ? H5D_FILL_TIME_ALLOC : H5D_FILL_TIME_NEVER); });
    // without the time of creation equal results are equal files
    call(what, [&] { return H5Pset_obj_track_times(creation.id(), false); });
    if (fill)
        call(what, [&] { return H5Pset_fill_value(creation.id(), type, fill); });
    const Handle space = dataspace(dims);
    return handle(what, H5Dclose, [&] {
        return H5Dcreate2(parent, path.c_str(), type, space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT);
    });
}

Handle open_dataset(hid_t parent, const std::string& path, hid_t type, const Dims& dims)
{
    Handle dataset = open_any(parent, path);
    const Handle stored = type_of(dataset.id(), path);
    if (call("no type of '" + path + "'", [&] { return H5Tequal(stored.id(), type); }) == 0)
        throw Error("'" + path + "' does not have the required type");
    if (shape(dataset.id(), path) != dims)
        throw Error("'" + path + "' does not have the required shape");
    return dataset;
}

Dims dims_of(hid_t parent, const std::string& path)
{
    const Handle dataset = open_any(parent, path);
    return shape(dataset.id(), path);
}

std::uint64_t offset_of(hid_t dataset)
{
    const Handle creation = handle("no layout", H5Pclose, [&] { return H5Dget_create_plist(dataset); });
    const Quiet quiet;
    const haddr_t offset = H5Dget_offset(dataset);
    if (H5Pget_layout(creation.id()) != H5D_CONTIGUOUS || H5Pget_external_count(creation.id()) != 0 ||
        offset == HADDR_UNDEF)
        throw Error("a data set is not in one piece");
    return offset;
}

template <class T>
void write_array(hid_t parent, const std::string& path, const std::vector<T>& values, const Dims& dims,
                 const std::string& unit)
{
    write_new(parent, path, types_of<T>().stored, types_of<T>().native, values, dims, unit);
}

template <class T>
std::vector<T> read_array(hid_t parent, const std::string& path, const Dims& dims)
{
    return read_whole<T>(parent, path, types_of<T>().stored, types_of<T>().native, dims);
}

template void write_array(hid_t, const std::string&, const std::vector<double>&, const Dims&, const std::string&);
template void write_array(hid_t, const std::string&, const std::vector<std::uint64_t>&, const Dims&,
                          const std::string&);
template void write_array(hid_t, const std::string&, const std::vector<std::int32_t>&, const Dims&, const std::string&);
template std::vector<double> read_array(hid_t, const std::string&, const Dims&);
template std::vector<std::uint64_t> read_array(hid_t, const std::string&, const Dims&);
template std::vector<std::int32_t> read_array(hid_t, const std::string&, const Dims&);

void write_bytes(hid_t parent, const std::string& path, hid_t type, const std::vector<std::uint8_t>& values,
                 const Dims& dims)
{
    write_new(parent, path, type, type, values, dims, "");
}

void write_words(hid_t parent, const std::string& path, const std::vector<std::string>& texts,
                 const std::vector<std::string>& words)
{
    std::vector<std::pair<const char*, std::uint8_t>> members;
    for (const std::string& word : words)
        members.emplace_back(word.c_str(), static_cast<std::uint8_t>(members.size()));
    std::vector<std::uint8_t> values;
    for (const std::string& text : texts)
        values.push_back(static_cast<std::uint8_t>(std::find(words.begin(), words.end(), text) - words.begin()));
    write_bytes(parent, path, byte_enumeration(members).id(), values, {values.size()});
}

void write_texts(hid_t parent, const std::string& path, const std::vector<std::string>& texts)
{
    const Handle type = text_type();
    const char* none = ""; // the library wants a fill value where texts have no fixed length
    const Handle dataset = create_dataset(parent, path, type.id(), {texts.size()}, &none);
    std::vector<const char*> values;
    for (const std::string& text : texts)
        values.push_back(text.c_str());
    if (!values.empty())
        write_values(dataset.id(), path, type.id(), values.data());
}

std::vector<std::uint8_t> read_bytes(hid_t parent, const std::string& path, hid_t type, const Dims& dims)
{
    return read_whole<std::uint8_t>(parent, path, type, type, dims);
}

std::vector<std::string> read_words(hid_t parent, const std::string& path, const Dims& dims)
{
    const Handle dataset =
        handle("no data set '" + path + "'", H5Dclose, [&] { return H5Dopen2(parent, path.c_str(), H5P_DEFAULT); });
    const Handle type = handle("no type of '" + path + "'", H5Tclose, [&] { return H5Dget_type(dataset.id()); });
    std::vector<std::string> words;
    for (const std::uint8_t value : read_bytes(parent, path, type.id(), dims)) {
        char word[64] = "";
        const Quiet quiet;
        if (H5Tenum_nameof(type.id(), &value, word, sizeof word - 1) < 0)
            throw Error("'" + path + "' has a value that stands for nothing");
        words.emplace_back(word);
    }
    return words;
}

std::vector<std::string> read_texts(hid_t parent, const std::string& path, const Dims& dims)
{
    const Handle type = text_type();
    const std::vector<char*> values = read_whole<char*>(parent, path, type.id(), type.id(), dims);
    std::vector<std::string> texts;
    for (char* value : values) {
        texts.emplace_back(value ? value : "");
        H5free_memory(value);
    }
    return texts;
}

void write_text(hid_t object, const std::string& name, const std::string& text)
{
    const Handle type = text_type();
    const char* value = text.c_str();
    write_attribute(object, name, type.id(), type.id(), &value);
}

void write_number(hid_t object, const std::string& name, hid_t type, std::uint64_t value)
{
    write_attribute(object, name, type, H5T_NATIVE_UINT64, &value);
}

void change_number(hid_t object, const std::string& name, std::uint64_t value)
{
    const Handle attribute = open_attribute(object, name);
    call("cannot write the attribute '" + name + "'",
         [&] { return H5Awrite(attribute.id(), H5T_NATIVE_UINT64, &value); });
}

std::string read_text(hid_t object, const std::string& name)
{
    const std::string what = "cannot read the attribute '" + name + "'";
    const Handle attribute = open_attribute(object, name);
    const Handle stored = handle(what, H5Tclose, [&] { return H5Aget_type(attribute.id()); });
    const Handle space = handle(what, H5Sclose, [&] { return H5Aget_space(attribute.id()); });
    if (H5Tget_class(stored.id()) != H5T_STRING || H5Tis_variable_str(stored.id()) <= 0 ||
        H5Sget_simple_extent_type(space.id()) != H5S_SCALAR)
        throw Error("the attribute '" + name + "' is not a text");
    return read_variable_text(attribute.id(), text_type().id(), what);
}

std::uint64_t read_number(hid_t object, const std::string& name)
{
    const std::string what = "cannot read the attribute '" + name + "'";
    const Handle attribute = open_attribute(object, name);
    const Handle stored = handle(what, H5Tclose, [&] { return H5Aget_type(attribute.id()); });
    const Handle space = handle(what, H5Sclose, [&] { return H5Aget_space(attribute.id()); });
    if (H5Tget_class(stored.id()) != H5T_INTEGER || H5Sget_simple_extent_type(space.id()) != H5S_SCALAR)
        throw Error("the attribute '" + name + "' is not one whole number");
    std::uint64_t value = 0;
    call(what, [&] { return H5Aread(attribute.id(), H5T_NATIVE_UINT64, &value); });
    return value;
}

Numbers read_numbers(hid_t parent, const std::string& path)
{
    const Handle dataset = open_any(parent, path);
    const Handle stored = type_of(dataset.id(), path);
    check_is_number(stored.id(), "'" + path + "'");
    Numbers numbers;
    numbers.dims = shape(dataset.id(), path);
    const std::size_t count = count_in(dataset.id(), stored.id(), numbers.dims, path);
    numbers.values.resize(count);
    if (count > 0)
        read_values(dataset.id(), path, H5T_NATIVE_DOUBLE, numbers.values.data());
    return numbers;
}

Handle open_object(hid_t parent, const std::string& path)
{
    return handle("no '" + path + "'", H5Oclose, [&] { return H5Oopen(parent, path.c_str(), H5P_DEFAULT); });
}

bool has_attribute(hid_t object, const std::string& name)
{
    return call("cannot look for the attribute '" + name + "'", [&] { return H5Aexists(object, name.c_str()); }) > 0;
}

double read_any_number(hid_t object, const std::string& name)
{
    const Handle attribute = open_attribute(object, name);
    const Handle stored = type_of_one(attribute.id(), name);
    check_is_number(stored.id(), "the attribute '" + name + "'");
    double value = 0;
    call("cannot read the attribute '" + name + "'",
         [&] { return H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value); });
    return value;
}

std::string read_any_text(hid_t object, const std::string& name)
{
    const std::string what = "cannot read the attribute '" + name + "'";
    const Handle attribute = open_attribute(object, name);
    const Handle stored = type_of_one(attribute.id(), name);
    if (H5Tget_class(stored.id()) != H5T_STRING)
        throw Error("the attribute '" + name + "' is not a text");
    std::string text;
    if (H5Tis_variable_str(stored.id()) > 0) {
        text = read_variable_text(attribute.id(), stored.id(), what);
    } else {
        constexpr std::size_t longest = 65536; // of an attribute in the usual, compact place
        const std::size_t size = H5Tget_size(stored.id());
        if (size > longest)
            throw Error("the attribute '" + name + "' is too long");
        text.resize(size);
        call(what, [&] { return H5Aread(attribute.id(), stored.id(), text.data()); });
        text.resize(std::min(text.find('\0'), text.size()));
    }
    text.resize(text.find_last_not_of(' ') + 1);
    return text;
}

void write_real(hid_t object, const std::string& name, double value)
{
    write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

Handle byte_enumeration(const std::vector<std::pair<const char*, std::uint8_t>>& members)
{
    Handle type = handle("no enumeration", H5Tclose, [] { return H5Tenum_create(H5T_STD_U8LE); });
    for (const auto& [name, value] : members)
        call("no enumeration", [&, n = name, v = value] { return H5Tenum_insert(type.id(), n, &v); });
    return type;
}

} // namespace stylobate::hdf5
