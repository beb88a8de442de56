#include "studies/verify/verification.hpp"

#include "io/files/suggest.hpp"
#include "studies/version.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace stylobate {

namespace {

const char* word_of(CheckVerdict verdict)
{
    switch (verdict) {
    case CheckVerdict::passed:
        return "ok";
    case CheckVerdict::differs:
        return "differs";
    case CheckVerdict::not_done:
        return "not checked";
    }
    return "";
}

std::string written_by(const FileVerification& v)
{
    return v.build.empty() ? v.code_version : fmt::format("{} ({})", v.code_version, v.build);
}

std::string version_note(const FileVerification& v)
{
    return v.same_version ? ""
                          : fmt::format("This is version {}: realizations that are run again may differ in their last "
                                        "bits, or by more where its changelog lists results that move.",
                                        code_version());
}

} // namespace

void FileCheck::add(ValueDifference difference)
{
    verdict = CheckVerdict::differs;
    if (full())
        ++more;
    else
        differences.push_back(std::move(difference));
}

bool FileVerification::well() const
{
    return std::ranges::none_of(checks, [](const FileCheck& check) { return check.verdict == CheckVerdict::differs; });
}

std::string text_of(const FileVerification& v)
{
    std::string text = fmt::format(
        "{}: {} of {} realizations of a study of kind {} (study {}), {}\n  written by stylobate {}\n", v.file, v.done,
        v.realizations, v.kind, v.study_crc32, v.complete ? "complete" : "unfinished", written_by(v));
    if (const std::string note = version_note(v); !note.empty())
        text += fmt::format("  {}\n", note);
    for (const FileCheck& check : v.checks) {
        text += fmt::format("  {:<10}{:<13}{}\n", check.name, word_of(check.verdict), check.text);
        for (const ValueDifference& d : check.differences)
            text += fmt::format("    {}{}: {}{}\n",
                                d.realization ? fmt::format("realization {}, ", *d.realization) : "", d.where, d.stored,
                                d.expected.empty() ? "" : fmt::format(" in the file, {} expected", d.expected));
        if (check.more > 0)
            text += fmt::format("    and {}\n", counted(check.more, "other"));
    }
    return text;
}

Json json_of(const FileVerification& v)
{
    Json checks = Json::list();
    for (const FileCheck& check : v.checks) {
        Json differences = Json::list();
        for (const ValueDifference& d : check.differences) {
            Json one = Json::object();
            one.member("where", d.where);
            if (d.realization)
                one.member("realization", *d.realization);
            differences.item(one.member("stored", d.stored).member("expected", d.expected));
        }
        checks.item(Json::object()
                        .member("name", check.name)
                        .member("verdict", word_of(check.verdict))
                        .member("text", check.text)
                        .member("found", check.found())
                        .member("differences", differences));
    }
    return Json::object()
        .member("file", v.file)
        .member("kind", v.kind)
        .member("realizations", v.realizations)
        .member("done", v.done)
        .member("complete", v.complete)
        .member("code_version", v.code_version)
        .member("build", v.build)
        .member("same_version", v.same_version)
        .member("study_crc32", v.study_crc32)
        .member("well", v.well())
        .member("checks", checks);
}

} // namespace stylobate
