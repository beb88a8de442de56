#pragma once
/// Measured campaigns to begin with: a commented campaign.toml, and the table of one run with a line of names.

#include "ensemble/model/campaign.hpp"

#include <string>

namespace stylobate {

struct CampaignTemplate {
    std::string toml;   ///< of campaign.toml
    std::string run;    ///< name of its run: "pull_1"
    std::string header; ///< line of names of runs/RUN.csv, as another program may have them; empty: it needs no table
};

/// A campaign of version 2 (io/FORMAT.md) with one run of this kind: a small column of four blocks, the procedure of
/// the kind on its joint 1 as comments, and a map of columns. With rows of numbers in its table it is read as it
/// stands.
CampaignTemplate campaign_template(RunKind kind);

} // namespace stylobate
