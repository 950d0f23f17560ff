// The schema that is committed, and what it says of files.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>

#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

const std::string kSchema = RUNNEL_XML "/runnel.xsd";

std::string ReadAll(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// 0 if the file is what the schema says.
int Validate(const std::string& file) {
  return std::system(("xmllint --noout --schema " + kSchema + " " + file + " >/dev/null 2>&1").c_str());
}

bool HasXmllint() { return std::system("xmllint --version >/dev/null 2>&1") == 0; }

TEST(Schema, IsTheCommittedOne) {
  const TemporaryFolder folder;
  const std::string written = folder / "schema.xsd";
  // Without the plugins of the tests.
  const std::string command = "env -u RUNNEL_PLUGIN_PATH " RUNNEL_PROGRAM " schema -o " + written;
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(ReadAll(written), ReadAll(kSchema))
      << "the words or types of application files have changed: write the schema anew by\n"
         "  runnel schema -o xml/runnel.xsd";
}

TEST(Schema, AcceptsTheApplicationsThatComeWithIt) {
  if (!HasXmllint()) GTEST_SKIP() << "needs xmllint, of the package libxml2-utils";
  int count = 0;
  for (const char* folder : {RUNNEL_XML "/apps", RUNNEL_XML "/parts"}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".xml") continue;
      EXPECT_EQ(Validate(entry.path().string()), 0) << entry.path();
      ++count;
    }
  }
  EXPECT_GT(count, 2);
}

TEST(Schema, RefusesMistakes) {
  if (!HasXmllint()) GTEST_SKIP() << "needs xmllint, of the package libxml2-utils";
  const TemporaryFolder folder;
  const std::string file = folder / "schema.xml";
  const auto is_refused = [&](const std::string& inside) {
    std::ofstream(file) << "<application name=\"a\">" << inside << "</application>";
    return Validate(file) != 0;
  };
  EXPECT_FALSE(
      is_refused("<module name=\"m\" type=\"planning/bug2\">"
                 "<parameter name=\"cruise_speed\" value=\"1\"/></module>"
                 "<thread name=\"t\" period=\"5 ms\"/>"));
  EXPECT_TRUE(is_refused("<module name=\"m\" type=\"planning/bug9\"/>"));
  EXPECT_TRUE(is_refused("<module type=\"planning/bug2\"/>"));
  EXPECT_TRUE(is_refused("<module name=\"a b\" type=\"planning/bug2\"/>"));
  EXPECT_TRUE(
      is_refused("<module name=\"m\" type=\"planning/bug2\">"
                 "<parameter name=\"nonsense\" value=\"1\"/></module>"));
  EXPECT_TRUE(is_refused("<thread name=\"t\" period=\"5\"/>"));
  EXPECT_TRUE(is_refused("<thread name=\"t\" activation=\"now\"/>"));
  EXPECT_TRUE(is_refused("<conect from=\"a\" to=\"b\"/>"));
  EXPECT_TRUE(is_refused("<connect from=\"a\" to=\"b\" queue=\"-1\"/>"));
  EXPECT_FALSE(is_refused("<connect from=\"a\" to=\"b\" pull=\"true\"/>"));
  EXPECT_TRUE(is_refused("<connect from=\"a\" to=\"b\" pull=\"1\"/>"));
}

TEST(Graph, IsDrawnWithGroupsThreadsAndQueues) {
  const TemporaryFolder folder;
  const std::string file = folder / "graph.dot";
  const Ended ended = Runnel("graph " RUNNEL_XML "/apps/bug_demo.xml -o " + file);
  ASSERT_EQ(ended.code, 0) << ended.text;
  const std::string text = ReadAll(file);
  using testing::HasSubstr;
  EXPECT_THAT(text, HasSubstr("subgraph \"cluster_/bug_demo/robot\""));
  EXPECT_THAT(text, HasSubstr("planning/bug2"));
  EXPECT_THAT(text, HasSubstr("control (every 50ms)"));
  EXPECT_THAT(text, HasSubstr("/bug_demo/robot/planner/output/twist"));
}

TEST(Graph, SaysWhatIsMissing) {
  EXPECT_THAT(Runnel("graph " RUNNEL_XML "/apps/bug_demo.xml -o x.jpg").text,
              testing::HasSubstr("its name ends in .svg"));
  const TemporaryFolder folder;
  const std::string picture = folder / "graph.svg";
  const std::string command = "env PATH=/nowhere " RUNNEL_PROGRAM " graph " RUNNEL_XML "/apps/bug_demo.xml -o " +
                              picture + " 2>" + picture + ".said";
  EXPECT_NE(std::system(command.c_str()), 0);
  EXPECT_THAT(ReadAll(picture + ".said"), testing::HasSubstr("install the package graphviz"));
  EXPECT_FALSE(std::filesystem::exists(picture));
}

TEST(Graph, IsAPicture) {
  if (std::system("dot -V >/dev/null 2>&1") != 0) GTEST_SKIP() << "needs dot, of package graphviz";
  const TemporaryFolder folder;
  const std::string picture = folder / "graph.svg";
  const Ended ended = Runnel("graph " RUNNEL_XML "/apps/bug_demo.xml -o " + picture);
  ASSERT_EQ(ended.code, 0) << ended.text;
  EXPECT_THAT(ReadAll(picture), testing::HasSubstr("</svg>"));
}

}  // namespace
}  // namespace runnel::test
