#include "plugins/application_files/saving/save_preview.h"

#include <gmock/gmock.h>

#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

const char* const kSmall = R"(<application name='demo'>
  <thread name="slow" period="0.05 s"/>
  <module name="source" type="test/source" thread="slow"/> <!-- alone -->
</application>
)";

TEST(SavePreview, TellsWhatSavingWouldWriteAndWritesNothing) {
  const TestFolder folder;
  const std::filesystem::path file = folder / "app.xml";
  WriteAll(file, kSmall);
  SavingWorkshop shop;
  FrameworkElement& application = *shop.Load(file);
  auto preview = PreviewSave(application, shop.tools());
  ASSERT_TRUE(preview) << preview.error().ToString();
  EXPECT_EQ(preview->before, kSmall);
  EXPECT_EQ(preview->after, kSmall);

  ASSERT_TRUE(shop.Get<Source>("/demo/source").gain.Set(3.5));
  preview = PreviewSave(application, shop.tools());
  ASSERT_TRUE(preview) << preview.error().ToString();
  EXPECT_EQ(preview->file, file);
  EXPECT_EQ(preview->before, kSmall);
  EXPECT_NE(preview->after, kSmall);
  EXPECT_EQ(ReadAll(file), kSmall) << "nothing is written";
  ASSERT_TRUE(SaveApplication(application, shop.tools()));
  EXPECT_EQ(ReadAll(file), preview->after);

  preview = PreviewSave(application, shop.tools(), folder / "copy.xml");
  ASSERT_TRUE(preview) << preview.error().ToString();
  EXPECT_EQ(preview->before, "") << "there is no such file yet";
}

}  // namespace
}  // namespace runnel::testing
