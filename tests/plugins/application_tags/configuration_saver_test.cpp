// Values that go back into the configuration, sections for whole groups, and parameters of groups in files.

#include "plugins/parameters/configuration_saver.h"

#include <gmock/gmock.h>

#include "core/module/group_parameter.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/structure/structure_editor.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

const char* const kCar = R"(<application name="demo">
  <group name="left" config="/car/left">
    <module name="motor" type="test/source"/>
    <module name="lamp" type="test/source" config="lights"/>
  </group>
  <module name="engine" type="test/source">
    <parameter name="gain" value="2" config="/engine/power" command_line="power"/>
  </module>
</application>
)";
const char* const kConfiguration = R"(<configuration>
  <!-- of the car -->
  <section name="car">
    <section name="left">
      <section name="motor"> <value name="gain">3</value> <!-- tried out --> </section>
      <section name="lights"><value name="count">5</value></section>
    </section>
  </section>
</configuration>
)";

class ConfigurationSaver : public ::testing::Test {
 protected:
  FrameworkElement& Load(const std::string& application, const std::string& configuration) {
    WriteAll(file, application);
    if (!configuration.empty()) {
      WriteAll(entries, configuration);
      Diagnostics diagnostics;
      shop.configuration.Load(entries, diagnostics);
      EXPECT_TRUE(diagnostics.ok()) << diagnostics.ToString();
    }
    FrameworkElement* const loaded = shop.Load(file);
    if (loaded == nullptr) throw std::runtime_error("the application does not load");
    return *loaded;
  }
  void Set(const std::string& path, const std::string& value) {
    StructureEditor editor(shop.runtime, shop.plugins.modules(), nullptr);
    const auto outcome = editor.Apply({SetParameter{path, value}});
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }
  void Rename(const std::string& path, const std::string& name) {
    StructureEditor editor(shop.runtime, shop.plugins.modules(), nullptr);
    const auto outcome = editor.Apply({RenameElement{path, name}});
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }
  // By both files, as they are now.
  double GainAfterRestart(const std::string& path) {
    SavingWorkshop again;
    Diagnostics read;
    again.configuration.Load(entries, read);
    if (again.Load(file) == nullptr) throw std::runtime_error("the file does not load again");
    return again.Get<Source>(path).gain.Get();
  }
  static Result<std::string> Save(FrameworkElement& application, const std::filesystem::path& to = {}) {
    return SaveConfiguration(application, to);
  }
  double Gain(const std::string& path) { return shop.Get<Source>(path).gain.Get(); }

  const TestFolder folder;
  const std::filesystem::path file = folder / "app.xml";
  const std::filesystem::path entries = folder / "car.xml";
  SavingWorkshop shop;
};

TEST_F(ConfigurationSaver, SectionsAreForAllWithin) {
  Load(kCar, kConfiguration);
  EXPECT_EQ(Gain("/demo/left/motor"), 3);
  EXPECT_EQ(shop.Get<Source>("/demo/left/lamp").count.Get(), 5);
  EXPECT_EQ(Gain("/demo/engine"), 2);
}

TEST_F(ConfigurationSaver, EntriesMayHaveTheNameThatAParameterHadBefore) {
  Load(kCar, R"(<configuration><section name="car"><section name="left"><section name="motor">
    <value name="boost">7</value></section></section></section></configuration>)");
  EXPECT_EQ(Gain("/demo/left/motor"), 7);
}

TEST_F(ConfigurationSaver, BoundsHoldForEntriesOfSections) {
  WriteAll(entries,
           R"(<configuration><section name="car"><section name="left"><section name="motor">
    <value name="gain">30</value></section></section></section></configuration>)");
  Diagnostics diagnostics;
  shop.configuration.Load(entries, diagnostics);
  EXPECT_THAT(shop.Errors(kCar), HasSubstr("car.xml:2:"));
  EXPECT_THAT(shop.diagnostics.ToString(), HasSubstr("30 m is out of bounds"));
}

TEST_F(ConfigurationSaver, WritesBackWhatHasChangedAndNothingElse) {
  FrameworkElement& application = Load(kCar, kConfiguration);
  EXPECT_EQ(Save(application).value(), "no value has changed");
  EXPECT_EQ(ReadAll(entries), kConfiguration);
  Set("/demo/left/motor/gain", "4");
  Set("/demo/engine/gain", "5");
  EXPECT_EQ(Save(application).value(), "saved 2 values to " + entries.string());
  EXPECT_EQ(ReadAll(entries), R"(<configuration>
  <!-- of the car -->
  <section name="car">
    <section name="left">
      <section name="motor"> <value name="gain">4</value> <!-- tried out --> </section>
      <section name="lights"><value name="count">5</value></section>
    </section>
  </section>
  <section name="engine">
    <value name="power">5</value>
  </section>
</configuration>
)");
  EXPECT_EQ(Save(application).value(), "no value has changed");
  ASSERT_TRUE(SaveApplication(application.runtime(), application, shop.tools()));
  EXPECT_EQ(ReadAll(file), kCar) << "the values are the configuration's";
}

TEST_F(ConfigurationSaver, WritesAFileOfItsOwn) {
  FrameworkElement& application = Load(kCar, "");
  EXPECT_THAT(Save(application).error().message, HasSubstr("without a configuration file"));
  Set("/demo/left/motor/gain", "4");
  ASSERT_TRUE(Save(application, entries));
  EXPECT_THAT(ReadAll(entries), HasSubstr("<section name=\"motor\">\n        <value name=\"gain\">4</value>"));
  SavingWorkshop again;
  Diagnostics diagnostics;
  again.configuration.Load(entries, diagnostics);
  ASSERT_TRUE(again.Load(file));
  EXPECT_EQ(again.Get<Source>("/demo/left/motor").gain.Get(), 4);
}

TEST_F(ConfigurationSaver, LeavesAFileThatSomebodyHasChanged) {
  FrameworkElement& application = Load(kCar, kConfiguration);
  Set("/demo/left/motor/gain", "4");
  WriteAll(entries, "<configuration/>");
  EXPECT_THAT(Save(application).error().message, HasSubstr("has been changed"));
  EXPECT_EQ(ReadAll(entries), "<configuration/>");
}

TEST_F(ConfigurationSaver, AnotherNameIsNoOtherValue) {
  FrameworkElement& application = Load(kCar, kConfiguration);
  Rename("/demo/left/motor", "drive");
  Rename("/demo/engine", "motor");
  EXPECT_EQ(Save(application).value(), "no value has changed");
  Set("/demo/left/drive/gain", "4");
  EXPECT_EQ(Save(application).value(), "saved 1 value to " + entries.string());
  EXPECT_THAT(ReadAll(entries),
              HasSubstr("<section name=\"motor\"> <value name=\"gain\">4</value> <!-- tried out -->"));
  EXPECT_EQ(GainAfterRestart("/demo/left/motor"), 4) << "the file still has the old name";
  ASSERT_TRUE(SaveApplication(application.runtime(), application, shop.tools()));
  EXPECT_EQ(GainAfterRestart("/demo/left/drive"), 4);
  EXPECT_EQ(GainAfterRestart("/demo/motor"), 2);
  const std::string saved = ReadAll(file);
  EXPECT_THAT(saved, HasSubstr(R"(<parameter name="gain" config="/car/left/motor/gain"/>)"));
  ASSERT_TRUE(SaveApplication(application.runtime(), application, shop.tools()));
  EXPECT_EQ(ReadAll(file), saved);
}

TEST_F(ConfigurationSaver, WhatHasNoEntryYetHasItUnderTheNameOfNow) {
  FrameworkElement& application = Load(kCar, kConfiguration);
  Rename("/demo/left/lamp", "light");
  Rename("/demo/left", "right");
  ASSERT_TRUE(SaveApplication(application.runtime(), application, shop.tools()));
  EXPECT_THAT(ReadAll(file), ::testing::Not(HasSubstr("<parameter name=\"gain\" config=\"/car")));
  Set("/demo/right/light/gain", "6");
  ASSERT_TRUE(Save(application));
  EXPECT_EQ(GainAfterRestart("/demo/right/light"), 6);
  Rename("/demo/right/motor", "drive");
  Set("/demo/right/drive/count", "9");
  ASSERT_TRUE(Save(application));
  ASSERT_TRUE(SaveApplication(application.runtime(), application, shop.tools()));
  EXPECT_EQ(GainAfterRestart("/demo/right/drive"), 3);
  EXPECT_THAT(ReadAll(entries), HasSubstr("<section name=\"drive\">"));
}

TEST_F(ConfigurationSaver, TheCommandLineIsNoBusinessOfIt) {
  ASSERT_TRUE(shop.configuration.AddArgument("power=6"));
  FrameworkElement& application = Load(kCar, kConfiguration);
  EXPECT_EQ(Gain("/demo/engine"), 6);
  EXPECT_EQ(Save(application).value(), "no value has changed");
}

TEST_F(ConfigurationSaver, GroupParametersAreSavedWithTheFile) {
  const std::string text = R"(<application name="demo">
  <group name="both">
    <parameter name="power" to="a/gain b/gain" value="2"/>
    <module name="a" type="test/source"/>
    <module name="b" type="test/source"/>
    <connect from="a/value" to="b/gain"/>
  </group>
</application>
)";
  FrameworkElement& application = Load(text, "");
  EXPECT_EQ(Gain("/demo/both/a"), 2);
  EXPECT_EQ(Gain("/demo/both/b"), 2);
  EXPECT_EQ(shop.Text(application, folder.path()), text);
  Set("/demo/both/power", "3");
  EXPECT_EQ(Gain("/demo/both/b"), 3);
  EXPECT_THAT(shop.Text(application, folder.path()), HasSubstr(R"(to="a/gain b/gain" value="3"/>)"));
  StructureEditor editor(shop.runtime, shop.plugins.modules(), nullptr);
  ASSERT_TRUE(editor.Apply({DeleteElement{"/demo/both/power"}, CreateParameter{"/demo/both/number", {"a/count"}},
                            ConnectPorts{"/demo/both/b/value", "/demo/both/a/gain"}}));
  const std::string saved = shop.Text(application, folder.path());
  EXPECT_THAT(saved, ::testing::Not(HasSubstr("power")));
  EXPECT_THAT(saved, HasSubstr(R"(<parameter name="number" to="a/count"/>)"));
  EXPECT_THAT(saved, HasSubstr(R"(<connect from="a/value" to="b/gain"/>)"));
  EXPECT_THAT(saved, HasSubstr(R"(<connect from="b/value" to="a/gain"/>)"));
}

TEST_F(ConfigurationSaver, GroupsOfAFileHaveItsParameters) {
  WriteAll(folder / "inner.xml", R"(<group_type>
    <parameter name="power" value="1"/>
    <module name="motor" type="test/source"><parameter name="gain" from="power"/></module>
  </group_type>)");
  WriteAll(folder / "outer.xml", R"(<group_type>
    <parameter name="size"/>
    <group name="inner" type="inner.xml"><parameter name="power" from="size"/></group>
    <module name="own" type="test/source"><parameter name="gain" from="size"/></module>
  </group_type>)");
  FrameworkElement& application = Load(R"(<application name="demo">
  <group name="left" type="outer.xml"><parameter name="size" value="2"/></group>
</application>
)",
                                       "");
  EXPECT_EQ(shop.Get<GroupParameter>("/demo/left/size").ToText(), "2");
  EXPECT_EQ(shop.Get<GroupParameter>("/demo/left/size").info().unit, "m");
  Set("/demo/left/size", "30 cm");
  EXPECT_EQ(Gain("/demo/left/inner/motor"), 0.3);
  EXPECT_EQ(Gain("/demo/left/own"), 0.3);
  Set("/demo/left/inner/power", "4");
  EXPECT_EQ(Gain("/demo/left/inner/motor"), 4);
  EXPECT_EQ(Gain("/demo/left/own"), 0.3);
  ASSERT_TRUE(SaveApplication(application.runtime(), application, shop.tools()));
  SavingWorkshop again;
  ASSERT_TRUE(again.Load(file));
  EXPECT_EQ(again.Get<Source>("/demo/left/inner/motor").gain.Get(), 4);
  EXPECT_EQ(again.Get<Source>("/demo/left/own").gain.Get(), 0.3);
}

}  // namespace
}  // namespace runnel::testing
