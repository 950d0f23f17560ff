// Files of applications in which something has another name now, and what they were before.

#include <filesystem>

#include <gmock/gmock.h>

#include "plugins/structure/renamed_text.h"
#include "plugins/structure/structure_editor.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

const char* const kNamedFile = R"(<?xml version="1.0"?>
<!-- of the whole -->
<application   name='demo' >

  <thread name="slow" period="0.05 s"/>
  <thread name="fast" period="10ms"/>   <!-- of the thread -->

  <module name="source" type="test/source" thread="slow">
    <!-- of the gain -->
    <parameter name='gain'   value='2.50'/>
    <parameter name="count" value="4" command_line="count"/>
  </module>
  <group name="inner">
      <port name="in" direction="input"/>
      <module name="filter" type="test/filter"/><!-- of the filter -->
      <module name="sink" type="test/sink"/>
      <connect from="in" to="filter/value  sink/second"/>
      <connect from="filter/value" to="sink/value" queue="3" on_full="refuse"/>
  </group>

  <connect from="source/value" to="inner/in"/>
  <on_fault of="inner/filter" action="stop_application"/>
</application>
<!-- the end -->
)";

class RenamedFile : public ::testing::Test {
 protected:
  FrameworkElement& Load(const std::string& text = kNamedFile) {
    WriteAll(file_, text);
    application_ = shop_.Load(file_);
    return *application_;
  }
  std::string Text() { return shop_.Text(*application_, folder_.path()); }
  // What the file is after `from` has become `to`.
  static std::string With(const std::string& from, const std::string& to,
                          std::string text = kNamedFile) {
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
  }
  template <typename T>
  T& Get(const std::string& path) {
    return shop_.Get<T>(path);
  }
  FrameworkElement& Create(const std::string& type, const std::string& parent,
                           const std::string& name) {
    return *shop_.plugins.modules().Create(type, Get<FrameworkElement>(parent), name).value();
  }
  void Delete(const std::string& path) {
    const auto deleted = shop_.runtime.Delete(Get<FrameworkElement>(path));
    ASSERT_TRUE(deleted) << deleted.error().ToString();
  }

  TestFolder folder_;
  std::filesystem::path file_ = folder_ / "app.xml";
  SavingWorkshop shop_;
  FrameworkElement* application_ = nullptr;
};

TEST_F(RenamedFile, KeepsWhatItsOwnFileWas) {
  Load();
  std::filesystem::permissions(file_, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  ASSERT_TRUE(Get<Source>("/demo/source").gain.Set(3.5));
  ASSERT_TRUE(SaveApplication(*application_, shop_.tools(), file_)) << "its own, however it is named";
  const std::filesystem::path backup = file_.string() + "~";
  EXPECT_EQ(ReadAll(backup), kNamedFile);
  EXPECT_EQ(std::filesystem::status(backup).permissions(), std::filesystem::status(file_).permissions());
  ASSERT_TRUE(SaveApplication(*application_, shop_.tools()));
  EXPECT_EQ(ReadAll(backup), kNamedFile) << "nothing was to be written";
}

TEST_F(RenamedFile, WithoutABackupNothingIsReplaced) {
  Load();
  std::filesystem::create_directories(folder_ / "app.xml~" / "full");
  ASSERT_TRUE(Get<Source>("/demo/source").gain.Set(3.5));
  const auto saved = SaveApplication(*application_, shop_.tools());
  ASSERT_FALSE(saved);
  EXPECT_THAT(saved.error().message, HasSubstr("cannot be kept as app.xml~"));
  EXPECT_EQ(ReadAll(file_), kNamedFile);
}

TEST_F(RenamedFile, WhatIsRenamedIsRenamedInPlaceWithAllThatNamesIt) {
  Load();
  StructureEditor editor(shop_.runtime, shop_.plugins.modules(), nullptr);
  const auto rename = [&](const std::string& path, const std::string& name) {
    const auto done = editor.Apply({RenameElement{path, name}});
    ASSERT_TRUE(done) << done.diagnostics.ToString();
  };
  rename("/demo/inner/filter", "low_pass");
  rename("/demo/inner", "core");
  rename("/demo/source", "origin");
  std::string wanted = With("name=\"source\"", "name=\"origin\"");
  wanted = With("group name=\"inner\"", "group name=\"core\"", wanted);
  wanted = With("name=\"filter\"", "name=\"low_pass\"", wanted);
  wanted = With("to=\"filter/value ", "to=\"low_pass/value ", wanted);
  wanted = With("from=\"filter/value\"", "from=\"low_pass/value\"", wanted);
  wanted = With("from=\"source/value\" to=\"inner/in\"", "from=\"origin/value\" to=\"core/in\"", wanted);
  wanted = With("of=\"inner/filter\"", "of=\"core/low_pass\"", wanted);
  EXPECT_EQ(Text(), wanted);
  ASSERT_TRUE(SaveApplication(*application_, shop_.tools()));
  EXPECT_EQ(ReadAll(file_), wanted);
  rename("/demo/origin", "source");
  EXPECT_EQ(Text(), With("from=\"origin/", "from=\"source/", With("name=\"origin\"", "name=\"source\"", wanted)));
}

TEST_F(RenamedFile, RulesThatNameWhatIsRenamedAreTold) {
  Load();
  const std::lock_guard lock(shop_.runtime.structure_mutex());
  const auto rules = RulesThatName(Get<FrameworkElement>("/demo/inner"), kNamedFile, "app.xml", PathAttributesIn(shop_.tags));
  ASSERT_EQ(rules.size(), 1U);
  EXPECT_THAT(rules[0].message, HasSubstr("<on_fault of=\"inner/filter\">"));
  EXPECT_EQ(rules[0].position.line, 22);
  EXPECT_TRUE(RulesThatName(Get<FrameworkElement>("/demo/source"), kNamedFile, "app.xml", PathAttributesIn(shop_.tags)).empty());
}

}  // namespace
}  // namespace runnel::testing
