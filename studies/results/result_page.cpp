#include "studies/results/result_page.hpp"

#include "ensemble/model/input_error.hpp"
#include "ensemble/numerics/sample_quantiles.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/suggest.hpp"
#include "io/plots/plot_order.hpp"
#include "io/store/surface_axis.hpp"
#include "studies/experiment/conventions.hpp"
#include "studies/kinds/limit_text.hpp"
#include "studies/report/html_figure.hpp"
#include "studies/report/json.hpp"
#include "studies/report/left_out.hpp"
#include "studies/report/words.hpp"
#include "studies/results/cells_data.hpp"
#include "studies/results/fall_rose.hpp"
#include "studies/results/quantile_table.hpp"
#include "studies/results/result_picture.hpp"
#include "studies/results/structure_sketch.hpp"
#include "studies/results/study_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

namespace stylobate {
namespace {

namespace fs = std::filesystem;

std::string interval_text(const Share& share)
{
    if (std::isnan(share.lower))
        return "–";
    return fmt::format("{:.1f} to {:.1f} %", 100 * share.lower, 100 * share.upper);
}

class ResultPage {
public:
    ResultPage(const Results& results, Isa isa, const std::optional<std::string>& title,
               const KeptAnimations& animations, const std::optional<LawBand>& laws,
               const std::optional<std::string>& web, std::vector<std::string>& warnings)
        : results_(results), isa_(isa), animations_(animations), laws_(laws), web_(web), reader_(results.reader()),
          header_(results.header()), warnings_(warnings), study_(results.study()), kind_(results.concluded()),
          rows_(results.trials()), counts_(kind_.counts()),
          page_(title.value_or("Results: " + results.title()), subtitle(header_)),
          writer_{page_, [this](const std::string& caption, const auto& draw) { picture(caption, draw); }},
          surface_(header_.cells() > 0)
    {
        if (const Tally* tally = reader_.tally()) {
            invalid_count_ = tally->all_invalid();
            for (const auto& [index, reason] : tally->first_invalid)
                invalid_.emplace_back(index, reason);
        }
        for (const ResultRow& row : rows_) {
            if (row.outcome.state == State::invalid)
                invalid_.emplace_back(row.index, row.outcome.invalid_reason);
            else
                valid_.push_back(&row);
        }
        if (!reader_.tally())
            invalid_count_ = invalid_.size();
    }

    Document page()
    {
        const std::optional<Answer> answer = kind_.answer();
        if (surface_) {
            page_.answer(answer ? Html(answer->sentence) : overall());
            depends();
            kind_.map(writer_);
            answers();
            page_.contents();
        }
        page_.section("Summary");
        if (answer && surface_) // its sentence stands above
            page_.paragraph(answer->more);
        else if (answer)
            page_.box("main", answer->sentence, answer->more);
        if (!kind_.summary(writer_))
            summary(answer.has_value() || surface_);
        if (!surface_)
            depends();
        studied();
        if (kind_.draws_plainly()) {
            outcomes();
            kind_.sections(writer_);
            if (laws_)
                law_band_section(writer_, *laws_);
            if (!surface_)
                answers();
            else if (animations_.words)
                page_.note(*animations_.words);
            pictures();
            order();
            motions();
            energy();
        }
        again();
        return page_;
    }

private:
    static std::string subtitle(const ResultHeader& header)
    {
        return fmt::format("Kind of study: {}. Realizations: {}. Seed {}. Computed by stylobate {}.", header.kind,
                           header.total, header.seed, header.code_version);
    }

    static const char* fate(State state)
    {
        switch (state) {
        case State::stood:
            return "stood with negligible motion";
        case State::rocked:
            return "did not collapse; it rocked more than it slid";
        case State::slid:
            return "did not collapse; it slid more than it rocked";
        case State::collapsed:
            return "collapsed";
        default:
            return "is invalid";
        }
    }

    /// How many collapsed, with the interval.
    Html overall() const
    {
        const Share collapsed = counts_.share(LimitState::collapse);
        const std::optional<std::string> of = counted_words(study_);
        Html text = fmt::format("{} of {} valid realizations{}{} collapsed: ", collapsed.count, collapsed.trials,
                                of ? " " + *of : "",
                                surface_ ? fmt::format(" over {} × {} cells of {} and PGA", header_.rows().size(),
                                                       header_.pga_m_s2.size(), header_.row_quantity().name)
                                         : "");
        text += unbroken(percent_text(collapsed.probability));
        text += " (";
        if (!std::isnan(collapsed.lower))
            text += unbroken(interval_text(collapsed) + "; ");
        text += describe_interval(counts_.interval()) + ").";
        return text;
    }

    /// On what the answer depends: the contact law, and what the model leaves out.
    void depends()
    {
        std::string laws = laws_ ? law_band_words(laws_->limits.front(), *laws_) + "." : law_advice(study_);
        laws.front() = static_cast<char>(std::toupper(laws.front()));
        page_.paragraph(laws);
        add_left_out(page_, study_.structure.dimensions);
    }

    /// The share that fell. @param answered whether the page has opened with an answer
    void summary(bool answered)
    {
        const Share collapsed = counts_.share(LimitState::collapse);
        const bool one = rows_.size() == 1, known = !std::isnan(collapsed.lower);
        std::string sentence;
        Html text;
        if (one) {
            sentence = fmt::format("Realization {} {}.", rows_[0].index, fate(rows_[0].outcome.state));
        } else {
            sentence = fmt::format("{} of the realizations collapsed ({}).",
                                   known ? interval_text(collapsed) : percent_text(collapsed.probability),
                                   known ? "95 % interval" : describe_interval(counts_.interval()));
            text = overall();
        }
        if (surface_)
            text += " The cells differ in their shaking, so this share also depends on the choice of cells; the "
                    "probability of each cell is given below.";
        else if (!header_.motions.names.empty())
            text += " This share is of all intensities together and depends on their choice.";
        if (header_.selected)
            text += " It also depends on the number of realizations in each cell, which is larger where the "
                    "probability is near 1/2.";
        if (collapsed.count > 0)
            text += fmt::format("{} {:.3g} s.", one ? " Its first block fell at" : " Median time of the first fall:",
                                counts_.median_collapse_time_s());
        if (const std::optional<std::string> moving = counts_.moving_text())
            text += " " + (one ? std::string("It still moved at the end: its residual displacements are not known.")
                               : *moving);
        if (answered)
            page_.paragraph(text);
        else
            page_.box("main", sentence, text);
        if (!invalid_.empty()) {
            std::string list;
            for (std::size_t i = 0; i < std::min<std::size_t>(invalid_.size(), 10); ++i)
                list += fmt::format("{}{} ({})", i > 0 ? ", " : "", invalid_[i].first, to_string(invalid_[i].second));
            page_.box("warn", fmt::format("{} of {} realizations invalid", invalid_count_, header_.total),
                      "They are excluded from all statistics. Realizations " + list +
                          (invalid_count_ > 10 ? " and others." : "."));
        }
    }

    void studied()
    {
        page_.section("The study");
        const bool replayed = header_.kind == "replay" && rows_.size() == 1;
        const auto facts = study_facts(study_, replayed ? &rows_.front() : nullptr, header_.input_names);
        for (const std::string& warning : header_.warnings)
            page_.box("warn", "Doubtful", warning);
        page_.figure(structure_sketch(study_), sketch_caption(study_));
        page_.details("Settings of the study", [&] {
            page_.facts({facts.begin(), facts.end()});
            page_.paragraph("Conventions: " + conventions_text(study_) + ".");
        });
    }

    void outcomes()
    {
        if (rows_.size() == 1)
            return;
        page_.section("Outcomes");
        HtmlTable table{"lrrr", {"limit state", "reached", "share", describe_interval(counts_.interval())}, {}, ""};
        for (const LimitState limit : counted_limits(study_)) {
            const Share share = counts_.share(limit);
            table.rows.push_back({describe(limit), fmt::format("{} of {}", share.count, share.trials),
                                  percent_text(share.probability), interval_text(share)});
        }
        page_.table(table);
        if (study_.outcome.follow == Follow::rest && counts_.share(LimitState::total).count > 0)
            page_.note(
                fmt::format("Median time of the total collapse: {:.3g} s.", counts_.median_total_collapse_time_s()));
        page_.note("Rocking or sliding without collapse: classified by the larger of the two motions.");
    }

    /// What the script of the page needs: the cells of a surface, and realizations in motion.
    void answers()
    {
        if (const std::optional<SurfaceTable> table = kind_.surface(); table && surface_)
            page_.data("cells", cells_json(*table, results_));
        if (!animations_.list.empty())
            page_.data("animations", animations_json(animations_, study_));
    }

    /// One realization over time.
    void pictures()
    {
        if (surface_)
            return;
        if (!kind_.shows_motion()) { // its realizations are drawn together above
            if (!animations_.list.empty()) {
                page_.section("Realizations in motion");
                page_.player();
                page_.note(*animations_.words);
            }
            return;
        }
        page_.section("Motion");
        if (!animations_.list.empty())
            page_.player();
        if (animations_.words)
            page_.note(*animations_.words);
        const std::vector<const ResultRow*> shown = shown_realizations();
        for (const ResultRow* row : shown)
            motion(*row);
        if (shown.size() < rows_.size())
            page_.note(fmt::format("{} of {} realizations. Any other: stylobate export {} --to png --picture strip "
                                   "--realization I.",
                                   shown.size(), rows_.size(), results_.file()));
    }

    /// Of motions those that the player has, since the first ones are those of the weakest shaking; else the first
    /// ones.
    std::vector<const ResultRow*> shown_realizations() const
    {
        std::vector<const ResultRow*> shown;
        for (const ResultRow& row : rows_) {
            const bool kept =
                header_.motions.names.empty() || animations_.list.empty() ||
                std::ranges::find(animations_.list, row.index, &Animation::index) != animations_.list.end();
            if (kept && shown.size() < first_shown)
                shown.push_back(&row);
        }
        return shown;
    }

    void order()
    {
        if (!header_.has_rows())
            return first_falls();
        const FallOrder falls = fall_order(header_.block_names, rows_, motion_groups(study_, header_.motions));
        const std::vector<std::size_t> blocks = order_of_falls(falls);
        if (blocks.empty())
            return;
        page_.section("Order of falls");
        if (falls.trials > 1)
            picture("The share of the realizations in which a block has fallen, over time.",
                    [&](const fs::path& png) { order_picture(results_, -1, std::nullopt, png); });
        HtmlTable table{"lrrrrr",
                        {"block", "fell", "share", describe_interval(falls.interval), "median time [s]", "fell first"},
                        {},
                        ""};
        for (const std::size_t i : blocks) {
            const FallOrder::Block& block = falls.blocks[i];
            Share share = share_of(falls.trials, block.fall_time_s.size());
            share.lower = block.lower;
            share.upper = block.upper;
            table.rows.push_back({block.name, fmt::format("{} of {}", share.count, share.trials),
                                  percent_text(share.probability), interval_text(share),
                                  number_or_dash(quantile_or_nan(block.fall_time_s, 0.5)),
                                  fmt::format("{}", block.first)});
        }
        page_.table(table);
        together();
        if (study_.outcome.follow != Follow::rest)
            page_.note("Each realization was computed only until its first fall.");
        directions();
    }

    /// In space.
    void directions()
    {
        FallRose rose;
        if (study_.structure.spatial())
            for (const ResultRow& row : rows_)
                rose.add(row.outcome);
        if (rose.falls() > 1)
            page_.figure(rose.svg("directions of the falls"), rose.caption());
    }

    /// The order of falls, where there are no rows.
    void first_falls()
    {
        HtmlTable table{"lrrr", {"block", "fell first", "share", describe_interval(counts_.interval())}, {}, ""};
        for (std::size_t i = 0; i < counts_.first().size(); ++i)
            if (const std::uint64_t first = counts_.first()[i]; first > 0) {
                const Share share = counts_.share_first(i);
                table.rows.push_back({header_.block_names[i], fmt::format("{} of {}", share.count, share.trials),
                                      percent_text(share.probability), interval_text(share)});
            }
        if (table.rows.empty() && counts_.first_together() == 0)
            return;
        page_.section("First to fall");
        page_.table(table);
        together();
    }

    void together()
    {
        if (counts_.first_together() > 0)
            page_.note(fmt::format("In {} realizations several blocks fell first in the same time step. None of them "
                                   "counts as the first there.",
                                   counts_.first_together()));
    }

    void motions()
    {
        std::vector<const ResultRow*> upright;
        for (const ResultRow* row : valid_)
            if (row->outcome.state != State::collapsed)
                upright.push_back(row);
        if (upright.empty())
            return;
        std::vector<const ResultRow*> resting;
        std::ranges::copy_if(upright, std::back_inserter(resting),
                             [](const ResultRow* row) { return row->outcome.at_rest != 0; });
        page_.section("Displacements");
        page_.table(
            quantile_table(upright, {{"largest displacement of the centre of the top block, from upright", "m",
                                      &Outcome::peak_top_displacement_m},
                                     {"sliding of all joints", "m", &Outcome::total_sliding_m},
                                     {"rocking of all joints", "rad", &Outcome::total_rocking_rad},
                                     {"largest rotation of a joint", "rad", &Outcome::max_relative_rotation_rad}}));
        if (!resting.empty())
            page_.table(quantile_table(resting, {{"residual displacement of the centre of the top block, with its sign",
                                                  "m", &Outcome::residual_top_displacement_m},
                                                 {"residual sliding of all joints", "m", &Outcome::residual_sliding_m},
                                                 {"largest residual dislocation of a joint, over its width", "",
                                                  &Outcome::residual_dislocation}}));
        if (rows_.size() == 1)
            return;
        page_.note(fmt::format("Over the {} without a fall{}; residuals over the {} of them that "
                               "were at rest at the end.",
                               counted(upright.size(), "valid realization"), surface_ ? ", in all cells" : "",
                               resting.size()));
    }

    void energy()
    {
        if (const Tally* tally = reader_.tally(); tally && tally->all_trials() > 0) {
            page_.section("Energy audit");
            page_.paragraph(worst_balance(tally->energy_residual, tally->energy_realization));
        }
        if (valid_.empty())
            return;
        page_.section("Energy audit");
        page_.table(quantile_table(valid_, {{"work of the base", "J", &Outcome::energy_base_work_j},
                                            {"kinetic, at the end", "J", &Outcome::energy_kinetic_j},
                                            {"potential, relative to the start", "J", &Outcome::energy_potential_j},
                                            {"contact springs, relative to the start", "J", &Outcome::energy_spring_j},
                                            {"dissipated by friction", "J", &Outcome::energy_friction_j},
                                            {"dissipated by damping", "J", &Outcome::energy_damping_j}}));
        const auto worst = std::max_element(valid_.begin(), valid_.end(), [](const ResultRow* a, const ResultRow* b) {
            return std::abs(a->outcome.energy_residual) < std::abs(b->outcome.energy_residual);
        });
        page_.paragraph(worst_balance((*worst)->outcome.energy_residual, (*worst)->index));
    }

    static std::string worst_balance(double residual, std::uint64_t index)
    {
        return fmt::format(
            "The residual of the energy balance is at most {:.2g} of the energy of the run (realization {}).",
            std::abs(residual), index);
    }

    void again()
    {
        page_.section("Reproduction");
        page_.paragraph(fmt::format("With stylobate {} and the study below as STUDY.toml:", header_.code_version));
        const std::string name = fs::path(results_.file()).filename().string();
        std::string commands;
        if (kind_.why_no_replay())
            commands = fmt::format("stylobate run STUDY.toml -o {}\n", name);
        else if (header_.kind == "replay")
            commands =
                fmt::format("stylobate run STUDY.toml -o STUDY.h5\nstylobate replay STUDY.h5 --realization {} -o "
                            "{}\n",
                            header_.first, name);
        else
            commands = fmt::format("stylobate run STUDY.toml -o {0}\nstylobate replay {0} --realization I    # any "
                                   "realization, bitwise identical\n",
                                   name);
        page_.block(commands);
        if (web_)
            page_.paragraph(Html::ready(fmt::format("<a href=\"{}#study={}\">Open the study in the browser</a>, "
                                                    "without a program.",
                                                    html_escaped(*web_), base64url(header_.study_toml))));
        page_.details("The study with all defaults", [&] { page_.block(header_.study_toml); });
    }

    /// Without its record a realization cannot be run again: the page states this and has all other parts.
    void motion(const ResultRow& row)
    {
        try {
            const TracedMotion f = traced_motion(results_, isa_, row.index);
            const std::string shaking = shaking_words(results_, row);
            const std::string which =
                fmt::format("Realization {}{}{}", row.index, shaking.empty() ? "" : ", ", shaking);
            picture(fmt::format("{}: {}.", which, to_string(row.outcome.state)),
                    [&](const fs::path& png) { strip_picture(results_, f, std::nullopt, png); });
            for (const Figure& figure : history_figures(results_, f))
                page_.figure(figure_svg(figure, 220),
                             which + ": displacement of the base, and of blocks against the base.");
        } catch (const InputError& error) {
            missing(fmt::format("Realization {}.", row.index), error);
        }
    }

    void picture(const std::string& caption, const std::function<void(const fs::path&)>& draw)
    {
        const fs::path png = folder_ / "picture.svg";
        try {
            draw(png);
            page_.figure(svg_image(png, caption), caption);
        } catch (const InputError& error) {
            missing(caption, error);
        }
    }

    void missing(const std::string& caption, const InputError& error)
    {
        warnings_.push_back(fmt::format("a picture is missing: {}", error.what()));
        page_.note(fmt::format("{} This picture could not be drawn: {}", caption, error.what()));
    }

    const Results& results_;
    const Isa isa_;
    const KeptAnimations& animations_;
    const std::optional<LawBand>& laws_;
    const std::optional<std::string>& web_;
    const ResultReader& reader_;
    const ResultHeader& header_;
    std::vector<std::string>& warnings_;
    const Study& study_;
    const Kind& kind_;
    const std::vector<ResultRow>& rows_;
    const LimitCounts& counts_;
    Document page_;
    PageWriter writer_;
    const bool surface_;
    std::vector<const ResultRow*> valid_;
    std::vector<std::pair<std::uint64_t, InvalidReason>> invalid_; ///< by index; where there are no rows the first ones
    std::uint64_t invalid_count_ = 0;
    const TemporaryFolder folder_;
};

} // namespace

Document result_page(const Results& results, Isa isa, const std::optional<std::string>& title,
                     const KeptAnimations& animations, const std::optional<LawBand>& laws,
                     const std::optional<std::string>& web, std::vector<std::string>& warnings)
{
    return ResultPage(results, isa, title, animations, laws, web, warnings).page();
}

} // namespace stylobate
