#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "modules/simulation/scene.h"

namespace runnel::test {

/// A file of this test program that is gone afterwards.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& text)
      : path_(std::filesystem::path(testing::TempDir()) /
              (testing::UnitTest::GetInstance()->current_test_info()->name() + name)) {
    if (!text.empty()) std::ofstream(path_) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  [[nodiscard]] std::string path() const { return path_.string(); }
  [[nodiscard]] std::string Read() const {
    std::ifstream file(path_);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::filesystem::path path_;
};

inline Scene SceneWithAWall() {
  World world{.name = "wall", .start = {}, .goal = {5, 1}};
  world.boxes.push_back({.pose = {2, 0, 0}, .length = 1, .width = 4});
  auto rays = std::make_shared<const RayCaster>(OutlineOf(world), 0.3);
  return {std::make_shared<const World>(world), rays, 0.15};
}

}  // namespace runnel::test
