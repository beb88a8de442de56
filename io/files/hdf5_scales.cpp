#include "io/files/hdf5_scales.hpp"

#include <cstring>

namespace stylobate::hdf5 {

namespace {

/// Of an attribute REFERENCE_LIST, as the specification has it: a reference and the number of the dimension.
struct Use {
    hobj_ref_t dataset = 0;
    std::int32_t dimension = 0;
    std::int32_t unused = 0; ///< what would be padding is written as 0
};
static_assert(sizeof(Use) == 16);

Handle checked(hid_t id, herr_t (*close)(hid_t), const std::string& what)
{
    if (id < 0)
        throw Error("cannot write the dimension scales of '" + what + "'");
    return {id, close};
}

void checked(herr_t status, const std::string& what)
{
    if (status < 0)
        throw Error("cannot write the dimension scales of '" + what + "'");
}

hobj_ref_t reference(hid_t file, const std::string& path)
{
    hobj_ref_t to = 0;
    checked(H5Rcreate(&to, file, path.c_str(), H5R_OBJECT, -1), path);
    return to;
}

/// @param count of values; 0: one alone
void write(hid_t object, const char* name, hid_t type, hsize_t count, const void* values)
{
    const Handle space =
        checked(count > 0 ? H5Screate_simple(1, &count, nullptr) : H5Screate(H5S_SCALAR), H5Sclose, name);
    const Handle attribute =
        checked(H5Acreate2(object, name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
    checked(H5Awrite(attribute.id(), type, values), name);
}

void write_fixed_text(hid_t object, const char* name, const std::string& text)
{
    const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, name);
    checked(H5Tset_size(type.id(), text.size() + 1), name);
    write(object, name, type.id(), 0, text.c_str());
}

} // namespace

void DimensionScales::attach(const std::string& dataset, const std::vector<std::string>& scales)
{
    scales_of_[dataset] = scales;
}

void DimensionScales::write(hid_t file) const
{
    std::map<std::string, std::vector<Use>> uses; // by scale
    const Handle list = checked(H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose, "DIMENSION_LIST");
    for (const auto& [dataset, scales] : scales_of_) {
        const Handle object = open_object(file, dataset);
        std::vector<hobj_ref_t> references;
        bool is_scale = false; // a scale has no scales
        for (const std::string& scale : scales) {
            is_scale = is_scale || scale == dataset;
            references.push_back(reference(file, scale));
        }
        for (std::size_t i = 0; i < scales.size(); ++i) {
            std::vector<Use>& of_scale = uses[scales[i]];
            if (!is_scale)
                of_scale.push_back({reference(file, dataset), static_cast<std::int32_t>(i), 0});
        }
        if (is_scale)
            continue;
        std::vector<hvl_t> lists;
        for (hobj_ref_t& each : references)
            lists.push_back({1, &each});
        hdf5::write(object.id(), "DIMENSION_LIST", list.id(), lists.size(), lists.data());
    }
    const Handle use = checked(H5Tcreate(H5T_COMPOUND, sizeof(Use)), H5Tclose, "REFERENCE_LIST");
    checked(H5Tinsert(use.id(), "dataset", offsetof(Use, dataset), H5T_STD_REF_OBJ), "REFERENCE_LIST");
    checked(H5Tinsert(use.id(), "dimension", offsetof(Use, dimension), H5T_STD_I32LE), "REFERENCE_LIST");
    for (const auto& [scale, used] : uses) {
        const Handle object = open_object(file, scale);
        write_fixed_text(object.id(), "CLASS", "DIMENSION_SCALE");
        write_fixed_text(object.id(), "NAME", scale.substr(scale.rfind('/') + 1));
        if (!used.empty())
            hdf5::write(object.id(), "REFERENCE_LIST", use.id(), used.size(), used.data());
    }
}

Label label_of(const std::filesystem::path& file)
{
    try {
        const Handle open = open_file(file, false);
        const auto text = [&](const char* name) {
            return has_attribute(open.id(), name) ? std::optional(read_any_text(open.id(), name)) : std::nullopt;
        };
        return {text("format"), text("kind")};
    } catch (const Error&) { // its reader reports the error
        return {};
    }
}

} // namespace stylobate::hdf5
