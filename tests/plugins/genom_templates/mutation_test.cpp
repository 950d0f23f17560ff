// Templates with mistakes put in at random neither crash nor hang what runs them, and their errors say where they are; meant to
// be run with the sanitizers, too.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <random>

#include <gmock/gmock.h>

#include "core/base/files.h"
#include "plugins/genom_description/description.h"
#include "plugins/genom_templates/template_run.h"
#include "tests/support/temporary_folder.h"

namespace runnel::genom {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNavDescription =
    "module m { struct s { double x; }; typedef sequence<s, 4> route; enum e { A, B }; };\n"
    "component nav { version \"1\"; lang \"c\"; exception lost { m::e why; }; ids { m::s goal; string<8> name; "
    "m::route way; };\n"
    "  port in m::s pose; port out m::s wish; port multiple in m::s others;\n"
    "  task drive { period 20 ms; codel<start> init(out goal, in name) yield ether; codel<stop> quiet(out wish) yield "
    "ether; };\n"
    "  attribute set_goal(in goal = { 3 : \"m\" }); function reset() { codel clear(out way); interrupts go; };\n"
    "  activity go(in m::s to = { 1 }, out m::e how) { task drive; validate check(local in to); throw lost;\n"
    "    codel<start> begin(in to, out how) yield step; codel<step> step(in goal, in pose) yield pause::step, ether; "
    "};\n};\n";

constexpr std::array kTemplatePieces = {"<%",
                                        "%>",
                                        "<%=",
                                        "<%= nil %>",
                                        "<% end %>",
                                        "<% if true then %>",
                                        "<% for i = 1, 3 do %>",
                                        "<% while true do %>",
                                        "<% error({}) %>",
                                        "<% write() %>",
                                        "<%= text('nowhere.in') %>",
                                        "<%= library('show') %>",
                                        "end ",
                                        "do ",
                                        "(",
                                        ")",
                                        "{",
                                        "}",
                                        "\"",
                                        "'",
                                        "[[",
                                        "]]",
                                        "--",
                                        "--[[",
                                        "nil ",
                                        "model ",
                                        "model.",
                                        "local ",
                                        "return ",
                                        "function() ",
                                        "..",
                                        "#",
                                        "=",
                                        "~",
                                        "goto a ",
                                        "::a::",
                                        "0x",
                                        "1e400",
                                        "\\",
                                        "\n",
                                        "\r",
                                        "\xff",
                                        "%",
                                        ",",
                                        ";",
                                        " and ",
                                        " or ",
                                        " not ",
                                        ":gsub('(a*)*b', '%1')"};

int MutationCount() {
  const char* const said = std::getenv("RUNNEL_MUTATIONS");
  return said != nullptr ? std::atoi(said) : 150;
}

class TemplateMutationTest : public testing::Test {
 protected:
  TemplateMutationTest() {
    fs::copy(RUNNEL_GENOM_TEMPLATE_FOLDER, folder_.path(),
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    for (const auto& each : fs::recursive_directory_iterator(folder_.path())) {
      if (each.is_regular_file()) files_.push_back(each.path());
    }
    std::ranges::sort(files_);
    Diagnostics diagnostics;
    const auto description = ReadDescriptionText(kNavDescription, "test.gen", {}, diagnostics);
    EXPECT_TRUE(diagnostics.ok()) << diagnostics.ToString();
    model_ = DescriptionJson(*description);
  }

  std::size_t Below(std::size_t bound) { return bound == 0 ? 0 : static_cast<std::size_t>(random_() % bound); }

  std::string Mutated(std::string text) {
    const int count = random_() % 2 == 0 ? 1 : 1 + static_cast<int>(Below(4));
    for (int i = 0; i < count; ++i) {
      // Mostly where scripts are.
      std::size_t at = Below(text.size() + 1);
      if (const std::size_t marker = text.find("<%", at); marker != std::string::npos && random_() % 4 != 0)
        at = std::min(text.size(), marker + Below(40));
      const std::size_t length = Below(std::min<std::size_t>(text.size() - at + 1, 30));
      switch (random_() % 5) {
        case 0:
          text.erase(at, length);
          break;
        case 1:
          text.insert(at, text.substr(at, length));
          break;
        case 2:
          if (at < text.size()) text[at] = static_cast<char>(random_());
          break;
        default:
          text.insert(at, kTemplatePieces[Below(kTemplatePieces.size())]);
      }
    }
    return text;
  }

  test::TemporaryFolder folder_;
  std::vector<fs::path> files_;
  std::string model_;
  std::mt19937 random_{22};
  int unplaced_ = 0;
};

TEST_F(TemplateMutationTest, WhateverIsRunEndsAndErrorsHavePlaces) {
  constexpr std::array kTemplates = {"docs", "mappings", "promela", "runnel", "skeleton", "standalone"};
  int right = 0, wrong = 0;
  const int count = MutationCount();
  for (int i = 0; i < count; ++i) {
    const fs::path& file = files_[Below(files_.size())];
    const std::string before = *TextOfFile(file);
    const std::string text = Mutated(before);
    std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
    // One that reads the file: its own, or any, for what they share.
    const std::string own = file.parent_path().filename();
    const std::string name = own == "library" ? kTemplates[Below(kTemplates.size())] : own;
    const auto result = RunTemplate(folder_.path() / name, model_, {}, {.steps = 20'000'000, .bytes = 100'000'000});
    result ? ++right : ++wrong;
    if (!result) {
      const Error& error = result.error();
      EXPECT_FALSE(error.message.empty());
      // What templates say of a description by fail(), which a mistake may have them say, has no place in them.
      if (error.position.file.empty()) {
        ++unplaced_;
      } else {
        EXPECT_TRUE(fs::exists(error.position.file)) << error.ToString();
      }
    }
    std::ofstream(file, std::ios::binary | std::ios::trunc) << before;
  }
  EXPECT_GT(right, 0);
  EXPECT_GT(wrong, 0);
  EXPECT_LE(unplaced_ * 20, wrong) << "nearly all errors have a place";
}

}  // namespace
}  // namespace runnel::genom
