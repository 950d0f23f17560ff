#include "plugins/inspector/xml_inspector_tag.h"

#include <gmock/gmock.h>

#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {

namespace {

class InspectorTag : public ::testing::Test {
 protected:
  InspectorTag() { AddInspectorTag(shop.tags); }

  FrameworkElement* Load(const std::string& tag) {
    WriteAll(folder / "app.xml", "<application name=\"a\">\n  " + tag + "\n  <group name=\"g\"/>\n</application>\n");
    return shop.Load(folder / "app.xml");
  }

  TestFolder folder;
  SavingWorkshop shop;
};

TEST_F(InspectorTag, SaysWhereTheInspectorIs) {
  FrameworkElement* const application = Load(
      R"(<inspector port="9000" address="0.0.0.0" read_only="true" token="look:open-sesame" token_file="/t" all_users="true"/>)");
  ASSERT_NE(application, nullptr);
  const auto place = InspectorPlaceOf(*application);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->port, 9000);
  EXPECT_EQ(place->address, "0.0.0.0");
  EXPECT_EQ(place->token, "look:open-sesame");
  EXPECT_EQ(place->token_file, "/t");
  EXPECT_TRUE(place->is_for_all_users);
  EXPECT_TRUE(place->is_read_only);
}

TEST_F(InspectorTag, NeedsNoAttributes) {
  FrameworkElement* const application = Load("<inspector/>");
  ASSERT_NE(application, nullptr);
  const auto place = InspectorPlaceOf(*application);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->port, 8765);
  EXPECT_EQ(place->address, "127.0.0.1");
  EXPECT_FALSE(place->is_read_only);
}

TEST_F(InspectorTag, WithoutItThereIsNone) {
  FrameworkElement* const application = Load("");
  ASSERT_NE(application, nullptr);
  EXPECT_FALSE(InspectorPlaceOf(*application));
}

TEST_F(InspectorTag, IsSavedAsItWas) {
  for (const std::string tag : {R"(<inspector/>)", R"(<inspector port="8765"   read_only="false" />)",
                                R"(<inspector token="open-sesame" port="0" address="0.0.0.0"/>)"}) {
    SavingWorkshop own;
    AddInspectorTag(own.tags);
    WriteAll(folder / "own.xml", "<application name=\"a\">\n  " + tag + "\n</application>\n");
    FrameworkElement* const application = own.Load(folder / "own.xml");
    ASSERT_NE(application, nullptr);
    EXPECT_EQ(own.Text(*application, folder.path()), ReadAll(folder / "own.xml"));
  }
}

TEST_F(InspectorTag, IsWrittenIntoANewFile) {
  FrameworkElement* const application = Load(R"(<inspector port="9000" read_only="true"/>)");
  ASSERT_NE(application, nullptr);
  const auto saved = SaveApplication(application->runtime(), *application, shop.tools(), folder / "other.xml");
  ASSERT_TRUE(saved) << saved.error().ToString();
  EXPECT_THAT(ReadAll(folder / "other.xml"), ::testing::HasSubstr(R"(<inspector port="9000" read_only="true"/>)"));
}

}  // namespace

}  // namespace runnel::testing
