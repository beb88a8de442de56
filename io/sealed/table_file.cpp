#include "io/sealed/table_file.hpp"

#include "io/tables/table_hdf5.hpp"

namespace stylobate {

void write_table_file(const std::filesystem::path& file, const SealedFormat& format, const std::string& code_version,
                      const std::vector<Table>& tables)
{
    write_sealed_file(file, format, code_version, [&](hid_t root) {
        for (const Table& table : tables)
            write_table(root, table);
    });
}

std::vector<Table> read_table_file(const std::filesystem::path& file, const SealedFormat& format)
{
    std::vector<Table> tables;
    read_sealed_file(file, format, [&](hid_t root, std::uint64_t) {
        for (const std::string& name : hdf5::names_in(root))
            tables.push_back(read_table(root, name, file.string()));
    });
    return tables;
}

} // namespace stylobate
