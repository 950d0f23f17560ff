#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <stdlib.h>

#include "core/base/files.h"

namespace runnel {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(TemporaryFolderTest, GoesWithItsObjectAndAllThatIsInIt) {
  std::optional<TemporaryFolder> moved;
  {
    auto folder = TemporaryFolder::Make("test");
    ASSERT_TRUE(folder);
    moved.emplace(*std::move(folder));
  }  // what has been moved from takes nothing with it
  const fs::path path = moved->path();
  EXPECT_THAT(path.filename().string(), HasSubstr("runnel-test-"));
  fs::create_directory(path / "inner");
  std::ofstream(path / "inner" / "file") << "text";
  EXPECT_TRUE(fs::exists(path / "inner" / "file"));
  moved.reset();
  EXPECT_FALSE(fs::exists(path));
}

TEST(TemporaryFolderTest, TwoAreTwo) {
  const auto one = TemporaryFolder::Make("test"), other = TemporaryFolder::Make("test");
  ASSERT_TRUE(one && other);
  EXPECT_NE(one->path(), other->path());
}

TEST(TemporaryFolderTest, CannotBeMadeWhereThereIsNoPlaceForIt) {
  const char* before = getenv("TMPDIR");
  const std::optional<std::string> kept = before ? std::optional<std::string>(before) : std::nullopt;
  setenv("TMPDIR", "/nowhere/at/all", 1);
  const auto folder = TemporaryFolder::Make("test");
  kept ? setenv("TMPDIR", kept->c_str(), 1) : unsetenv("TMPDIR");
  ASSERT_FALSE(folder);
  EXPECT_THAT(folder.error().ToString(), HasSubstr("TMPDIR"));
}

}  // namespace
}  // namespace runnel
