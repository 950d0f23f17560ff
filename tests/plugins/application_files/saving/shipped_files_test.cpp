// The application files that come with Runnel: loaded and saved, not one byte is other.

#include <algorithm>

#include <gmock/gmock.h>

#include "plugins/application_tags/run_description.h"
#include "plugins/network/network_engines.h"
#include "plugins/network/xml_network_words.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"
#include "tests/support/fake_wire.h"

namespace runnel::testing {
namespace {

class ShippedFile : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(ShippedFile, IsSavedAsItIs) {
  SavingWorkshop shop;
  shop.plugins.AddSearchFolder(RUNNEL_BUILD_PLUGINS);
  AddNetworkTags(shop.tags);
  AddWireEngine("cyclone", MakeFakeWire());
  FrameworkElement* const application = shop.Load(GetParam());
  ASSERT_NE(application, nullptr);
  EXPECT_EQ(shop.Text(*application, GetParam().parent_path()), ReadAll(GetParam()));
}

std::vector<std::filesystem::path> Files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(RUNNEL_XML "/apps")) {
    if (entry.path().extension() != ".xml") continue;
    if (ReadAll(entry.path()).find("<application ") == std::string::npos) continue;
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

INSTANTIATE_TEST_SUITE_P(Xml, ShippedFile, ::testing::ValuesIn(Files()),
                         [](const auto& file) { return file.param.stem().string(); });

}  // namespace
}  // namespace runnel::testing
