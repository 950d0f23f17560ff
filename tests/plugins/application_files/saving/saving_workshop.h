#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "plugins/application_files/saving/application_saver.h"
#include "plugins/application_tags/run_description.h"
#include "tests/plugins/application_files/reading/test_application.h"
#include "tests/plugins/application_files/saving/application_text.h"

namespace runnel::testing {

inline std::string ReadAll(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void WriteAll(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// A folder of the test's own, empty at first and gone afterwards.
class TestFolder {
 public:
  TestFolder() {
    const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(::testing::TempDir()) / (std::string(test->test_suite_name()) + "." + test->name());
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TestFolder() { std::filesystem::remove_all(path_); }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Needs no connection, and has ports that Source has not.
class Optional final : public Module {
 public:
  using Module::Module;
  Input<double> value_in{this, "value"};
  Output<double> value_out{this, "value"};
  Input<std::string> words{this, "words"};

 private:
  void Update() override {}
};

/// Builds from files, and saves.
struct SavingWorkshop : Workshop {
  FrameworkElement* Load(const std::filesystem::path& file) {
    BuildOutcome outcome = BuildApplication(file, {runtime, plugins, tags, configuration}, BuildMode::kRun);
    diagnostics = outcome.diagnostics;
    EXPECT_TRUE(diagnostics.ok()) << diagnostics.ToString();
    return outcome.application;
  }
  [[nodiscard]] SaveTools tools() { return {plugins, tags}; }
  std::string Text(FrameworkElement& application, const std::filesystem::path& folder) {
    const auto text = testing::ApplicationText(application, tools(), folder);
    return text ? *text : "error: " + text.error().ToString();
  }
};

/// All that a file can say of an application, as text: two that have the same are the same.
std::string StructureText(FrameworkElement& application);

/// That loading the file gives the same application, and saving that one the same text.
void ExpectSame(FrameworkElement& application, const std::filesystem::path& file, unsigned seed);

}  // namespace runnel::testing
