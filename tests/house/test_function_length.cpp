/// No function of the production code is longer than a screen or two: the whole reads like the method, and the steps
/// have names. One that is a flat list may be longer; then `// long: REASON` stands above it.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_function_lines = 80; // from the brace that opens a body to the one that closes it

struct LongFunction {
    std::size_t line;  ///< of its brace, from 1
    std::size_t lines; ///< of its body
};

/// The functions that are too long and do not say why. clang-format gives the shape that this relies on: the braces of
/// a function at namespace scope stand alone in the first column, those of a method in a class alone in the fifth.
std::vector<LongFunction> long_functions(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    std::vector<LongFunction> found;
    for (const std::string indent : {"", "    "}) {
        std::size_t opened = 0; // the line after it; 0: none is open
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (lines[i] == indent + "{")
                opened = i + 1;
            if (opened == 0 || lines[i] != indent + "}")
                continue;
            bool said = false; // in the comment or the declaration before the brace
            for (std::size_t k = opened - 1; k-- > 0 && !lines[k].empty() && !lines[k].starts_with(indent + "}");)
                said = said || lines[k].starts_with(indent + "// long: ");
            if (i + 2 - opened > most_function_lines && !said)
                found.push_back({opened, i + 2 - opened});
            opened = 0;
        }
    }
    return found;
}

} // namespace

TEST(House, NoFunctionHasTooManyLines)
{
    const fs::path root = STYLOBATE_SOURCE_DIR;
    std::size_t files = 0;
    for (const char* folder : {"kernels", "ensemble", "io", "studies", "library", "include", "python", "bench"}) {
        if (!fs::exists(root / folder))
            continue;
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            if (!std::set<std::string>{".cpp", ".hpp", ".cu", ".cuh"}.contains(entry.path().extension().string()))
                continue;
            ++files;
            std::ifstream file(entry.path());
            std::stringstream text;
            text << file.rdbuf();
            for (const LongFunction& f : long_functions(text.str()))
                ADD_FAILURE() << entry.path().lexically_relative(root).generic_string() << ':' << f.line
                              << ": a function of " << f.lines << " lines, more than " << most_function_lines
                              << ": name its steps, or say above it: // long: REASON";
        }
    }
    EXPECT_GT(files, 200U) << "the files were not found";
}

TEST(Rules, FindLongFunctions)
{
    const auto body = [](std::size_t lines, const std::string& indent) {
        std::string text = indent + "{\n";
        for (std::size_t i = 2; i < lines; ++i)
            text += indent + "    if (x) {\n"; // braces inside do not count
        return text + indent + "}\n";
    };
    const std::string function = "\nvoid f(int x,\n       int y)\n", method = "class A {\n\n    void f()\n";
    EXPECT_EQ(long_functions(function + body(most_function_lines, "")).size(), 0U);
    ASSERT_EQ(long_functions(function + body(most_function_lines + 1, "")).size(), 1U);
    EXPECT_EQ(long_functions(function + body(most_function_lines + 1, ""))[0].line, 4U);
    EXPECT_EQ(long_functions(function + body(most_function_lines + 1, ""))[0].lines, most_function_lines + 1);
    EXPECT_EQ(long_functions("\n// long: a flat list" + function.substr(0) + body(most_function_lines + 1, "")).size(),
              0U);
    EXPECT_EQ(long_functions(method + body(most_function_lines, "    ") + "};\n").size(), 0U);
    EXPECT_EQ(long_functions(method + body(most_function_lines + 1, "    ") + "};\n").size(), 1U);
}
