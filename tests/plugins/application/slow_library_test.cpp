// A library that takes long to be opened. In a program without the guards of tests: these look for what they stand before
// when it is called first, which waits for libraries that are being opened.

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <string>

#include <gtest/gtest.h>

#include "core/element/runtime.h"
#include "plugins/application/application.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

// It is so for all changes, of clients and of rules.
TEST(SlowLibrary, KeepsNobodyFromTheStructure) {
  const TemporaryFolder folder;
  const std::string hold = folder / "hold";
  const auto application =
      Application::LoadText("<application name=\"app\"/>", {.plugin_folders = {RUNNEL_TEST_SLOW_PLUGIN}});
  ASSERT_TRUE(application) << application.diagnostics().ToString();
  std::ofstream(hold) << "as long as it is here";
  setenv("RUNNEL_TEST_HOLD", hold.c_str(), 1);
  auto made = std::async(std::launch::async, [&] {
    return application->Apply({CreateModule{"/late", "slow/late"}}).diagnostics.ToString();
  });
  WaitUntil("it is being opened", [&] { return std::filesystem::exists(hold + ".begun"); });
  EXPECT_TRUE(TryStructureLock(application->runtime(), std::chrono::seconds(20)));
  EXPECT_EQ(made.wait_for(std::chrono::seconds(0)), std::future_status::timeout) << "it is still being opened";
  std::filesystem::remove(hold);
  EXPECT_EQ(made.get(), "");
  unsetenv("RUNNEL_TEST_HOLD");
}

}  // namespace
}  // namespace runnel::test
