// Files of applications in which something has another name now, and what they were before.

#include <filesystem>

#include <gmock/gmock.h>

#include "plugins/structure/renamed_text.h"
#include "plugins/structure/structure_editor.h"
#include "tests/plugins/application_files/saving/loaded_file.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

class RenamedFile : public LoadedFile {};

TEST_F(RenamedFile, KeepsWhatItsOwnFileWas) {
  Load();
  std::filesystem::permissions(file_, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  ASSERT_TRUE(Get<Source>("/demo/source").gain.Set(3.5));
  ASSERT_TRUE(SaveApplication(application_->runtime(), *application_, shop_.tools(), file_))
      << "its own, however it is named";
  const std::filesystem::path backup = file_.string() + "~";
  EXPECT_EQ(ReadAll(backup), kFile);
  EXPECT_EQ(std::filesystem::status(backup).permissions(), std::filesystem::status(file_).permissions());
  ASSERT_TRUE(SaveApplication(application_->runtime(), *application_, shop_.tools()));
  EXPECT_EQ(ReadAll(backup), kFile) << "nothing was to be written";
}

TEST_F(RenamedFile, WithoutABackupNothingIsReplaced) {
  Load();
  std::filesystem::create_directories(folder_ / "app.xml~" / "full");
  ASSERT_TRUE(Get<Source>("/demo/source").gain.Set(3.5));
  const auto saved = SaveApplication(application_->runtime(), *application_, shop_.tools());
  ASSERT_FALSE(saved);
  EXPECT_THAT(saved.error().message, HasSubstr("cannot be kept as app.xml~"));
  EXPECT_EQ(ReadAll(file_), kFile);
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
  ASSERT_TRUE(SaveApplication(application_->runtime(), *application_, shop_.tools()));
  EXPECT_EQ(ReadAll(file_), wanted);
  rename("/demo/origin", "source");
  EXPECT_EQ(Text(), With("from=\"origin/", "from=\"source/", With("name=\"origin\"", "name=\"source\"", wanted)));
}

}  // namespace
}  // namespace runnel::testing
