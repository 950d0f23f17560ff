#include <fstream>

#include <gmock/gmock.h>

#include "core/base/files.h"
#include "plugins/testing/fault_injection.h"
#include "tests/support/temporary_folder.h"

namespace runnel {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(NamesInFolder, AreSortedAndWithoutTheFoldersThemselves) {
  const test::TemporaryFolder folder;
  for (const char* name : {"b", "a.xml", ".hidden"}) std::ofstream(folder / name);
  std::filesystem::create_directory(folder / "c");
  EXPECT_THAT(NamesInFolder(folder.path()), ElementsAre(".hidden", "a.xml", "b", "c"));
}

TEST(NamesInFolder, AreNoneWhereThereIsNone) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(NamesInFolder(folder.path()), IsEmpty());
  EXPECT_THAT(NamesInFolder(folder / "missing"), IsEmpty());
}

TEST(NamesInFolder, WithoutMemoryAreAnExceptionAndNoEnd) {
  const test::TemporaryFolder folder;
  for (const char* name : {"first_name_of_more_than_fifteen", "second_name_of_more_than_fifteen"}) {
    std::ofstream(folder / name);
  }
  std::size_t found = 0;
  const std::size_t points = test::AtEachPoint(
      test::InjectedFault::kAllocation,
      [&] {
        found = 0;
        try {
          found = NamesInFolder(folder.path()).size();
        } catch (const std::bad_alloc&) {
        }
      },
      [&](bool has_struck) { EXPECT_EQ(found, has_struck ? 0u : 2u); });
  EXPECT_GE(points, 3u);
}

}  // namespace
}  // namespace runnel
