#include "tests/plugins/mcap/mcap_oracle.h"

#include <array>
#include <cstdio>
#include <filesystem>

#include <gtest/gtest.h>

namespace runnel::test {

std::string WhyNoOracle() {
  if (std::string(RUNNEL_ORACLE).empty()) return "npm was not there when this was configured";
  if (!std::filesystem::exists(RUNNEL_ORACLE "/node_modules/@mcap/core")) {
    return "npm could not install @mcap/core when this was built";
  }
  return {};
}

std::string AskOracle(const std::string& script, const std::vector<std::string>& arguments) {
  std::string command = "cd " RUNNEL_ORACLE " && " RUNNEL_NODE " " + script;
  for (const std::string& argument : arguments) command += " '" + argument + "'";
  command += " 2>&1";
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) {
    ADD_FAILURE() << "cannot run " << command;
    return {};
  }
  std::string said;
  std::array<char, 4096> buffer;
  for (std::size_t count; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    said.append(buffer.data(), count);
  }
  const int status = pclose(pipe);
  EXPECT_EQ(status, 0) << command << "\n" << said;
  return said;
}

}  // namespace runnel::test
