#include "core/plugin/plugin_manager.h"

#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/plugin/plugin_entry.h"
#include "tests/core/plugin/tag_registry.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const fs::path kFolder = RUNNEL_TEST_PLUGINS;

class PluginManagerTest : public testing::Test {
 protected:
  PluginManagerTest() {
    manager.registry().Offer(tags);
    manager.AddSearchFolder(kFolder);
  }

  // What the manager says of a plugin that it refuses; and that nothing of it stays.
  Error RefusalOf(const std::string& name) {
    const auto types = manager.modules().All().size();
    const auto tag_count = tags.plugin_of.size();
    const auto loaded = manager.loaded();
    const auto result = manager.Load(name);
    EXPECT_FALSE(result);
    EXPECT_EQ(manager.modules().All().size(), types);
    EXPECT_EQ(tags.plugin_of.size(), tag_count);
    EXPECT_EQ(manager.loaded(), loaded);
    return result ? Error{} : result.error();
  }
  static std::string Refused(const std::string& name, const std::string& why) {
    return "the plugin " + (kFolder / (name + ".so")).string() + " is refused: " + why;
  }

  TagRegistry tags;
  PluginManager manager;
};

TEST_F(PluginManagerTest, GoodPluginRegistersWhatItBringsOnce) {
  ASSERT_TRUE(manager.Load("good"));
  ASSERT_TRUE(manager.Load("good"));
  EXPECT_THAT(manager.loaded(), ElementsAre("good"));
  const auto* type = manager.modules().Find("good/counter");
  ASSERT_NE(type, nullptr);
  EXPECT_EQ(type->plugin, "good");
  EXPECT_EQ(type->summary, "counts");
  EXPECT_EQ(tags.plugin_of["good"], "good");
}

TEST_F(PluginManagerTest, ModulesOfAPluginAreMadeAndOutliveTheManager) {
  Runtime runtime;
  {
    PluginManager other;
    other.AddSearchFolder(kFolder);
    ASSERT_TRUE(other.Load("good"));
    ASSERT_TRUE(other.modules().Create("good/counter", runtime.root(), "counter"));
    const auto broken = other.modules().Create("good/broken", runtime.root(), "broken");
    ASSERT_FALSE(broken);
    EXPECT_THAT(broken.error().message, HasSubstr("the device is missing"));
  }
  EXPECT_TRUE(runtime.root().Find("counter/output/count"));
}

TEST_F(PluginManagerTest, PluginMayLeaveOutRegistriesThatNobodyOffers) {
  PluginManager plain;
  plain.AddSearchFolder(kFolder);
  EXPECT_TRUE(plain.Load("good"));
  EXPECT_TRUE(tags.plugin_of.empty());
}

TEST_F(PluginManagerTest, NameWithASlashIsAFile) {
  PluginManager plain;
  ASSERT_TRUE(plain.Load((kFolder / "good.so").string()));
  EXPECT_THAT(plain.loaded(), ElementsAre("good"));
  const auto missing = plain.Load("/no/such/plugin.so");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message, "there is no plugin file '/no/such/plugin.so'");
}

TEST_F(PluginManagerTest, MissingPluginIsToldWithTheFoldersAndTheNearestName) {
  const Error error = RefusalOf("goood");
  EXPECT_THAT(error.message, HasSubstr("no plugin 'goood' in " + kFolder.string()));
  EXPECT_THAT(error.hint, testing::StartsWith("did you mean 'good'?; "));
  EXPECT_THAT(error.hint, HasSubstr("RUNNEL_PLUGIN_PATH"));
}

TEST_F(PluginManagerTest, LibraryWithoutEntryIsRefused) {
  const Error error = RefusalOf("no_entry");
  EXPECT_EQ(error.message, Refused("no_entry", "it has no entry RunnelPluginEntry"));
  EXPECT_THAT(error.hint, HasSubstr("RUNNEL_PLUGIN(name, registry)"));
}

TEST_F(PluginManagerTest, EmptyEntryIsRefused) {
  EXPECT_EQ(RefusalOf("empty_entry").message, Refused("empty_entry", "its entry is empty"));
}

TEST_F(PluginManagerTest, OtherAbiVersionIsRefusedWithBothVersions) {
  const Error error = RefusalOf("other_abi_version");
  EXPECT_EQ(error.message,
            Refused("other_abi_version", "it was built for plugin ABI " + std::to_string(kPluginAbiVersion + 1) +
                                             ", this core has " + std::to_string(kPluginAbiVersion)));
  EXPECT_EQ(error.hint, "rebuild the plugin");
}

TEST_F(PluginManagerTest, OtherSizeOfTheEntryIsRefused) {
  EXPECT_EQ(RefusalOf("other_entry_size").message,
            Refused("other_entry_size", "its entry has another size than this core's"));
}

TEST_F(PluginManagerTest, OtherCompilerIsRefusedWithBothFingerprints) {
  const Error error = RefusalOf("other_fingerprint");
  EXPECT_EQ(error.message, Refused("other_fingerprint", "it was built with 'some other compiler', this core with '" +
                                                            std::string(CoreAbiFingerprint()) + "'"));
  EXPECT_EQ(error.hint, "rebuild the plugin with the compiler of the core");
}

TEST_F(PluginManagerTest, OtherLayoutOfTheSameClassesIsRefused) {
  const Error mode = RefusalOf("other_library_mode");
  EXPECT_THAT(mode.message, HasSubstr("the debug mode of the standard library"));
  EXPECT_THAT(mode.hint, HasSubstr("-D_GLIBCXX_DEBUG"));
  const Error alignment = RefusalOf("other_alignment");
  EXPECT_THAT(alignment.message, HasSubstr("for AVX"));
  EXPECT_THAT(alignment.hint, HasSubstr("-march=native"));
  EXPECT_THAT(CoreAbiFingerprint(), testing::StartsWith("runnel-abi-" + std::to_string(kPluginAbiVersion) + " "));
}

TEST_F(PluginManagerTest, OneFileMayBeNamedInManyWays) {
  ASSERT_TRUE(manager.Load("good"));
  EXPECT_TRUE(manager.Load((kFolder / "good.so").string()));
  EXPECT_TRUE(manager.Load((kFolder / ".." / kFolder.filename() / "good.so").string()));
  EXPECT_THAT(manager.loaded(), ElementsAre("good"));
}

TEST_F(PluginManagerTest, OtherFileOfALoadedNameIsRefused) {
  ASSERT_TRUE(manager.Load("good"));
  const TemporaryFolder folder;
  fs::copy_file(kFolder / "throws.so", folder / "good.so", fs::copy_options::overwrite_existing);
  const auto result = manager.Load((folder / "good.so").string());
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, HasSubstr("is refused: a plugin 'good' is loaded already from " +
                                                fs::canonical(kFolder / "good.so").string()));
  EXPECT_THAT(manager.loaded(), ElementsAre("good"));
}

TEST_F(PluginManagerTest, RegistrationThatThrowsLeavesNothingBehind) {
  EXPECT_EQ(RefusalOf("throws").message, Refused("throws", "its registration failed: no driver"));
  EXPECT_EQ(RefusalOf("throws_int").message, Refused("throws_int", "its registration failed: exception of type int"));
  EXPECT_EQ(RefusalOf("throws").message,  // and it may be tried again
            Refused("throws", "its registration failed: no driver"));
}

TEST_F(PluginManagerTest, OfferedRegistriesKnowWhosePluginRegistersAndWhenItIsOver) {
  EXPECT_TRUE(manager.Load("good"));
  EXPECT_FALSE(manager.Load("throws_int"));
  EXPECT_TRUE(manager.Reload("good"));
  EXPECT_THAT(tags.plugins_told, ElementsAre("good", "", "throws_int", "", "good", ""));
}

// The linker puts a new file in the place of the old one.
TEST_F(PluginManagerTest, WhatNeedsALibraryThatHasChangedCannotBeLoadedAnew) {
  const TemporaryFolder folder;
  const auto put = [&](const char* from, const char* file) {
    fs::copy_file(kFolder / from / file, folder / "new");
    fs::rename(folder / "new", folder / file);
  };
  put("needed_1", "needing.so");
  put("needed_1", "librunnel_test_needed.so");
  manager.AddSearchFolder(folder.path());
  ASSERT_TRUE(manager.Load("needing"));
  {
    auto reload = manager.Reload("needing");
    ASSERT_TRUE(reload) << reload.error().ToString();
    reload->Keep();
  }
  put("needed_2", "librunnel_test_needed.so");
  const auto reload = manager.Reload("needing");
  ASSERT_FALSE(reload);
  EXPECT_THAT(reload.error().message, AllOf(HasSubstr("librunnel_test_needed.so"), HasSubstr("has been built anew")));
  EXPECT_NE(manager.modules().Find("needing/version_1"), nullptr);
  put("needed_1", "librunnel_test_needed.so");
  EXPECT_TRUE(manager.Reload("needing")) << "what was built anew and has not changed";
}

TEST_F(PluginManagerTest, TypeOfAnotherPluginCannotBeTakenOver) {
  ASSERT_TRUE(manager.Load("good"));
  EXPECT_EQ(RefusalOf("duplicate").message,
            Refused("duplicate", "module type 'good/counter' comes with plugin 'good' already"));
  EXPECT_EQ(manager.modules().Find("good/counter")->plugin, "good");
  EXPECT_EQ(RefusalOf("same_name_in_itself").message,
            Refused("same_name_in_itself", "module type 'twice/idle' comes with plugin 'same_name_in_itself' already"));
}

TEST_F(PluginManagerTest, FileThatIsNoLibraryIsRefused) {
  EXPECT_EQ(RefusalOf("not_a_library").message, Refused("not_a_library", "it is no ELF file"));
}

TEST_F(PluginManagerTest, LibraryThatLacksAFunctionIsRefusedAtOnce) {
  EXPECT_THAT(RefusalOf("missing_symbol").message, HasSubstr("RunnelTestFunctionThatIsNowhere"));
}

TEST_F(PluginManagerTest, AvailableListsThePluginsOfAllFoldersSorted) {
  const auto names = manager.Available();
  EXPECT_TRUE(std::ranges::is_sorted(names));
  EXPECT_THAT(names, Contains("good"));
  EXPECT_THAT(names, Contains("throws"));
}

TEST_F(PluginManagerTest, FirstFolderOfTheSearchPathWins) {
  const TemporaryFolder folder;
  std::ofstream(folder / "good.so") << "text";
  manager.AddSearchFolder(folder.path());
  EXPECT_THAT(RefusalOf("good").message, HasSubstr((folder / "good.so").string()));
}

// Sets RUNNEL_PLUGIN_PATH for as long as it lives.
class PluginPath {
 public:
  explicit PluginPath(const std::string& value) { setenv("RUNNEL_PLUGIN_PATH", value.c_str(), 1); }
  ~PluginPath() { unsetenv("RUNNEL_PLUGIN_PATH"); }
};

TEST(PluginSearchPathTest, BuildTreeIsSearchedWithoutAnyHelp) {
  unsetenv("RUNNEL_PLUGIN_PATH");
  const PluginManager manager;
  ASSERT_EQ(manager.search_path().size(), 1u);
  EXPECT_EQ(fs::weakly_canonical(manager.search_path()[0]), fs::weakly_canonical(RUNNEL_BUILD_PLUGINS));
}

TEST(PluginSearchPathTest, FoldersOfTheEnvironmentComeFirst) {
  const PluginPath path("/first::" + kFolder.string() + ":");
  PluginManager manager;
  ASSERT_EQ(manager.search_path().size(), 3u);
  EXPECT_EQ(manager.search_path()[0], "/first");
  EXPECT_EQ(manager.search_path()[1], kFolder);
  EXPECT_TRUE(manager.Load("good"));
}

TEST(PluginSearchPathTest, FoldersThatDoNotExistAreLeftOut) {
  const PluginPath path("/no/such/folder");
  const PluginManager manager;
  EXPECT_THAT(manager.Available(), Not(Contains("folder")));
}

TEST(PluginSearchPathTest, FilesThatAreNoPluginsAreNotListed) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "directory.so");
  std::ofstream(folder / "plugin.so");
  std::ofstream(folder / "README.md");
  const PluginPath path(folder.path().string());
  const PluginManager manager;
  EXPECT_THAT(manager.Available(), Contains("plugin"));
  EXPECT_THAT(manager.Available(), Not(Contains("README")));
  EXPECT_THAT(manager.Available(), Not(Contains("directory")));
}

}  // namespace
}  // namespace runnel::test
