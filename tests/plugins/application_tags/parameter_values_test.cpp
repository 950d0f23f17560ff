// Where the values of parameters come from, and which wins.

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/plugins/application_files/reading/test_application.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

constexpr const char* kApplication = R"(<application name="demo">
  <module name="a" type="test/source">
    <parameter name="gain" value="2" config="/a/gain" command_line="gain"/>
  </module>
</application>)";

class ParameterValues : public ::testing::Test {
 protected:
  ~ParameterValues() override { std::filesystem::remove(file_); }

  void LoadConfiguration(std::string_view text) {
    std::ofstream(file_) << text;
    Diagnostics diagnostics;
    workshop_.configuration.Load(file_, diagnostics);
    ASSERT_EQ(diagnostics.ToString(), "");
  }
  double BuiltGain() {
    EXPECT_TRUE(workshop_.Build(kApplication)) << workshop_.diagnostics.ToString();
    return workshop_.Get<Source>("/demo/a").gain.Get();
  }
  std::string Said(std::string_view text = kApplication) { return workshop_.Errors(text); }

  const std::string file_ = ::testing::TempDir() + "runnel_configuration_" +
                            ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".xml";
  Workshop workshop_;
};

TEST_F(ParameterValues, ComeFromTheAuthorIfNobodySaysOtherwise) {
  ASSERT_TRUE(workshop_.Build(R"(<application name="demo">
    <module name="a" type="test/source"/></application>)"));
  EXPECT_EQ(workshop_.Get<Source>("/demo/a").gain.Get(), 1.0);
}

TEST_F(ParameterValues, InTheFileBeatTheDefault) { EXPECT_EQ(BuiltGain(), 2.0); }

TEST_F(ParameterValues, MayStandUnderTheNameThatTheParameterHadBefore) {
  EXPECT_THAT(Said("<application name='demo'>\n<module name='a' type='test/source'>\n<parameter name='boost' "
                   "value='4'/></module></application>"),
              HasSubstr("app.xml:3:18: warning: /demo/a: 'boost' is called 'gain' now"));
  EXPECT_EQ(workshop_.Get<Source>("/demo/a").gain.Get(), 4.0);
}

TEST_F(ParameterValues, MayHaveUnitsWhereverTheyStand) {
  const auto gain_of = [&](const std::string& value) {
    return Said(
        "<application name='demo'>\n<module name='a' type='test/source'>\n"
        "<parameter name='gain' value='" +
        value + "' config='/a/gain' command_line='gain'/></module></application>");
  };
  EXPECT_EQ(gain_of("15 s"), "app.xml:3:31: error: /demo/a/parameter/gain: '15 s' is no value in m; write it in m\n");
  LoadConfiguration(R"(<configuration><section name="a"><value name="gain">15 cm</value></section></configuration>)");
  EXPECT_EQ(gain_of("2 m"), "");
  EXPECT_EQ(workshop_.Get<Source>("/demo/a").gain.Get(), 0.15);
}

TEST_F(ParameterValues, OnTheCommandLineMayHaveUnits) {
  ASSERT_TRUE(workshop_.configuration.AddArgument("gain=70mm"));
  EXPECT_EQ(BuiltGain(), 0.07);
}

TEST_F(ParameterValues, OfTheConfigurationBeatTheFile) {
  LoadConfiguration(R"(<configuration><section name="a"><value name="gain">3</value></section></configuration>)");
  EXPECT_EQ(BuiltGain(), 3.0);
}

TEST_F(ParameterValues, OnTheCommandLineBeatAllOthers) {
  LoadConfiguration(R"(<configuration><section name="a"><value name="gain">3</value></section></configuration>)");
  ASSERT_TRUE(workshop_.configuration.AddArgument("gain=4"));
  EXPECT_EQ(BuiltGain(), 4.0);
}

TEST_F(ParameterValues, KeepTheDefaultIfTheOnlySourceIsNotThere) {
  ASSERT_TRUE(workshop_.Build(R"(<application name="demo">
    <module name="a" type="test/source">
      <parameter name="gain" config="/a/gain"/>
      <parameter name="count" command_line="count"/>
    </module></application>)"))
      << workshop_.diagnostics.ToString();
  EXPECT_EQ(workshop_.Get<Source>("/demo/a").gain.Get(), 1.0);
  EXPECT_EQ(workshop_.Get<Source>("/demo/a").count.Get(), 3);
}

TEST_F(ParameterValues, OutOfBoundsAreRefusedWithTheBounds) {
  EXPECT_EQ(Said(R"(<application name="demo">
  <module name="a" type="test/source">
    <parameter name="gain" value="10.5"/>
    <parameter name="count" value="many"/>
  </module>
</application>)"),
            "app.xml:3:35: error: /demo/a/parameter/gain: 10.5 m is out of bounds; allowed is 0 .. "
            "10 m\n"
            "app.xml:4:36: error: /demo/a/parameter/count: 'many' is no whole number\n");
}

TEST_F(ParameterValues, OutOfBoundsOnTheCommandLineSayWhoseTheyAre) {
  ASSERT_TRUE(workshop_.configuration.AddArgument("gain=-1"));
  EXPECT_EQ(Said(),
            "command line: error: /demo/a/parameter/gain: -1 m is out of bounds; allowed is 0 .. "
            "10 m\n");
}

TEST_F(ParameterValues, OutOfBoundsInAConfigurationNameItsLine) {
  LoadConfiguration(
      "<configuration><section name='a'>\n <value name='gain'>20</value></section>"
      "</configuration>");
  EXPECT_EQ(Said(), file_ +
                        ":2:2: error: /demo/a/parameter/gain: 20 m is out of bounds; allowed "
                        "is 0 .. 10 m\n");
}

TEST_F(ParameterValues, AreAllCheckedEvenIfAnotherWins) {
  ASSERT_TRUE(workshop_.configuration.AddArgument("gain=4"));
  EXPECT_THAT(Said(R"(<application name="demo">
  <module name="a" type="test/source">
    <parameter name="gain" value="99" command_line="gain"/>
  </module>
</application>)"),
              HasSubstr("app.xml:3:35: error: /demo/a/parameter/gain: 99 m is out of bounds"));
}

TEST_F(ParameterValues, ForUnknownParametersNameTheNearest) {
  EXPECT_EQ(Said(R"(<application name="demo">
  <module name="a" type="test/source">
    <parameter name="gian" value="1"/>
  </module>
  <module name="b" type="test/sink">
    <parameter name="gain" value="1"/>
  </module>
</application>)"),
            "app.xml:3:22: error: /demo/a: there is no parameter 'gian'; did you mean 'gain'?\n"
            "app.xml:6:22: error: /demo/b: there is no parameter 'gain'; there is none\n");
}

TEST_F(ParameterValues, MustComeFromSomewhereAndOnce) {
  EXPECT_EQ(Said(R"(<application name="demo">
  <module name="a" type="test/source">
    <parameter name="gain"/>
    <parameter name="gain" value="1"/>
  </module>
</application>)"),
            "app.xml:3:5: error: /demo/a: <parameter> does not say where the value comes from; add "
            "value=\"…\", config=\"…\" or command_line=\"…\"\n"
            "app.xml:4:22: error: /demo/a: the parameter 'gain' is set twice; the first is in line "
            "3\n");
}

TEST_F(ParameterValues, ThatNobodyAsksForAreTypingErrors) {
  ASSERT_TRUE(workshop_.configuration.AddArgument("gian=4"));
  EXPECT_EQ(Said(), "command line: error: the application knows no 'gian'; did you mean 'gain'?\n");
  EXPECT_TRUE(workshop_.runtime.root().children().empty());
}

TEST_F(ParameterValues, ForAModuleThatIsMissingAreNotCalledUnknown) {
  ASSERT_TRUE(workshop_.configuration.AddArgument("gain=4"));
  EXPECT_EQ(Said(R"(<application name="demo">
  <module name="a" type="test/sorce">
    <parameter name="gain" command_line="gain"/>
  </module>
</application>)"),
            "app.xml:2:26: error: /demo/a: there is no module type 'test/sorce'; did you mean "
            "'test/source'?\n");
}

TEST_F(ParameterValues, MisspeltInTheConfigurationAreWarnedOf) {
  LoadConfiguration(R"(<configuration><section name="a"><value name="gian">3</value></section></configuration>)");
  EXPECT_EQ(Said(),
            "app.xml:3:46: warning: /demo/a: the configuration has no '/a/gain'; did you "
            "mean '/a/gian'?\n");
  EXPECT_EQ(workshop_.Get<Source>("/demo/a").gain.Get(), 2.0);
}

TEST_F(ParameterValues, ThatNameFilesStartWhereTheyAreWritten) {
  LoadConfiguration(R"(<configuration><value name="map">maps/a.txt</value></configuration>)");
  ASSERT_TRUE(workshop_.configuration.AddArgument("map=b.txt"));
  ASSERT_TRUE(workshop_.Build(R"(<application name="demo">
    <module name="xml" type="test/source"><parameter name="file" value="../a.txt"/></module>
    <module name="absolute" type="test/source"><parameter name="file" value="/a.txt"/></module>
    <module name="empty" type="test/source"><parameter name="file" value=""/></module>
    <module name="config" type="test/source"><parameter name="file" config="map"/></module>
    <module name="line" type="test/source"><parameter name="file" command_line="map"/></module>
    <module name="text" type="test/source"><parameter name="text" value="a.txt"/></module>
    </application>)"))
      << workshop_.diagnostics.ToString();
  const auto file = [&](const char* path) { return workshop_.Get<Source>(path).file.Get().text; };
  EXPECT_EQ(file("/demo/xml"), "/a.txt");
  EXPECT_EQ(file("/demo/absolute"), "/a.txt");
  EXPECT_EQ(file("/demo/empty"), "");
  EXPECT_EQ(file("/demo/config"), ::testing::TempDir() + "maps/a.txt");
  EXPECT_EQ(file("/demo/line"), "b.txt") << "where the program was started";
  EXPECT_EQ(workshop_.Get<Source>("/demo/text").text.Get(), "a.txt");
}

TEST_F(ParameterValues, WithAUnitWhereNoneIsWantedAreToldToLeaveItOut) {
  EXPECT_EQ(Said(R"(<application name="demo">
  <module name="a" type="test/source">
    <parameter name="gain" value="4m"/>
    <parameter name="count" value="4m"/>
  </module>
  <module name="b" type="test/source">
    <parameter name="gain" value="4,5"/>
    <parameter name="count" value="4,5"/>
  </module>
</application>)"),
            "app.xml:4:36: error: /demo/a/parameter/count: '4m' has a unit where none is wanted; "
            "write the number only\n"
            "app.xml:7:35: error: /demo/b/parameter/gain: '4,5' is no number with a unit; write it "
            "in m\n"
            "app.xml:8:36: error: /demo/b/parameter/count: '4,5' is no whole number\n");
}

}  // namespace
}  // namespace runnel::testing
