#include "io/keys/study_tables.hpp"

#include "io/keys/kind_keys.hpp"
#include "io/keys/mechanism_keys.hpp"
#include "io/keys/spread_key.hpp"
#include "io/keys/study_keys.hpp"

namespace stylobate {

namespace {

void visit(const TomlKey& table, const std::string& above,
           const std::function<void(const std::string&, const TomlKey&)>& call)
{
    for (const TomlKey* key : table.keys) {
        const std::string path = above.empty() ? key->name : above + "." + key->name;
        call(path, *key);
        visit(*key, path, call);
    }
}

} // namespace

const TableKey& study_file_keys()
{
    static const TableKey file(
        "", "a study of Stylobate",
        {&study_keys::table, &structure_keys::table, &contact_keys::table, &excitation_keys::table,
         &surface_keys::table, &twins_keys::table, &fragility_keys::table, &sensitivity_keys::table, &rare_keys::table,
         &survival_keys::table, &perturbation_table(), &mechanisms_table(), &initial_keys::table, &output_keys::table,
         &outcome_keys::table, &run_keys::table, &variants_keys::table, &optimise_keys::table});
    return file;
}

void for_each_key(const std::function<void(const std::string& path, const TomlKey& key)>& call)
{
    visit(study_file_keys(), "", call);
}

} // namespace stylobate
