#include "plugins/command_service/save_place.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class SavePlaceTest : public ::testing::Test {
 protected:
  SavePlaceTest() {
    fs::create_directories(root / "apps" / "below");
    fs::create_directories(root / "other");
    std::ofstream(file) << "x";
  }

  const test::TemporaryFolder folder;
  const fs::path root = fs::canonical(folder.path());
  const fs::path file = root / "apps" / "app.xml";
};

TEST_F(SavePlaceTest, IsBesideTheFileOfTheApplicationOrBelow) {
  for (const std::string& wanted :
       {std::string("new.xml"), std::string("below/new.xml"), std::string("./below/../new.xml"), file.string(),
        (root / "apps" / "new.xml").string()}) {
    const auto place = SavePlace(file.string(), wanted);
    ASSERT_TRUE(place) << wanted << place.error().ToString();
    EXPECT_THAT(*place, ::testing::StartsWith((root / "apps").string()));
  }
  EXPECT_EQ(*SavePlace(file.string(), "new.xml"), (root / "apps" / "new.xml").string());
}

TEST_F(SavePlaceTest, IsNowhereElse) {
  fs::create_directory_symlink(root / "other", root / "apps" / "link");
  fs::create_symlink(root / "other" / "target.xml", root / "apps" / "link.xml");
  for (const std::string& wanted :
       {std::string("../other/new.xml"), std::string("/etc/new.xml"), std::string("below/../../other/new.xml"),
        std::string("link/new.xml"), std::string("link.xml"), (root / "apps2" / "new.xml").string(),
        std::string("../app.xml")}) {
    const auto place = SavePlace(file.string(), wanted);
    ASSERT_FALSE(place) << wanted << " -> " << *place;
    EXPECT_THAT(place.error().message, HasSubstr(wanted));
    EXPECT_THAT(place.error().hint, HasSubstr((root / "apps").string()));
  }
}

// As an application is named that lies where the program was started.
TEST_F(SavePlaceTest, IsBesideAFileThatIsNamedWithoutAFolder) {
  const fs::path here = fs::canonical(fs::current_path());
  for (const char* wanted : {"/etc/new.xml", "../new.xml", "below/../../new.xml"}) {
    const auto place = SavePlace("robot.xml", wanted);
    ASSERT_FALSE(place) << wanted << " -> " << *place;
    EXPECT_THAT(place.error().hint, HasSubstr(here.string()));
  }
  EXPECT_EQ(*SavePlace("robot.xml", "new.xml"), (here / "new.xml").string());
}

TEST_F(SavePlaceTest, IsAnXmlFile) {
  for (const char* wanted : {"", ".", "..", ".xml", "new", "new.xml/", "new.sh", "new.xml.sh"}) {
    EXPECT_FALSE(SavePlace(file.string(), wanted)) << wanted;
  }
}

TEST_F(SavePlaceTest, IsANameForWhatCameFromNoFile) {
  EXPECT_EQ(*SavePlace("", "new.xml"), "new.xml");
  EXPECT_FALSE(SavePlace("", "below/new.xml"));
  EXPECT_FALSE(SavePlace("", "/new.xml"));
}

}  // namespace

}  // namespace runnel
