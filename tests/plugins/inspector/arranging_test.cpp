#include <fstream>
#include <iterator>

#include "plugins/inspector/internal/inspection.h"
#include "tests/plugins/inspector/inspector_fixture.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {

namespace {

using internal::Arrangement;

class Arranging : public RunningInspectorTest {
 protected:
  [[nodiscard]] std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  [[nodiscard]] std::string Read(const std::string& name) const {
    std::ifstream stream(folder_.path() / name);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Arranging, IsToldToAllViewersAndKeptBesideTheApplication) {
  Start({.file = File("robot.xml")});
  Viewer viewer = View();
  Viewer other = View();
  other.Next("structure");
  const Json reply =
      viewer.Ask({{"op", "arrange"}, {"entries", {{"place /app/a", "12 40"}, {"note /app/a", "a \"fast\" one"}}}});
  EXPECT_EQ(reply["ok"], true) << reply.dump();
  EXPECT_EQ(other.Next("layout")["entries"]["place /app/a"], "12 40");
  EXPECT_EQ(Read("robot.layout.json"),
            "{\n  \"note /app/a\": \"a \\\"fast\\\" one\",\n  \"place /app/a\": \"12 40\"\n}\n");
  viewer.Ask({{"op", "arrange"}, {"entries", {{"note /app/a", ""}}}});
  EXPECT_EQ(other.Next("layout")["entries"], Json({{"note /app/a", ""}}));
  EXPECT_EQ(View().Next("layout")["entries"], Json({{"place /app/a", "12 40"}}));
}

TEST_F(Arranging, ComesBackWithTheApplication) {
  std::ofstream(File("robot.layout.json")) << R"({"place /app/b": "1 2"})";
  Start({.file = File("robot.xml")});
  EXPECT_EQ(View().Next("layout")["entries"], Json({{"place /app/b", "1 2"}}));
}

TEST_F(Arranging, WithoutAFileItIsKeptWhileItRuns) {
  Start();
  EXPECT_EQ(View().Ask({{"op", "arrange"}, {"entries", {{"note /app/a", "x"}}}})["ok"], true);
  EXPECT_EQ(View().Next("layout")["entries"], Json({{"note /app/a", "x"}}));
}

TEST_F(Arranging, IsRefusedWhereNothingMayBeChangedOrWritten) {
  Start({.file = "/nowhere/at/all.xml"});
  const Json reply = View().Ask({{"op", "arrange"}, {"entries", {{"note /app/a", "x"}}}});
  EXPECT_EQ(reply["ok"], false);
  EXPECT_THAT(reply["errors"][0]["message"].get<std::string>(), testing::HasSubstr("/nowhere"));
}

TEST_F(Arranging, IsRefusedReadOnly) {
  Start({.file = File("robot.xml"), .is_read_only = true});
  EXPECT_EQ(View().Ask({{"op", "arrange"}, {"entries", {{"note /app/a", "x"}}}})["ok"], false);
  EXPECT_EQ(Read("robot.layout.json"), "");
}

TEST(ArrangementTest, TellsWhatHasChangedSince) {
  Arrangement arrangement;
  EXPECT_TRUE(arrangement.Change({{"a", "1"}, {"b", "2"}}));
  const auto before = arrangement.revision();
  EXPECT_TRUE(arrangement.Change({{"a", ""}}));
  EXPECT_EQ(arrangement.Since(before), (Arrangement::Entries{{"a", ""}}));
  EXPECT_EQ(arrangement.Since(0), (Arrangement::Entries{{"b", "2"}}));
  EXPECT_EQ(arrangement.Since(arrangement.revision()), Arrangement::Entries{});
}

TEST(ArrangementTest, TakesNothingTooLong) {
  Arrangement arrangement;
  EXPECT_FALSE(arrangement.Change({{"a", "1"}, {"b", std::string(Arrangement::kLongestText + 1, 'x')}}));
  EXPECT_FALSE(arrangement.Change({{"", "1"}}));
  EXPECT_EQ(arrangement.Text(), "");
}

TEST_F(Arranging, AFileThatIsNoneIsAnErrorAndNotTakenOver) {
  std::ofstream(File("robot.layout.json")) << "{\"a\": ";
  Arrangement arrangement;
  EXPECT_FALSE(arrangement.Read(File("robot.layout.json")));
  EXPECT_TRUE(arrangement.Read(File("missing.layout.json")));
  EXPECT_EQ(arrangement.revision(), 0U);
  EXPECT_EQ(Arrangement::FileOf("/x/robot.xml"), "/x/robot.layout.json");
  EXPECT_EQ(Arrangement::FileOf(""), "");
}

}  // namespace

}  // namespace runnel::test
