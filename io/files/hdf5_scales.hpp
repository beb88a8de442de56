#pragma once
/// Dimension scales of HDF5: which data set holds the values along a dimension of another.

#include "io/files/hdf5.hpp"

#include <map>
#include <string>
#include <vector>

namespace stylobate::hdf5 {

/// Collects the dimensions of a file's data sets and writes them at once, in the layout of the HDF5 Dimension Scale
/// Specification (attributes CLASS, NAME, REFERENCE_LIST and DIMENSION_LIST), as netCDF-4 programs read it. The library
/// of HDF5 for this (H5DS) is not used: it stores unset bytes of its buffers, and equal results must be equal files.
class DimensionScales {
public:
    /// @param dataset path from the root
    /// @param scales  paths of the data sets along its dimensions, in their order; the data set itself may be one
    void attach(const std::string& dataset, const std::vector<std::string>& scales);
    /// @throws Error if a path does not exist or an attribute cannot be written
    void write(hid_t file) const;

private:
    std::map<std::string, std::vector<std::string>> scales_of_; ///< by data set
};

} // namespace stylobate::hdf5
