#include "tests/fuzz/hdf5_edits.hpp"

#include "io/files/hdf5.hpp"
#include "tests/fuzz/any_value.hpp"

namespace stylobate::fuzz {
namespace {

using hdf5::Handle;

void collect(hid_t group, const std::string& above, std::vector<Hdf5Object>& all)
{
    for (const std::string& name : hdf5::names_in(group)) {
        const std::string path = above + name;
        const Handle object = hdf5::open_object(group, name);
        const bool is_group = H5Iget_type(object.id()) == H5I_GROUP;
        all.push_back({path, !is_group});
        if (is_group && all.size() < 500) // a link to a group above it would have no end
            collect(object.id(), path + "/", all);
    }
}

/// A value for an attribute, of the type that it had or of another one.
void change_attribute(hid_t object, ByteSource& recipe)
{
    const std::vector<std::string> names = hdf5::attributes_of(object);
    if (names.empty())
        return;
    const std::string& name = names[recipe.below(names.size())];
    const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute.id()), H5Tclose);
    H5T_class_t kind = H5Tget_class(type.id());
    std::string before;
    if (kind == H5T_STRING)
        before = hdf5::read_any_text(object, name);
    const std::uint8_t how = recipe.byte();
    H5Adelete(object, name.c_str());
    if (how % 8 == 0)
        return;
    if (how % 8 == 1) // of another type
        kind = kind == H5T_STRING ? H5T_FLOAT : kind == H5T_FLOAT ? H5T_INTEGER : H5T_STRING;
    if (kind == H5T_STRING)
        hdf5::write_text(object, name, any_text(before, recipe));
    else if (kind == H5T_INTEGER)
        hdf5::write_number(object, name, how % 8 == 2 ? H5T_STD_U8LE : H5T_STD_U64LE, any_count(recipe));
    else
        hdf5::write_real(object, name, any_double(recipe));
}

/// Elements for which there is room in the file; more are only announced, and writing one would fill all of them.
constexpr double most_allocated = 4096;

/// One element of a data set in one piece. (The library itself breaks on some writes into packed ones.)
void change_element(hid_t dataset, ByteSource& recipe)
{
    const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
    if (H5Pget_layout(creation.id()) != H5D_CONTIGUOUS)
        return;
    const Handle space(H5Dget_space(dataset), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.id());
    if (rank < 0 || rank > 4)
        return;
    hsize_t dims[4] = {}, at[4] = {};
    H5Sget_simple_extent_dims(space.id(), dims, nullptr);
    double count = 1;
    for (int d = 0; d < rank; ++d)
        count *= static_cast<double>(dims[d]);
    if (count > most_allocated)
        return;
    for (int d = 0; d < rank; ++d)
        at[d] = recipe.below(static_cast<std::size_t>(dims[d]));
    if (rank > 0)
        H5Sselect_elements(space.id(), H5S_SELECT_SET, 1, at);
    const Handle one(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle type(H5Dget_type(dataset), H5Tclose);
    switch (H5Tget_class(type.id())) {
    case H5T_INTEGER: {
        const std::uint64_t value = any_count(recipe);
        H5Dwrite(dataset, H5T_NATIVE_UINT64, one.id(), space.id(), H5P_DEFAULT, &value);
        break;
    }
    case H5T_FLOAT: {
        const double value = any_double(recipe);
        H5Dwrite(dataset, H5T_NATIVE_DOUBLE, one.id(), space.id(), H5P_DEFAULT, &value);
        break;
    }
    case H5T_STRING: {
        const std::string text = any_text("", recipe);
        const char* value = text.c_str();
        if (H5Tis_variable_str(type.id()) > 0)
            H5Dwrite(dataset, type.id(), one.id(), space.id(), H5P_DEFAULT, &value);
        break;
    }
    case H5T_ENUM: {
        const std::uint8_t value = recipe.byte();
        if (H5Tget_size(type.id()) == 1)
            H5Dwrite(dataset, type.id(), one.id(), space.id(), H5P_DEFAULT, &value);
        break;
    }
    default:
        break;
    }
}

/// Puts a data set of another shape or type into the place of one, with values that are zero or not there at all.
void replace_dataset(hid_t file, const std::string& path, ByteSource& recipe)
{
    hdf5::Dims dims;
    Handle type;
    {
        const Handle old(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
        dims = hdf5::dims_of(file, path);
        type = Handle(H5Dget_type(old.id()), H5Tclose);
    }
    const std::uint8_t how = recipe.byte();
    if (how % 4 == 0) {
        const hid_t types[] = {H5T_IEEE_F64LE, H5T_IEEE_F32BE, H5T_STD_I32LE, H5T_STD_U64LE, H5T_STD_U8LE, H5T_C_S1};
        type = Handle(H5Tcopy(types[recipe.below(std::size(types))]), H5Tclose);
    } else if (how % 4 == 1 && !dims.empty()) {
        dims[recipe.below(dims.size())] = any_count(recipe);
    } else if (how % 4 == 2) {
        dims.push_back(recipe.below(3));
    } else if (!dims.empty()) {
        dims.pop_back();
    }
    H5Ldelete(file, path.c_str(), H5P_DEFAULT);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    double count = 1;
    for (const hsize_t n : dims)
        count *= static_cast<double>(n);
    H5Pset_alloc_time(creation.id(), count > most_allocated ? H5D_ALLOC_TIME_LATE : H5D_ALLOC_TIME_EARLY);
    if (how >= 128 && !dims.empty() && dims.size() <= 4 && count <= most_allocated) { // in pieces, packed
        hsize_t piece[4];
        for (std::size_t d = 0; d < dims.size(); ++d)
            piece[d] = std::max<hsize_t>(1, std::min<hsize_t>(dims[d], 16));
        H5Pset_chunk(creation.id(), static_cast<int>(dims.size()), piece);
        H5Pset_deflate(creation.id(), 6);
        H5Pset_alloc_time(creation.id(), H5D_ALLOC_TIME_INCR);
    }
    const Handle space(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose);
    const Handle made(H5Dcreate2(file, path.c_str(), type.id(), space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
                      H5Dclose);
}

/// A name for another object: moved, linked twice, to nothing, or into another file.
void change_name(hid_t file, const std::vector<Hdf5Object>& all, const std::string& path, ByteSource& recipe)
{
    const std::string other = all[recipe.below(all.size())].path;
    const std::uint8_t how = recipe.byte();
    if (how % 8 == 0) {
        H5Ldelete(file, path.c_str(), H5P_DEFAULT);
        return;
    }
    std::string name = how % 8 <= 3 ? other : path.substr(0, path.rfind('/') + 1) + recipe.text(8);
    name = name.substr(0, name.find('\0'));
    if (how % 8 <= 2)
        H5Ldelete(file, other.c_str(), H5P_DEFAULT);
    if (how % 2 == 0)
        H5Lcreate_hard(file, path.c_str(), file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    else if (how < 64)
        H5Lcreate_external("/nowhere.h5", "/a", file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    else
        H5Lcreate_soft(how < 128 ? "/nothing" : ("/" + path).c_str(), file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
}

/// One change: of a value, a type, a shape, an attribute or a name, of an object or an attribute taken away or added.
/// What the library cannot do is left out.
void edit_hdf5(hid_t file, std::vector<Hdf5Object>& all, ByteSource& recipe)
{
    try {
        const std::uint8_t how = recipe.byte();
        if (how < 64) { // of the file itself
            change_attribute(file, recipe);
            return;
        }
        if (all.empty())
            return;
        const Hdf5Object object = all[recipe.below(all.size())];
        if (how < 96) {
            change_attribute(hdf5::open_object(file, object.path).id(), recipe);
        } else if (how < 128) {
            change_name(file, all, object.path, recipe);
            all.clear();
            collect(file, "", all);
        } else if (object.dataset && how < 208) {
            change_element(Handle(H5Dopen2(file, object.path.c_str(), H5P_DEFAULT), H5Dclose).id(), recipe);
        } else if (object.dataset) {
            replace_dataset(file, object.path, recipe);
        }
    } catch (const hdf5::Error&) { // an edit before took away what this one is of
    }
}

} // namespace

std::vector<Hdf5Object> objects_in(const std::filesystem::path& path)
{
    std::vector<Hdf5Object> all;
    collect(hdf5::open_file(path, false).id(), "", all);
    return all;
}

bool edit_hdf5_file(const std::filesystem::path& path, std::vector<Hdf5Object> objects, ByteSource& recipe,
                    std::size_t most)
{
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    // The library keeps what it frees: to hand its large blocks back and to clear them anew took a quarter of the time.
    H5set_free_list_limits(-1, -1, -1, -1, -1, -1);
    try {
        Handle file = hdf5::open_file(path, true);
        for (; most > 0 && !recipe.empty(); --most)
            edit_hdf5(file.id(), objects, recipe);
        file.close();
        constexpr std::uintmax_t longest = 1 << 20; // room for what was only announced: reading it takes its time
        return std::filesystem::file_size(path) <= longest;
    } catch (const hdf5::Error&) {
        return false;
    }
}

} // namespace stylobate::fuzz
