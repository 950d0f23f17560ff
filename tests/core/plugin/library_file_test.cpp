// A plugin's file that is being copied, or that a full disk has cut short: looking at what is not there ends the process.

#include <fstream>

#include <gmock/gmock.h>

#include "core/plugin/abi_difference.h"
#include "core/plugin/plugin_manager.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class LibraryFileTest : public testing::Test {
 protected:
  LibraryFileTest() { manager.AddSearchFolder(folder.path()); }
  // A new file in the place of the old one, as linkers and `install` do it.
  void Put(std::string_view bytes) {
    std::ofstream(folder / "new", std::ios::binary) << bytes;
    fs::rename(folder / "new", file);
  }
  [[nodiscard]] static std::string Whole(const char* name = "good.so") {
    std::ifstream from(fs::path(RUNNEL_TEST_PLUGINS) / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(from), {}};
  }

  const TemporaryFolder folder;
  const fs::path file = folder / "good.so";
  const std::string whole = Whole();
  PluginManager manager;
};

TEST_F(LibraryFileTest, ThatLacksItsEndIsRefused) {
  ASSERT_GT(whole.size(), 5000U);
  for (const std::size_t size : {std::size_t{0}, std::size_t{3}, std::size_t{16}, std::size_t{63}, std::size_t{64},
                                 std::size_t{1000}, std::size_t{4096}, whole.size() / 2, whole.size() - 1}) {
    Put(std::string_view(whole).substr(0, size));
    EXPECT_FALSE(CheckIsWhole(file)) << size;
    const auto loaded = manager.Load("good");
    ASSERT_FALSE(loaded) << size;
    EXPECT_THAT(loaded.error().message,
                AllOf(HasSubstr("the plugin " + file.string() + " is refused"), HasSubstr("it is cut short")));
    EXPECT_THAT(loaded.error().hint, HasSubstr("rename it when it is whole"));
  }
  Put(whole);
  EXPECT_TRUE(CheckIsWhole(file));
  EXPECT_TRUE(manager.Load("good"));
}

// Room for all of it has been made, and what linkers write last is not there yet.
TEST_F(LibraryFileTest, WhoseEndHasNotBeenWrittenIsRefused) {
  std::string half = whole;
  std::fill(half.begin() + static_cast<std::ptrdiff_t>(half.size() / 2), half.end(), '\0');
  Put(half);
  EXPECT_THAT(manager.Load("good").error().message, HasSubstr("has not been written to its end yet"));
}

TEST_F(LibraryFileTest, ThatCannotBeLoadedAnewLeavesAllAsItWas) {
  Put(whole);
  ASSERT_TRUE(manager.Load("good"));
  for (const std::size_t size : {std::size_t{1000}, whole.size() / 2}) {
    Put(std::string_view(whole).substr(0, size));
    const auto reload = manager.Reload("good");
    ASSERT_FALSE(reload);
    EXPECT_THAT(reload.error().message, AllOf(HasSubstr(file.string()), HasSubstr("it is cut short")));
    EXPECT_NE(manager.modules().Find("good/counter"), nullptr);
  }
  Put(whole);
  EXPECT_TRUE(manager.Reload("good"));
}

// It would be mapped with it.
TEST_F(LibraryFileTest, ThatNeedsOneThatLacksItsEndIsRefused) {
  const fs::path needing = folder / "needing.so";
  const fs::path needed = folder / "librunnel_test_needed.so";
  std::ofstream(needing, std::ios::binary) << Whole("needed_1/needing.so");
  const std::string all = Whole("needed_1/librunnel_test_needed.so");
  for (const std::size_t size : {std::size_t{0}, std::size_t{1000}, all.size() / 2, all.size() - 1}) {
    std::ofstream(needed, std::ios::binary) << std::string_view(all).substr(0, size);
    const auto loaded = manager.Load("needing");
    ASSERT_FALSE(loaded) << size;
    EXPECT_THAT(loaded.error().message,
                AllOf(HasSubstr("the plugin " + needing.string() + " is refused: "),
                      HasSubstr(needed.string() + ", which it needs, cannot be loaded: it is cut short")));
  }
  std::ofstream(needed, std::ios::binary) << all;
  EXPECT_TRUE(CheckIsWhole(needing));
}

TEST_F(LibraryFileTest, ThatIsNoneOrNotThereIsRefused) {
  Put("This is text.\n");
  EXPECT_EQ(CheckIsWhole(file).error().message, "it is no ELF file");
  EXPECT_EQ(CheckIsWhole(folder / "nothing.so").error().message, "it cannot be read");
  EXPECT_FALSE(CheckIsWhole(folder.path()));
}

}  // namespace
}  // namespace runnel::test
