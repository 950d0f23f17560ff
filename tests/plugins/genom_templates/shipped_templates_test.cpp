// What comes out of the templates that come with Runnel.

#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>

#include "core/base/files.h"
#include "core/xml/xml_document.h"
#include "plugins/genom_description/description.h"
#include "plugins/genom_templates/template_run.h"
#include "tests/support/temporary_folder.h"

namespace runnel::genom {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::vector<GeneratedFile> FilesOf(const std::string& name, const std::string& text) {
  Diagnostics diagnostics;
  const auto description = ReadDescriptionText(text, "test.gen", {}, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.ToString();
  const auto output =
      RunTemplate(std::string(RUNNEL_GENOM_TEMPLATE_FOLDER) + "/" + name, DescriptionJson(*description), {});
  EXPECT_TRUE(output) << output.error().ToString();
  return output ? output->files : std::vector<GeneratedFile>{};
}

std::string TextOfFile(const std::vector<GeneratedFile>& files, const std::string& path) {
  const auto found = std::ranges::find(files, path, &GeneratedFile::path);
  if (found != files.end()) return found->text;
  ADD_FAILURE() << "there is no " << path;
  return "";
}

std::string Component(const std::string& more_parameters, const std::string& more_codels) {
  return "/*/ Somebody's. */\nmodule m { struct s { double x; }; typedef sequence<s, 4> route; };\n"
         "component nav { doc \"Drives.\"; ids { m::s goal; string text; string<8> name; long grid[2][3]; m::route "
         "way; native_ n; };\n"
         "  port in m::s pose { doc \"where | it is\"; };\n"
         "  task drive { period 20 ms; codel<start> init(out goal, out text, out name, in grid, inout way) yield "
         "ether; };\n"
         "  activity go(in m::s to = { 3 : \"m\" }" +
         more_parameters +
         ") { task drive; validate check(local in to);\n"
         "    codel<start> begin(in to, out goal" +
         (more_parameters.empty() ? "" : ", in fast") +
         ") yield step;\n"
         "    codel<step> step(in goal, in pose) yield pause::step, " +
         (more_codels.empty() ? "ether" : "finish, ether") + ";" + more_codels + " };\n};\n";
}

std::string Described(const std::string& parameters = "", const std::string& codels = "") {
  std::string text = Component(parameters, codels);
  text.replace(text.find("native_ n;"), 10, "planner n;");
  return text.insert(text.find("component"), "native planner;\n");
}

TEST(SkeletonTest, SignaturesAreThoseOfTheOriginal) {
  const auto files = FilesOf("skeleton", Described());
  const std::string text = TextOfFile(files, "codels/nav_drive_codels.c");
  EXPECT_THAT(text, HasSubstr("/*\n * Somebody's.\n *\n * Codels of task drive of nav.\n */\n"));
  EXPECT_THAT(text, HasSubstr("genom_event\ninit(m_s *goal, char **text, char name[8], const int32_t grid[2][3],\n"
                              "     m_route *way, const genom_context self)\n{\n  return nav_ether;\n}\n"));
  EXPECT_THAT(text, HasSubstr("step(const m_s *goal, const nav_pose *pose, const genom_context self)\n{\n"
                              "  return nav_pause_step;\n}\n"));
  EXPECT_THAT(text, HasSubstr("#include \"acnav.h\"\n\n#include \"nav_c_types.h\"\n"));
  EXPECT_THAT(TextOfFile(files, "codels/nav_codels.c"),
              HasSubstr("check(const m_s *to, const genom_context self)\n{\n  return genom_ok;\n}\n"));
  EXPECT_THAT(
      TextOfFile(files, "CMakeLists.txt"),
      HasSubstr("  DESCRIPTION \"test.gen\"\n  CODELS\n    codels/nav_codels.c\n    codels/nav_drive_codels.c\n  )\n"));
}

TEST(SkeletonTest, MadeAnewItKeepsWhatWasFilledIn) {
  const test::TemporaryFolder folder;
  Diagnostics diagnostics;
  (void)WriteFiles(folder.path(), FilesOf("skeleton", Described()), WhatIsThere::kIsMerged, diagnostics);
  const auto file = folder.path() / "codels/nav_drive_codels.c";
  std::string text = TextOfFile(file).value();
  const std::string untouched = "  return nav_step;\n";
  text.replace(text.find(untouched), untouched.size(), "  *goal = *to;\n  goal->x += 1;\n  return nav_step;\n");
  std::ofstream(file) << text;
  // A parameter and a state more.
  (void)WriteFiles(folder.path(),
                   FilesOf("skeleton", Described(", in boolean fast", " codel<finish> finish(out goal) yield ether;")),
                   WhatIsThere::kIsMerged, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.ToString();
  EXPECT_THAT(TextOfFile(file).value(),
              AllOf(HasSubstr("begin(const m_s *to, m_s *goal, bool fast, const genom_context self)\n{\n"
                              "  *goal = *to;\n  goal->x += 1;\n  return nav_step;\n}\n"),
                    HasSubstr("finish(m_s *goal, const genom_context self)\n"), Not(HasSubstr("<<<<<<<"))));
  // The user changed the signature, and so does the description.
  text = TextOfFile(file).value();
  text.replace(text.find("bool fast"), 9, "int fast");
  std::ofstream(file) << text;
  const auto written =
      WriteFiles(folder.path(), FilesOf("skeleton", Described(", in long fast")), WhatIsThere::kIsMerged, diagnostics);
  EXPECT_EQ(std::ranges::count(written, WrittenFile::What::kConflict, &WrittenFile::what), 1);
  EXPECT_THAT(TextOfFile(file).value(), HasSubstr("<<<<<<< yours\n"));
}

TEST(DocsTest, APageAndItsDrawings) {
  const auto files = FilesOf("docs", Described());
  EXPECT_THAT(TextOfFile(files, "nav.md"),
              AllOf(HasSubstr("# nav\n\nDrives.\n"), HasSubstr("| `pose` | in | `m::s` | where \\| it is |"),
                    HasSubstr("| `to` | in | `m::s` | `{x: 3.0}` | x: m |"), HasSubstr("Runs each 20 ms."),
                    HasSubstr("![States of go](nav_go.svg)"), HasSubstr("| `step` | step | pause::step, ether |  |")));
  const auto drawing = XmlDocument::Parse(TextOfFile(files, "nav_go.svg"), "nav_go.svg");
  EXPECT_TRUE(drawing) << drawing.error().ToString();
  EXPECT_THAT(TextOfFile(files, "nav_go.svg"), AllOf(HasSubstr(">start</text>"), HasSubstr("stroke-dasharray")));
}

TEST(ShippedTemplatesTest, ConstantsAndDefaultsAreWhatTheDescriptionSays) {
  const std::string text =
      "const unsigned long long most = 18446744073709551615; const unsigned long long few = 3;\n"
      "component c { function f(in unsigned long long a = most, in string s = \"two\nlines\", in string<3> u = "
      "\"aa\u00fc\"); };\n";
  const std::string standalone = TextOfFile(FilesOf("standalone", text), "c_standalone.cpp");
  EXPECT_THAT(standalone, AllOf(HasSubstr(R"("18446744073709551615")"), HasSubstr(R"("\"two\\u000alines\"")"),
                                HasSubstr(R"("\"aa\"")")));
  const std::string in_c = TextOfFile(FilesOf("mappings", text), "c_c_types.h");
  EXPECT_THAT(in_c, AllOf(HasSubstr("#define most 18446744073709551615ull\n"), HasSubstr("#define few 3\n")));
  std::string cxx = text;
  cxx.insert(cxx.find("function"), "lang \"c++\"; ");
  EXPECT_THAT(TextOfFile(FilesOf("mappings", cxx), "c_cxx_types.h"),
              AllOf(HasSubstr("most = 18446744073709551615ull;"), HasSubstr("few = 3;")));
}

}  // namespace
}  // namespace runnel::genom
