#pragma once
/// The pages of measured data: one case each.

#include "ensemble/run/executor.hpp"

#include <filesystem>
#include <optional>

namespace stylobate::measured {

/// Where a case finds its data and puts its page, and how it may run.
struct PagePlace {
    std::filesystem::path data;                   ///< folder of all measured data; a case reads its own folder in it
    std::filesystem::path docs;                   ///< the page is docs/NAME.md, its pictures lie in docs/images
    std::filesystem::path studies;                ///< where the study files of the fitted models go
    RunOptions run;                               ///< instruction set and threads
    std::optional<std::filesystem::path> predict; ///< a table of planar impacts to predict; nullopt: none
    bool quiet = false;                           ///< no lines on standard error about what is being done

    std::filesystem::path images() const { return docs / "images"; }
};

/// The cases.
void ceh2016(const PagePlace& place);
void planar_impact(const PagePlace& place);
void rock_shake_table(const PagePlace& place);

} // namespace stylobate::measured
