#include "plugins/parameters/configuration.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace runnel {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class ConfigurationFile : public ::testing::Test {
 protected:
  ~ConfigurationFile() override { std::filesystem::remove(file_); }

  // What loading the text says; the file's name is left out.
  std::string Load(std::string_view text) {
    std::ofstream(file_) << text;
    Diagnostics diagnostics;
    configuration_.Load(file_, diagnostics);
    std::string said;
    for (const Error& warning : diagnostics.warnings()) {
      said += "warning " + std::to_string(warning.position.line) + ": " + warning.message + "\n";
    }
    for (const Error& error : diagnostics.errors()) {
      EXPECT_EQ(error.position.file, file_);
      said += std::to_string(error.position.line) + ":" + std::to_string(error.position.column) + ": " + error.message +
              "; " + error.hint + "\n";
    }
    return said;
  }

  const std::string file_ = ::testing::TempDir() + "runnel_configuration_file_" +
                            ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".xml";
  Configuration configuration_;
};

TEST_F(ConfigurationFile, NamesValuesByTheirSections) {
  ASSERT_EQ(Load(R"(<configuration>
  <section name="safety">
    <value name="stop_distance"> 0.25 </value>
    <section name="front"><value name="width">1 &lt; 2</value></section>
  </section>
  <value name="speed"/>
</configuration>)"),
            "");
  const auto* const stop_distance = configuration_.FindEntry("/safety/stop_distance");
  ASSERT_NE(stop_distance, nullptr);
  EXPECT_EQ(stop_distance->text, "0.25");
  EXPECT_EQ(stop_distance->position, (SourcePosition{file_, 3, 5}));
  EXPECT_EQ(configuration_.FindEntry("/safety/front/width")->text, "1 < 2");
  EXPECT_EQ(configuration_.FindEntry("speed")->text, "") << "the first '/' may be left out";
  EXPECT_EQ(configuration_.FindEntry("/safety/back"), nullptr);
  EXPECT_THAT(configuration_.EntryPaths(), ElementsAre("/safety/front/width", "/safety/stop_distance", "/speed"));
}

TEST_F(ConfigurationFile, TellsAllThatIsWrongAndAddsNothing) {
  EXPECT_EQ(Load(R"(<configuration version="2">
  <section>
    <value name="a/b">1</value>
  </section>
  <vlaue name="x">1</vlaue>
  <value name="y">1<z/></value>
  <value name="y">2</value>
  <value nam="q">2</value>
  text
</configuration>)"),
            "1:16: <configuration> knows no 'version'; leave it out\n"
            "5:3: no <vlaue> may stand in <configuration>; did you mean 'value'?\n"
            "9:3: no text may stand in <configuration>; leave out 'text'\n"
            "2:3: <section> has no 'name'; add name=\"…\"\n"
            "3:18: the name 'a/b' contains a '/'; a <section> stands for each name "
            "before the last\n"
            "6:20: no <z> may stand in <value>; a value is a text\n"
            "7:3: there are two values called '/y'; the first is in line 6\n"
            "8:10: <value> knows no 'nam'; did you mean 'name'?\n"
            "8:3: <value> has no 'name'; add name=\"…\"\n");
  EXPECT_THAT(configuration_.EntryPaths(), IsEmpty());
}

TEST_F(ConfigurationFile, MayBeOneOfFinroc) {
  ASSERT_EQ(Load(R"(<?xml version="1.0" encoding="UTF-8"?>
<root>
  <value name="noiselevel">15 cm</value>
  <node name="some structural element">
    <value name="destructive_collision_speed">0.1</value>
    <node name="inner"><value name="x">2</value></node>
  </node>
</root>)"),
            "");
  EXPECT_EQ(configuration_.FindEntry("/noiselevel")->text, "15 cm");
  EXPECT_EQ(configuration_.FindEntry("/some structural element/destructive_collision_speed")->text, "0.1");
  EXPECT_EQ(configuration_.FindEntry("/some structural element/inner/x")->text, "2");
  // As FINROC itself saves one.
  ASSERT_EQ(Load("<node><value name='noiselevel'>20 cm</value></node>"), "");
  EXPECT_EQ(configuration_.FindEntry("/noiselevel")->text, "20 cm");
}

TEST_F(ConfigurationFile, OfFinrocIsTakenAsFarAsItIsUnderstood) {
  EXPECT_EQ(Load("<root>\n<value name='a'><x/></value>\n<section name='b'/>\n"
                 "<value name='c'>1</value></root>"),
            "warning 3: no <section> may stand in <root>\n"
            "warning 2: no <x> may stand in <value>\n");
  EXPECT_EQ(configuration_.FindEntry("c")->text, "1");
}

TEST_F(ConfigurationFile, MustBeOne) {
  EXPECT_EQ(Load("<application name='x'/>"),
            "1:1: <application> is not a configuration; a configuration file begins with "
            "<configuration>, or, if it is one of FINROC, with <root>\n");
  Diagnostics diagnostics;
  configuration_.Load("/no/such/file.xml", diagnostics);
  ASSERT_EQ(diagnostics.errors().size(), 1u);
  EXPECT_EQ(diagnostics.errors()[0].position.file, "/no/such/file.xml");
}

TEST_F(ConfigurationFile, GivesWayToALaterOne) {
  ASSERT_EQ(Load("<configuration><value name='a'>1</value><value name='b'>1</value>"
                 "</configuration>"),
            "");
  ASSERT_EQ(Load("<configuration><value name='a'>2</value></configuration>"), "");
  EXPECT_EQ(configuration_.FindEntry("a")->text, "2");
  EXPECT_EQ(configuration_.FindEntry("b")->text, "1");
}

TEST(Arguments, AreNamesAndValues) {
  Configuration configuration;
  ASSERT_TRUE(configuration.AddArgument("goal_x=4"));
  ASSERT_TRUE(configuration.AddArgument("text=a=b"));
  ASSERT_TRUE(configuration.AddArgument("empty="));
  EXPECT_EQ(configuration.FindArgument("goal_x")->text, "4");
  EXPECT_EQ(configuration.FindArgument("goal_x")->position.file, "command line");
  EXPECT_EQ(configuration.FindArgument("text")->text, "a=b");
  EXPECT_EQ(configuration.FindArgument("empty")->text, "");
  EXPECT_EQ(configuration.FindArgument("goal_y"), nullptr);
}

TEST(Arguments, ThatSetNothingOrTwiceAreRefused) {
  Configuration configuration;
  EXPECT_EQ(configuration.AddArgument("goal_x").error().ToString(),
            "command line: 'goal_x' sets nothing; write name=value");
  EXPECT_FALSE(configuration.AddArgument("=4"));
  ASSERT_TRUE(configuration.AddArgument("goal_x=4"));
  EXPECT_EQ(configuration.AddArgument("goal_x=5").error().message, "'goal_x' is given twice");
  EXPECT_EQ(configuration.FindArgument("goal_x")->text, "4");
}

TEST(Arguments, ThatNobodyAskedForAreKnown) {
  Configuration configuration;
  ASSERT_TRUE(configuration.AddArgument("goal_y=4"));
  ASSERT_TRUE(configuration.AddArgument("goal_x=4"));
  EXPECT_THAT(configuration.UnusedArguments(), ElementsAre("goal_x", "goal_y"));
  (void)configuration.FindArgument("goal_x");
  EXPECT_THAT(configuration.UnusedArguments(), ElementsAre("goal_y"));
}

}  // namespace
}  // namespace runnel
