// <load>: plugins, and the words that they bring.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/plugins/application_files/reading/test_application.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

struct Loading : ::testing::Test, Workshop {
  Loading() { plugins.AddSearchFolder(TEST_PLUGIN_FOLDER); }
};

TEST_F(Loading, BringsModuleTypesTagsAndAttributesWhereverItStands) {
  ASSERT_TRUE(Build(R"(<application name="demo" height="3">
    <tower/>
    <module name="a" type="good/brought"/>
    <load plugin="good_plugin"/>
    <load plugin="good_plugin"/>
  </application>)"))
      << diagnostics.ToString();
  EXPECT_TRUE(runtime.root().Find("/demo/tower"));
  EXPECT_TRUE(runtime.root().Find("/demo/a"));
  EXPECT_TRUE(runtime.root().Find("/demo/height_3"));
  EXPECT_EQ(tags.FindTag("tower")->plugin, "good_plugin");
}

TEST_F(Loading, FindsFilesFromTheFolderOfTheApplication) {
  const auto document = XmlDocument::Parse(
      R"(<application name="demo"><load plugin="./good_plugin.so"/><tower/></application>)", "app.xml");
  const BuildOutcome outcome =
      BuildApplication(*document, TEST_PLUGIN_FOLDER, {runtime, plugins, tags, configuration}, BuildMode::kRun);
  EXPECT_TRUE(outcome.application) << outcome.diagnostics.ToString();
}

TEST_F(Loading, FindsFilesFromWhereTheProgramRunsIfTheApplicationHasNoFolder) {
  const auto document = XmlDocument::Parse(
      R"(<application name="demo"><load plugin="./good_plugin.so"/><tower/></application>)", "app.xml");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(TEST_PLUGIN_FOLDER);
  const BuildOutcome outcome =
      BuildApplication(*document, "", {runtime, plugins, tags, configuration}, BuildMode::kRun);
  std::filesystem::current_path(before);
  EXPECT_TRUE(outcome.application) << outcome.diagnostics.ToString();
}

TEST_F(Loading, IsTheCureForAModuleTypeOfAPluginThatIsThere) {
  EXPECT_EQ(Errors(R"(<application name="demo">
  <module name="a" type="good_plugin/brought"/>
</application>)"),
            "app.xml:2:26: error: /demo/a: there is no module type 'good_plugin/brought'; add "
            "<load plugin=\"good_plugin\"/>\n");
}

TEST_F(Loading, ThatFailsIsTheOnlyMistakeOfWhatThePluginBrings) {
  const std::string rest = "<module name=\"a\" type=\"good/brought\"/><tower/></application>";
  for (const char* load : {"<load plugin=\"\"/>", "<load/>", "<laod plugin=\"good_plugin\"/>",
                           "<group name=\"g\"><load plugin=\"good_plugin\"/></group>"}) {
    Workshop workshop;
    workshop.Build("<application name=\"demo\">" + std::string(load) + rest);
    EXPECT_EQ(workshop.diagnostics.errors().size(), 1u) << load << ":\n" << workshop.diagnostics.ToString();
  }
}

TEST_F(Loading, BringsTheTypesOfPortsBeforeAnyModuleIsMade) {
  EXPECT_EQ(Errors(R"(<application name="demo">
  <load plugin="good_plugin"/>
  <group name="inner">
    <port name="in" direction="input" type="test/brought_value"/>
  </group>
</application>)"),
            "");
}

TEST_F(Loading, IsAskedForWhereATypeIsUnknown) {
  EXPECT_EQ(Errors(R"(<application name="demo">
  <group name="inner">
    <port name="in" direction="input" type="uint16"/>
    <port name="out" direction="input" type="somewhere/other_value"/>
  </group>
</application>)"),
            "app.xml:4:46: error: /demo/inner/out: there is no type 'somewhere/other_value'; types "
            "come with the plugins whose modules have ports of them; is a <load> missing?\n");
}

TEST_F(Loading, NamesTheNearestPlugin) {
  EXPECT_THAT(Errors(R"(<application name="demo">
  <load plugin="god_plugin"/>
</application>)"),
              ::testing::AllOf(HasSubstr("app.xml:2:17: error: /demo: no plugin 'god_plugin' in "),
                               HasSubstr("; did you mean 'good_plugin'?; ")));
}

TEST_F(Loading, LeavesNothingOfARefusedPlugin) {
  EXPECT_THAT(Errors(R"(<application name="demo">
  <load plugin="refused_plugin"/>
</application>)"),
              HasSubstr("its registration failed: no licence"));
  EXPECT_EQ(tags.FindTag("ruin"), nullptr);
  EXPECT_EQ(Errors(R"(<application name="demo">
  <ruin/>
</application>)"),
            "app.xml:2:3: error: /demo: no <ruin> may stand in <application>; there is 'clock', "
            "'connect', 'driving', 'group', 'latency', 'load', 'log', 'module', 'on_fault', 'on_pause', 'on_stale', "
            "'on_stuck' and 4 more\n");
}

TEST_F(Loading, KeepsThePluginAfterAFailedBuild) {
  Build(R"(<application name="demo"><load plugin="good_plugin"/><wall/></application>)");
  EXPECT_FALSE(diagnostics.ok());
  EXPECT_TRUE(Build(R"(<application name="demo"><load plugin="good_plugin"/><tower/>
    </application>)"));
}

}  // namespace
}  // namespace runnel::testing
