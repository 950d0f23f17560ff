// What is saved of groups that other files describe.

#include <gmock/gmock.h>

#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

const char* const kPart = R"(<group_type>
  <parameter name="gain" value="2"/>
  <parameter name="file" value="a.txt"/>
  <port name="out" direction="output"/>
  <module name="source" type="test/source">
    <parameter name="gain" from="gain"/>
    <parameter name="file" from="file"/>
  </module>
  <module name="sink" type="test/sink"/>
  <connect from="source/value" to="out sink/value"/>
</group_type>
)";
const char* const kApplication = R"(<application name="demo">
  <!-- two of a kind -->
  <group name="left" type="part.xml"/>
  <group name="right"  type='part.xml'>
    <parameter name="gain" value="5"/>
    <parameter name="file" value="b.txt"/>
    <parameter of="source" name="count" value="4"/>
  </group>
  <group name="nested" type="nested.xml"/>
  <module name="sink" type="test/sink"/>
  <connect from="left/out" to="sink/value"/>
</application>
)";

class PartSaving : public ::testing::Test {
 protected:
  PartSaving() {
    WriteAll(folder_ / "part.xml", kPart);
    WriteAll(folder_ / "nested.xml", "<group_type><group name=\"inner\" type=\"part.xml\"/></group_type>");
    WriteAll(folder_ / "app.xml", kApplication);
    application_ = shop_.Load(folder_ / "app.xml");
  }
  std::string Text() { return shop_.Text(*application_, folder_.path()); }
  static std::string With(const std::string& from, const std::string& to) {
    std::string text = kApplication;
    return text.replace(text.find(from), from.size(), to);
  }

  TestFolder folder_;
  SavingWorkshop shop_;
  FrameworkElement* application_ = nullptr;
};

TEST_F(PartSaving, LeavesWhatHasNotChanged) { EXPECT_EQ(Text(), kApplication); }

TEST_F(PartSaving, WritesAValueWithinAGroupForThatGroup) {
  ASSERT_TRUE(shop_.Get<Source>("/demo/left/source").gain.Set(3));
  ASSERT_TRUE(shop_.Get<Source>("/demo/right/source").count.Set(6));
  ASSERT_TRUE(shop_.Get<Source>("/demo/nested/inner/source").gain.Set(7));
  const std::string text = Text();
  EXPECT_THAT(text, HasSubstr("  <group name=\"left\" type=\"part.xml\">\n"
                              "    <parameter of=\"source\" name=\"gain\" value=\"3\"/>\n"
                              "  </group>\n"));
  EXPECT_THAT(text, HasSubstr("<parameter of=\"source\" name=\"count\" value=\"6\"/>"));
  EXPECT_THAT(text, HasSubstr("<parameter of=\"inner/source\" name=\"gain\" value=\"7\"/>"));

  ASSERT_TRUE(SaveApplication(application_->runtime(), *application_, shop_.tools()));
  SavingWorkshop second;
  FrameworkElement* const again = second.Load(folder_ / "app.xml");
  ASSERT_NE(again, nullptr);
  EXPECT_EQ(StructureText(*again), StructureText(*application_));
  EXPECT_EQ(second.Text(*again, folder_.path()), text);
}

TEST_F(PartSaving, LeavesNamesThatParametersHadBefore) {
  std::string part = kPart;
  part.replace(part.find("\"gain\" from"), 6, "\"boost\"");
  WriteAll(folder_ / "part.xml", part);
  SavingWorkshop second;
  FrameworkElement* const again = second.Load(folder_ / "app.xml");
  ASSERT_NE(again, nullptr);
  EXPECT_EQ(second.Text(*again, folder_.path()), kApplication);
}

TEST_F(PartSaving, RefusesOtherChangesWithin) {
  ASSERT_TRUE(Port::Disconnect(shop_.Get<Port>("/demo/right/source/output/value"),
                               shop_.Get<Port>("/demo/right/sink/input/value")));
  const auto text = testing::ApplicationText(*application_, shop_.tools(), folder_.path());
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().path, "/demo/right");
  EXPECT_THAT(text.error().message, HasSubstr("part.xml says what is in all groups"));
}

TEST_F(PartSaving, RefusesNewModulesWithin) {
  auto& inner = shop_.Get<FrameworkElement>("/demo/nested/inner");
  ASSERT_TRUE(shop_.plugins.modules().Create("test/sink", inner, "new"));
  const auto text = testing::ApplicationText(*application_, shop_.tools(), folder_.path());
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().path, "/demo/nested/inner");
}

TEST_F(PartSaving, CutsAGroupThatIsGone) {
  ASSERT_TRUE(shop_.runtime.Delete(shop_.Get<FrameworkElement>("/demo/left")));
  std::string expected = With("  <group name=\"left\" type=\"part.xml\"/>\n", "");
  const std::string connect = "  <connect from=\"left/out\" to=\"sink/value\"/>\n";
  expected.erase(expected.find(connect), connect.size());
  EXPECT_EQ(Text(), expected);
}

TEST_F(PartSaving, WritesNamesOfFilesForAnotherFolder) {
  const std::string text = shop_.Text(*application_, folder_ / "below");
  EXPECT_THAT(text, HasSubstr("type=\"../part.xml\""));
  EXPECT_THAT(text, HasSubstr("type='../part.xml'"));
  EXPECT_THAT(text, HasSubstr("value=\"../b.txt\""));
}

}  // namespace
}  // namespace runnel::testing
