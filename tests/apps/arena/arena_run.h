#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/integration/program.h"

namespace runnel::test {

/// A folder for the files of a test, and the arena started with words.
class ArenaTest : public testing::Test {
 protected:
  ArenaTest() {
    const auto* const info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("arena_") + info->test_suite_name() + "_" + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ArenaTest() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string File(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] static Ended Arena(const std::string& words) { return Runnel("arena " + words); }
  [[nodiscard]] std::string Text(const std::string& name) const {
    std::ifstream stream(File(name), std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  [[nodiscard]] nlohmann::json Json(const std::string& name) const { return nlohmann::json::parse(Text(name)); }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(File(name), std::ios::binary) << text;
  }

  std::filesystem::path folder_;
};

}  // namespace runnel::test
