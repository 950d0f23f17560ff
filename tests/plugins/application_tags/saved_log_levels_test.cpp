// What is logged from which level on, changed while the application is there, in files that are saved.

#include <gmock/gmock.h>

#include "core/log/log_level.h"
#include "core/module/group.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

class SavedLogLevels : public ::testing::Test {
 protected:
  void Load(const std::string& text) {
    WriteAll(folder_ / "app.xml", text);
    application_ = shop_.Load(folder_ / "app.xml");
    ASSERT_NE(application_, nullptr);
  }
  void Set(const std::string& path, LogLevel level) { SetLogLevel(shop_.runtime, path, level); }
  void Reset(const std::string& path) { EXPECT_TRUE(ResetLogLevel(shop_.runtime, path)); }
  std::string Text() { return shop_.Text(*application_, folder_.path()); }
  // What another application has that is loaded from the text.
  LogLevels LevelsOf(const std::string& text) {
    SavingWorkshop other;
    WriteAll(folder_ / "again.xml", text);
    EXPECT_NE(other.Load(folder_ / "again.xml"), nullptr);
    return ReadLogLevels(other.runtime);
  }

  TestFolder folder_;
  SavingWorkshop shop_;
  FrameworkElement* application_ = nullptr;
};

const char* const kText = R"(<application name="demo">
  <!-- quiet -->
  <log  level='error'/>  <!-- but for -->
  <module name="a" type="test/source"/>
  <group name="g">
    <log of="b" level="debug"/>  <log level="info"/>
    <log of="b" level="off"/>
    <module name="b" type="test/source"/>
  </group>
</application>
)";

std::string With(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) ADD_FAILURE() << from;
  return text.replace(at, from.size(), to);
}

TEST_F(SavedLogLevels, WhatIsTheSameIsNotTouched) {
  Load(kText);
  EXPECT_EQ(Text(), kText);
}

TEST_F(SavedLogLevels, AreRewrittenInPlace) {
  Load(kText);
  Set("/demo", LogLevel::kWarning);
  Set("/demo/g/b", LogLevel::kInfo);
  const std::string text = With(With(kText, "level='error'", "level='warning'"), "\"off\"", "\"info\"");
  EXPECT_EQ(Text(), text) << "of two for one the last, which counts";
  EXPECT_EQ(LevelsOf(text), ReadLogLevels(shop_.runtime));
}

TEST_F(SavedLogLevels, AreCutOut) {
  Load(kText);
  Reset("/demo");
  Reset("/demo/g/b");
  const std::string text = Text();
  EXPECT_THAT(text, HasSubstr("<!-- quiet -->"));
  EXPECT_THAT(text, HasSubstr("<!-- but for -->"));
  EXPECT_THAT(text, HasSubstr("<log level=\"info\"/>"));
  EXPECT_EQ(LevelsOf(text), (LogLevels{{"/demo/g", LogLevel::kInfo}}));
}

TEST_F(SavedLogLevels, AreAddedWhereTheyBelong) {
  Load(kText);
  Set("/demo/a", LogLevel::kDebug);
  Set("/demo/g/b/output", LogLevel::kDebug);
  const std::string text = Text();
  EXPECT_EQ(text, With(With(kText, "  </group>\n", "    <log level=\"debug\" of=\"b/output\"/>\n  </group>\n"),
                       "</application>", "  <log level=\"debug\" of=\"a\"/>\n</application>"));
  EXPECT_EQ(LevelsOf(text), ReadLogLevels(shop_.runtime));
}

TEST_F(SavedLogLevels, OfEverythingAreThoseOfTheApplication) {
  Load(R"(<application name="demo">
</application>
)");
  Set("", LogLevel::kDebug);
  const std::string text = Text();
  EXPECT_EQ(LevelsOf(text), (LogLevels{{"/demo", LogLevel::kDebug}}));
  Set("/demo", LogLevel::kError);
  EXPECT_EQ(LevelsOf(Text()), (LogLevels{{"/demo", LogLevel::kError}}));
  Set("/demo/gone", LogLevel::kError);
  EXPECT_EQ(LevelsOf(Text()), (LogLevels{{"/demo", LogLevel::kError}})) << "what is not there has none";
}

TEST_F(SavedLogLevels, AreWrittenIntoNewFiles) {
  Load(kText);
  auto& runtime = shop_.runtime;
  auto& made = runtime.Create<Group>(runtime.root(), "made");
  (void)shop_.plugins.modules().Create("test/source", made, "a").value();
  ASSERT_TRUE(runtime.MakeReady(made));
  Set("/made", LogLevel::kWarning);
  Set("/made/a", LogLevel::kDebug);
  EXPECT_EQ(shop_.Text(made, folder_.path()), R"(<application name="made">
  <module name="a" type="test/source"/>

  <log level="warning"/>
  <log level="debug" of="a"/>
</application>
)");
}

TEST_F(SavedLogLevels, OfOneUseOfAPartAreWrittenBesideIt) {
  WriteAll(folder_ / "part.xml", R"(<group_type>
  <log level="error" of="m"/>
  <module name="m" type="test/source"/>
  <group name="deep"> <module name="m" type="test/source"/> </group>
</group_type>
)");
  const std::string text = R"(<application name="demo">
  <group name="outer">
    <group name="left" type="part.xml"/>
    <group name="right" type="part.xml"/>
  </group>
</application>
)";
  Load(text);
  EXPECT_EQ(Text(), text);
  Set("/demo/outer/left/m", LogLevel::kDebug);
  Set("/demo/outer/right", LogLevel::kOff);
  Set("/demo/outer/right/deep/m", LogLevel::kInfo);
  const std::string saved = Text();
  EXPECT_EQ(saved, With(text, "  </group>\n</app", R"(    <log level="debug" of="left/m"/>
    <log level="off" of="right"/>
    <log level="info" of="right/deep/m"/>
  </group>
</app)"));
  EXPECT_EQ(LevelsOf(saved), ReadLogLevels(shop_.runtime));
  Reset("/demo/outer/left/m");
  EXPECT_THAT(Text(), HasSubstr("says what is in all groups of its type"));
}

}  // namespace
}  // namespace runnel::testing
