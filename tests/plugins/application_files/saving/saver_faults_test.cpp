// A file is as it was or saved, wherever memory runs out, and the application knows which.

#include <new>

#include "plugins/application_files/application_builder.h"
#include "plugins/testing/fault_injection.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

namespace fs = std::filesystem;

const char* const kSaved = R"(<application name="demo">
  <module name="source" type="test/source">
    <parameter name="gain" value="2.5"/>
  </module>
</application>
)";

std::size_t CountOfFiles(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

// Each point at first, then fewer and fewer: whole files are read for a check.
std::size_t After(std::size_t nth) { return nth + 1 + nth / 100; }

void Endure(bool has_file) {
  bool has_struck = true;
  for (std::size_t nth = 1; has_struck; nth = After(nth)) {
    SCOPED_TRACE(nth);
    const TestFolder folder;
    const fs::path file = folder / "app.xml";
    SavingWorkshop shop;
    if (has_file) WriteAll(file, kSaved);
    FrameworkElement* const application = has_file ? shop.Load(file) : shop.Build(kSaved);
    ASSERT_NE(application, nullptr);
    ASSERT_TRUE(shop.Get<Source>("/demo/source").count.SetFromText("7"));
    bool is_saved = false;
    test::FaultInjection injection(test::InjectedFault::kAllocation, nth);
    try {
      is_saved = SaveApplication(application->runtime(), *application, shop.tools(), file).has_value();
    } catch (const std::bad_alloc&) {
    }
    injection.End();
    has_struck = injection.has_struck();
    ASSERT_TRUE(is_saved || has_struck);
    ASSERT_EQ(is_saved, ReadAll(file) != (has_file ? kSaved : ""));
    fs::remove(file.string() + "~");  // what was in the file, if it has come to that
    ASSERT_EQ(CountOfFiles(folder.path()), is_saved || has_file ? 1u : 0u);
    // It knows what is in the file, and takes it for nobody else's.
    ASSERT_TRUE(shop.Get<Source>("/demo/source").count.SetFromText("8"));
    const auto saved = SaveApplication(application->runtime(), *application, shop.tools(), file);
    ASSERT_TRUE(saved) << saved.error().ToString();
    ASSERT_TRUE(application->FindAnnotation<ApplicationSource>());
  }
}

TEST(SaverFaults, AnApplicationIsSavedToItsFileOrNot) { Endure(true); }
TEST(SaverFaults, AnApplicationOfNoFileIsSavedToANewOneOrNot) { Endure(false); }

}  // namespace
}  // namespace runnel::testing
