#include <fstream>

#include <gmock/gmock.h>

#include "modules/simulation/world_file/world_file.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRooms = XmlFolder() / "worlds" / "rooms.xml";

TEST(WorldSearchTest, FindsTheWorldsThatComeWithRunnel) {
  for (const char* word : {"rooms", "rooms.xml", "some/folder/rooms"}) {
    const auto found = FindWorldFile(word);
    ASSERT_TRUE(found) << word << ": " << found.error().ToString();
    EXPECT_EQ(*found, kRooms) << word;
  }
}

TEST(WorldSearchTest, AFileBeatsTheWorldsThatComeWithRunnel) {
  const TemporaryFolder folder;
  const std::string own = folder / "rooms";
  std::ofstream(own) << "<world/>";
  EXPECT_EQ(FindWorldFile(own).value(), own);
}

TEST(WorldSearchTest, NeitherIsToldWithTheNearestName) {
  const auto misspelt = FindWorldFile("room");
  ASSERT_FALSE(misspelt);
  EXPECT_EQ(misspelt.error().message, "there is no world 'room'");
  EXPECT_EQ(misspelt.error().hint, "did you mean 'rooms'?");
  const TemporaryFolder folder;
  std::ofstream(folder / "cup.xml") << "<world/>";
  const auto beside = FindWorldFile(folder / "cpu.xml");
  ASSERT_FALSE(beside);
  EXPECT_THAT(beside.error().hint, testing::HasSubstr("cup.xml"));
  EXPECT_FALSE(FindWorldFile(folder / "rooms.xml")) << "a file that is named with its folder is that file";
}

}  // namespace
}  // namespace runnel::test
