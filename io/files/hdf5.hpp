#pragma once
/// A thin layer over the HDF5 C API: identifiers that close themselves, errors as exceptions, nothing printed.

#include <cstdint>
#include <filesystem>
#include <hdf5.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stylobate::hdf5 {

/// What the library reported; the caller knows which file it was about.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An identifier with the function that closes it.
class Handle {
public:
    Handle() = default;
    Handle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), closer_(closer) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), closer_(other.closer_) {}
    Handle& operator=(Handle&& other) noexcept;
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() { reset(); }

    hid_t id() const { return id_; }
    void reset() noexcept;
    /// Closes, and reports an error: a file's last writes happen here.
    void close();

private:
    hid_t id_ = H5I_INVALID_HID;
    herr_t (*closer_)(hid_t) = nullptr;
};

using Dims = std::vector<hsize_t>;

/// Overwrites the file. The first `user_block` bytes (a power of two from 512) are left to the caller.
/// The library's own file locks are off, here and in `open_file`: the caller locks.
Handle create_file(const std::filesystem::path& file, std::uint64_t user_block);
Handle open_file(const std::filesystem::path& file, bool writable);

Handle create_group(hid_t parent, const std::string& path);
Handle open_group(hid_t parent, const std::string& path);
/// Names in the group, in the order of their characters.
std::vector<std::string> names_in(hid_t group);
/// True if the last part of the path is there; the parts before it must be.
bool exists(hid_t parent, const std::string& path);
bool is_group(hid_t parent, const std::string& path);

/// A contiguous data set whose space in the file is allocated at once.
/// @param fill value of the type `type` that is written at once; nullptr = zeros, not written
Handle create_dataset(hid_t parent, const std::string& path, hid_t type, const Dims& dims, const void* fill = nullptr);
/// @throws Error if there is none, or if it has another type or shape
Handle open_dataset(hid_t parent, const std::string& path, hid_t type, const Dims& dims);
/// Shape of a data set that is not open.
Dims dims_of(hid_t parent, const std::string& path);
/// Where the data lie, in bytes from the start of the file. @throws Error if they are not contiguous and allocated
std::uint64_t offset_of(hid_t dataset);

/// What `write_array`, `write_texts` and the scalar attributes write.
enum class Kind { real, count, integer, text, word /*!< of an enumeration in one byte */ };
/// @throws Error if it is of another type
Kind kind_of(hid_t parent, const std::string& path);
Kind kind_of_attribute(hid_t object, const std::string& name);
/// Names of the attributes, in the order of their characters.
std::vector<std::string> attributes_of(hid_t object);

/// A new one-step data set of doubles, counts (uint64) or whole numbers (int32), row by row, with its unit where it has
/// one.
template <class T>
void write_array(hid_t parent, const std::string& path, const std::vector<T>& values, const Dims& dims,
                 const std::string& unit);
/// Of one byte each, as `byte_enumeration` makes the type.
void write_bytes(hid_t parent, const std::string& path, hid_t type, const std::vector<std::uint8_t>& values,
                 const Dims& dims);
/// An enumeration of these words in one byte each. @pre the texts are among the words
void write_words(hid_t parent, const std::string& path, const std::vector<std::string>& texts,
                 const std::vector<std::string>& words);
/// UTF-8 of variable length, without NUL.
void write_texts(hid_t parent, const std::string& path, const std::vector<std::string>& texts);
/// @throws Error if it has another type or shape
template <class T>
std::vector<T> read_array(hid_t parent, const std::string& path, const Dims& dims);
inline constexpr auto read_doubles = read_array<double>;
inline constexpr auto read_counts = read_array<std::uint64_t>;
inline constexpr auto read_integers = read_array<std::int32_t>;
std::vector<std::uint8_t> read_bytes(hid_t parent, const std::string& path, hid_t type, const Dims& dims);
std::vector<std::string> read_texts(hid_t parent, const std::string& path, const Dims& dims);
std::vector<std::string> read_words(hid_t parent, const std::string& path, const Dims& dims);

/// Scalar attributes. Text is UTF-8 of variable length; a number has the given type in the file.
void write_text(hid_t object, const std::string& name, const std::string& text);
void write_number(hid_t object, const std::string& name, hid_t type, std::uint64_t value);
/// A new value for an attribute that is there.
void change_number(hid_t object, const std::string& name, std::uint64_t value);
std::string read_text(hid_t object, const std::string& name);
std::uint64_t read_number(hid_t object, const std::string& name);

/// What other programs wrote, in whatever type they chose.
struct Numbers {
    std::vector<double> values; ///< row by row
    Dims dims;                  ///< empty: a single number
};
/// A data set of numbers of any width, whole, real or true and false, compressed or not.
/// @throws Error if it holds no numbers, or promises more of them than its bytes can hold
Numbers read_numbers(hid_t parent, const std::string& path);
/// A group or a data set, for its attributes.
Handle open_object(hid_t parent, const std::string& path);
bool has_attribute(hid_t object, const std::string& name);
/// A number of any type, alone or a list of one.
double read_any_number(hid_t object, const std::string& name);
/// A text of fixed or variable length, alone or a list of one, without what pads it.
std::string read_any_text(hid_t object, const std::string& name);
void write_real(hid_t object, const std::string& name, double value);

/// The type of a file from the attributes of its root, for readers that do not know its layout.
struct Label {
    std::optional<std::string> format; ///< "stylobate-diagnosis"; nullopt: it has none, or it cannot be read
    std::optional<std::string> kind;
};
/// A file that may be damaged is to be checked before, by its seal.
Label label_of(const std::filesystem::path& file);

/// An enumeration stored in one byte.
Handle byte_enumeration(const std::vector<std::pair<const char*, std::uint8_t>>& members);

} // namespace stylobate::hdf5
