// Connections that convert or wait, in files that are saved.

#include <gmock/gmock.h>

#include "core/element/tags.h"
#include "core/module/group.h"
#include "core/paths/late_connections.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class SavedConnections : public ::testing::Test {
 protected:
  void Load(const std::string& text) {
    const auto file = folder_ / "app.xml";
    WriteAll(file, text);
    application_ = shop_.Load(file);
    ASSERT_NE(application_, nullptr);
  }
  std::string Text() { return shop_.Text(*application_, folder_.path()); }
  template <typename T>
  T& Get(const std::string& path) {
    return shop_.Get<T>(path);
  }
  FrameworkElement& Create(const std::string& type, const std::string& parent, const std::string& name) {
    return *shop_.plugins.modules().Create(type, Get<FrameworkElement>(parent), name).value();
  }
  void Delete(const std::string& path) { ASSERT_TRUE(shop_.runtime.Delete(Get<FrameworkElement>(path))); }

  TestFolder folder_;
  SavingWorkshop shop_;
  FrameworkElement* application_ = nullptr;
};

const char* const kConverting = R"(<application name="demo">
  <module name="source" type="test/source"/>
  <module name="sink" type="test/sink"/>
  <connect from="source/value" to="sink/label"/>
  <connect from="source/label" to="sink/value" convert="parse"/>
  <connect from="driver/value" to="sink/second" when="present" queue="2"/>
  <connect from="driver/scan.ranges[0]" to="gone/second" when="present"/>
</application>
)";

TEST_F(SavedConnections, KeepsConversionsAndConnectionsThatWait) {
  Load(kConverting);
  EXPECT_EQ(Text(), kConverting);
  auto& second = Get<Input<double>>("/demo/sink/input/second");
  EXPECT_TRUE(second.Sources().empty());
  auto& driver = Create("test/source", "/demo", "driver");
  ASSERT_TRUE(shop_.runtime.MakeReady(driver));
  EXPECT_EQ(second.Sources().size(), 1U);
  EXPECT_THAT(Text(), HasSubstr("<connect from=\"driver/value\" to=\"sink/second\" "
                                "when=\"present\" queue=\"2\"/>\n  <connect "
                                "from=\"driver/scan.ranges[0]\""));
  Delete("/demo/driver");
  EXPECT_EQ(Text(), kConverting);
}

TEST_F(SavedConnections, WritesConversionsAndConnectionsThatWaitAnew) {
  Load(R"(<application name="demo">
  <module name="source" type="test/source"/>
  <module name="sink" type="test/sink"/>
</application>
)");
  ASSERT_TRUE(Port::Connect(Get<Port>("/demo/source/output/value"), Get<Port>("/demo/sink/input/label")));
  ASSERT_TRUE(
      Port::Connect(Get<Port>("/demo/source/output/label"), Get<Port>("/demo/sink/input/value"), {.convert = "parse"}));
  ASSERT_TRUE(LateConnections::Of(shop_.runtime)
                  .Add("/demo/driver/scan", "/demo/sink/second", {.queue = 2, .part = "ranges[0]"}));
  const std::string text = Text();
  EXPECT_THAT(text, HasSubstr("<connect from=\"source/value\" to=\"sink/label\"/>"));
  EXPECT_THAT(text, HasSubstr("<connect from=\"source/label\" to=\"sink/value\" convert=\"parse\"/>"));
  EXPECT_THAT(text, HasSubstr("<connect from=\"driver/scan.ranges[0]\" to=\"sink/input/second\" "
                              "queue=\"2\" when=\"present\"/>"));
  ASSERT_TRUE(LateConnections::Of(shop_.runtime).Remove("/demo/driver/scan", "/demo/sink/second"));
  EXPECT_THAT(Text(), Not(HasSubstr("driver")));
}

const char* const kLimited = R"(<application name="demo">
  <module name="sink" type="test/sink" tags="safety first">
    <input name="value" default="0.5" minimum="0" maximum="1" out_of_bounds="clamp"/>
  </module>
</application>
)";

TEST_F(SavedConnections, LimitsOfInputsAndTagsStay) {
  Load(kLimited);
  auto& value = Get<Input<double>>("/demo/sink/input/value");
  EXPECT_EQ(value.Get(), 0.5);
  EXPECT_EQ(value.limits().maximum, 1.0);
  EXPECT_EQ(TagsText(Get<FrameworkElement>("/demo/sink")), "safety first");
  EXPECT_TRUE(HasTag(Get<FrameworkElement>("/demo/sink"), "first"));
  EXPECT_EQ(Text(), kLimited);
}

TEST_F(SavedConnections, WrongLimitsAreTold) {
  EXPECT_EQ(shop_.Errors(R"(<application name="demo">
  <module name="sink" type="test/sink">
    <input name="value"/>
    <input name="valeu" default="1"/>
    <input name="second" default="many"/>
    <input name="label" minimum="0"/>
  </module>
</application>)"),
            "app.xml:3:5: error: /demo/sink/value: <input> says nothing of its values; add "
            "default=\"…\", minimum=\"…\" or maximum=\"…\"\n"
            "app.xml:4:18: error: /demo/sink: there is no 'valeu' in /demo/sink; did you mean "
            "'value'?\n"
            "app.xml:5:35: error: /demo/sink/input/second: 'many' is no number\n"
            "app.xml:6:5: error: /demo/sink/input/label: a string has no bounds\n");
}

}  // namespace
}  // namespace runnel::testing
