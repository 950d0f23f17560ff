// Groups that other files describe: what they become, and what is told of mistakes in them.

#include "plugins/application_files/part_files.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/port/proxy_port.h"
#include "tests/plugins/application_files/reading/test_application.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

class PartFilesTest : public ::testing::Test {
 protected:
  PartFilesTest() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "parts");
  }
  ~PartFilesTest() override { std::filesystem::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  // What building app.xml says; the folder is left out.
  std::string Errors(BuildMode mode = BuildMode::kRun) {
    const BuildOutcome outcome =
        BuildApplication(folder_ / "app.xml", {shop_.runtime, shop_.plugins, shop_.tags, shop_.configuration}, mode);
    std::string text = outcome.diagnostics.ToString();
    const std::string folder = folder_.string() + "/";
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
      text.erase(at, folder.size());
    }
    return text;
  }

  std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) / "part_files_test" /
                                  ::testing::UnitTest::GetInstance()->current_test_info()->name();
  Workshop shop_;
};

const char* const kAmplifier = R"(<group_type description="makes values larger">
  <parameter name="gain" value="2"/>
  <parameter name="file" value="in_part.xml"/>
  <port name="out" direction="output"/>
  <module name="source" type="test/source">
    <parameter name="gain" from="gain"/>
    <parameter name="file" from="file"/>
  </module>
  <module name="filter" type="test/filter"/>
  <connect from="source/value" to="filter/value"/>
  <connect from="filter/value" to="out"/>
</group_type>
)";

TEST_F(PartFilesTest, MakeOneGroupForEachUse) {
  Write("parts/amplifier.xml", kAmplifier);
  Write("app.xml", R"(<application name="demo">
  <group name="left" type="parts/amplifier.xml"/>
  <group name="right" type="parts/amplifier.xml">
    <parameter name="gain" value="5" command_line="gain"/>
    <parameter name="file" value="in_application.xml"/>
  </group>
  <group name="inner">
    <group name="third" type="parts/amplifier.xml">
      <parameter of="source" name="count" value="8"/>
    </group>
  </group>
  <module name="sink" type="test/sink"/>
  <connect from="left/out" to="sink/value"/>
  <connect from="right/out" to="sink/second"/>
</application>)");
  ASSERT_TRUE(shop_.configuration.AddArgument("gain=7"));
  ASSERT_EQ(Errors(), "");
  EXPECT_EQ(shop_.Get<Source>("/demo/left/source").gain.Get(), 2);
  EXPECT_EQ(shop_.Get<Source>("/demo/right/source").gain.Get(), 7);
  EXPECT_EQ(shop_.Get<Source>("/demo/inner/third/source").count.Get(), 8);
  EXPECT_EQ(shop_.Get<Source>("/demo/left/source").count.Get(), 3);
  EXPECT_EQ(shop_.Get<Source>("/demo/left/source").file.Get().text, (folder_ / "parts/in_part.xml").string());
  EXPECT_EQ(shop_.Get<Source>("/demo/right/source").file.Get().text, (folder_ / "in_application.xml").string());
  EXPECT_EQ(shop_.Get<Sink>("/demo/sink").value.Sources().size(), 1u);
  EXPECT_EQ(shop_.Get<FrameworkElement>("/demo/left").FindAnnotation<PartInstance>()->file,
            (folder_ / "parts/amplifier.xml").string());
}

TEST_F(PartFilesTest, MayBeInOneAnother) {
  Write("parts/amplifier.xml", kAmplifier);
  Write("parts/pair.xml", R"(<group_type>
  <parameter name="strength" value="4"/>
  <port name="out" direction="output"/>
  <group name="a" type="amplifier.xml">
    <parameter name="gain" from="strength"/>
  </group>
  <group name="b" type="../parts/amplifier.xml"/>
  <connect from="a/out" to="out"/>
</group_type>)");
  Write("app.xml", R"(<application name="demo">
  <group name="one" type="parts/pair.xml"/>
  <group name="two" type="parts/pair.xml"><parameter name="strength" value="6"/></group>
  <module name="sink" type="test/sink"/>
  <connect from="one/out" to="sink/value"/>
</application>)");
  ASSERT_EQ(Errors(), "");
  EXPECT_EQ(shop_.Get<Source>("/demo/one/a/source").gain.Get(), 4);
  EXPECT_EQ(shop_.Get<Source>("/demo/one/b/source").gain.Get(), 2);
  EXPECT_EQ(shop_.Get<Source>("/demo/two/a/source").gain.Get(), 6);
  EXPECT_EQ(shop_.Get<Port>("/demo/sink/input/value").Sources().size(), 1u);
}

TEST_F(PartFilesTest, TakeTheTypeOfAPortFromOutsideToo) {
  Write("part.xml", R"(<group_type>
  <port name="in" direction="input"/>
</group_type>)");
  Write("app.xml", R"(<application name="demo">
  <module name="source" type="test/source"/>
  <group name="part" type="part.xml"/>
  <connect from="source/label" to="part/in"/>
</application>)");
  ASSERT_EQ(Errors(), "");
  EXPECT_EQ(&shop_.Get<Port>("/demo/part/in").type(), &TypeOf<std::string>());
}

TEST_F(PartFilesTest, NameTheLineWithinAndWhereItIsUsedOnce) {
  Write("part.xml", R"(<group_type>
  <module name="a" type="test/source">
    <parameter name="gian" value="1"/>
  </module>
</group_type>)");
  Write("whole.xml", R"(<group_type>
  <group name="x" type="part.xml"/>
</group_type>)");
  Write("app.xml", R"(<application name="demo">
  <group name="one" type="whole.xml"/>
  <group name="two" type="whole.xml"/>
</application>)");
  EXPECT_EQ(Errors(),
            "part.xml:3:22: error: /demo/one/x/a: there is no parameter 'gian'; did you mean "
            "'gain'?; instantiated at whole.xml:2:3, which is instantiated at app.xml:2:3\n");
  EXPECT_TRUE(shop_.runtime.root().children().empty());
}

TEST_F(PartFilesTest, NameTheLineWithinOfWhatCannotBePrepared) {
  Write("part.xml", R"(<group_type>
  <module name="a" type="test/unready"/>
</group_type>)");
  Write("app.xml", R"(<application name="demo">
  <group name="one" type="part.xml"/>
</application>)");
  EXPECT_EQ(Errors(),
            "part.xml:2:3: error: /demo/one/a: the file is not there; instantiated at "
            "app.xml:2:3\n");
}

TEST_F(PartFilesTest, TellOfABadValueWhereItStands) {
  Write("part.xml", R"(<group_type>
  <parameter name="strength" value="1"/>
  <module name="a" type="test/source"><parameter name="gain" from="strength"/></module>
</group_type>)");
  Write("app.xml", R"(<application name="demo">
  <group name="one" type="part.xml"><parameter name="strength" value="11"/></group>
</application>)");
  EXPECT_EQ(Errors(),
            "app.xml:2:71: error: /demo/one/a/parameter/gain: 11 m is out of bounds; allowed is "
            "0 .. 10 m\n");
}

TEST_F(PartFilesTest, KnowTheirParameters) {
  Write("part.xml", R"(<group_type>
  <parameter name="strength"/>
  <parameter name="idle" value="1"/>
  <module name="a" type="test/source"><parameter name="gain" from="strenth"/></module>
</group_type>)");
  Write("app.xml", R"(<application name="demo">
  <group name="one" type="part.xml"><parameter name="stregth" value="1"/></group>
</application>)");
  const std::string errors = Errors();
  EXPECT_THAT(errors, HasSubstr("app.xml:2:54: error: /demo/one: part.xml has no parameter "
                                "'stregth'; did you mean 'strength'?\n"));
  EXPECT_THAT(errors, HasSubstr("app.xml:2:3: error: /demo/one: the parameter 'strength' of "
                                "part.xml has no value; add"));
  EXPECT_THAT(errors, HasSubstr("part.xml:4:68: error: /demo/one/a: <group_type> has no parameter "
                                "'strenth'; did you mean 'strength'?; instantiated at "
                                "app.xml:2:3\n"));
  EXPECT_THAT(errors, HasSubstr("part.xml:3:20: warning: /demo/one: nothing takes its value from "
                                "the parameter 'idle'"));
}

TEST_F(PartFilesTest, DoNotTellOfParametersThatMissingModulesMayTake) {
  Write("part.xml", R"(<group_type>
  <load plugin="missing"/>
  <parameter name="strength" value="1"/>
  <module name="a" type="missing/source"><parameter name="gain" from="strength"/></module>
</group_type>)");
  Write("app.xml", R"(<application name="demo">
  <group name="one" type="part.xml"/>
</application>)");
  const std::string errors = Errors();
  EXPECT_THAT(errors, HasSubstr("no plugin 'missing'"));
  EXPECT_THAT(errors, ::testing::Not(HasSubstr("nothing takes its value")));
}

TEST_F(PartFilesTest, SetParametersOnlyWithinThemselves) {
  ASSERT_NE(shop_.Build(R"(<application name="other"><module name="m" type="test/source"/>
    </application>)"),
            nullptr);
  Write("parts/amplifier.xml", kAmplifier);
  Write("app.xml", R"(<application name="demo">
  <module name="beside" type="test/source"/>
  <group name="left" type="parts/amplifier.xml">
    <parameter of="/other/m" name="count" value="8"/>
    <parameter of="../beside" name="count" value="8"/>
  </group>
</application>)");
  EXPECT_EQ(Errors(),
            "app.xml:4:20: error: /demo/left: /other/m is not within this group; set its "
            "parameters where it stands itself\n"
            "app.xml:5:20: error: /demo/left: /demo/beside is not within this group; set its "
            "parameters where it stands itself\n");
  EXPECT_EQ(shop_.Get<Source>("/other/m").count.Get(), 3);
}

TEST_F(PartFilesTest, HaveNoParametersThatComeFromThemselves) {
  for (const std::string from : {"from", "fron"}) {
    Write("part.xml", "<group_type>\n<parameter name=\"gain\" " + from +
                          R"(="gain" value="1"/>
<module name="m" type="test/source"><parameter name="gain" from="gain"/></module></group_type>)");
    Write("app.xml", R"(<application name="demo"><group name="g" type="part.xml"/></application>)");
    EXPECT_THAT(Errors(), HasSubstr("part.xml:2:24: error: /demo/g"));
  }
}

TEST_F(PartFilesTest, ThatContainThemselvesAreRefusedWithTheWay) {
  Write("a.xml", "<group_type>\n  <group name=\"b\" type=\"b.xml\"/>\n</group_type>");
  Write("b.xml", "<group_type>\n <group name=\"a\" type=\"./a.xml\"/>\n</group_type>");
  Write("app.xml", "<application name=\"demo\">\n<group name=\"a\" type=\"a.xml\"/></application>");
  EXPECT_EQ(Errors(),
            "b.xml:2:24: error: /demo/a/b/a: a.xml contains itself; through app.xml:2:1, "
            "a.xml:2:3 and here; instantiated at a.xml:2:3, which is instantiated at app.xml:2:1\n");
}

TEST_F(PartFilesTest, ThatAreNotThereOrAreSomethingElse) {
  Write("part.xml", "<group_type/>");
  Write("other.xml", "<world/>");
  Write("app.xml", R"(<application name="demo">
  <group name="a" type="prt.xml"/>
  <group name="b" type="other.xml"/>
  <group name="c" type="part.xml"><module name="m" type="test/sink"/></group>
  <group name="d"><parameter name="p" value="1"/></group>
  <module name="sink" type="test/filter"/>
  <connect from="a/out" to="sink/value"/>
</application>)");
  EXPECT_EQ(Errors(),
            "app.xml:2:25: error: /demo/a: prt.xml: there is no such file; did you mean "
            "'part.xml'?\n"
            "app.xml:3:25: error: /demo/b: other.xml begins with <world>, and describes no group; a "
            "file for <group type=\"…\"> begins with <group_type>\n"
            "app.xml:4:35: error: /demo/c: <module> in a group whose type is a file; write it into "
            "part.xml, or leave out type\n"
            "app.xml:5:19: error: /demo/d: a parameter of a group without a type says what it "
            "stands for; add to=\"module/parameter\", or write it into a module\n");
}

TEST_F(PartFilesTest, AreNoApplications) {
  Write("app.xml", "<group_type/>");
  EXPECT_THAT(Errors(), HasSubstr("<group_type> is not an application; an application uses it by"));
}

}  // namespace
}  // namespace runnel::testing
