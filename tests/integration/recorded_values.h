#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "plugins/mcap/mcap_reader.h"

namespace runnel::test {

/// "time json" of each value of a port in a recording that has ended properly.
[[nodiscard]] inline std::vector<std::string> ValuesOf(const std::string& file, const std::string& path) {
  const auto reader = McapReader::Open(file);
  if (!reader) {
    ADD_FAILURE() << reader.error().ToString();
    return {};
  }
  EXPECT_TRUE((*reader)->contents().ended_properly);
  std::vector<std::string> values;
  const auto read = (*reader)->ReadMessages([&](const McapMessage& message) -> Result<void> {
    const McapTexts& about = (*reader)->contents().channels.at(message.channel).metadata;
    if (about == McapTexts{{"port", path}}) {
      values.push_back(std::to_string(message.log_time) + " " + std::string(message.data));
    }
    return {};
  });
  EXPECT_TRUE(read);
  return values;
}

}  // namespace runnel::test
