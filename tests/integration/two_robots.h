#pragma once

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "tests/integration/program.h"
#include "tests/support/own_network.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace runnel::test {

inline const std::string kApps = std::string(RUNNEL_XML) + "/apps/";

class TwoRobots : public testing::Test {
 protected:
  TwoRobots() {
    setenv("ROS_DOMAIN_ID", std::to_string(OwnDomain()).c_str(), 1);
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
  }
  ~TwoRobots() override {
    unsetenv("XDG_RUNTIME_DIR");
    unsetenv("ROS_DOMAIN_ID");
  }

  static std::unique_ptr<Program> Start(const std::string& file) {
    return std::make_unique<Program>("run " + kApps + file);
  }
  /// With another attribute in <network>.
  std::unique_ptr<Program> StartWith(const std::string& file, const std::string& attribute,
                                     const std::string& program = RUNNEL_PROGRAM) {
    std::ifstream stream(kApps + file);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::string tag = "<network ";
    text.insert(text.find(tag) + tag.size(), attribute + " ");
    const std::string copy = folder_ / file;
    std::ofstream(copy) << text;
    const std::string world = file == "two_robots.xml" ? " world=" RUNNEL_XML "/worlds/rooms.xml" : "";
    return std::make_unique<Program>("run " + copy + world, program);
  }
  /// An application of the test's own, in a file of its name.
  std::string Write(const std::string& name, const std::string& content) const {
    const std::string file = folder_ / (name + ".xml");
    std::ofstream(file) << "<application name=\"" << name << "\">\n  <load plugin=\"motion\"/>\n"
                        << content << "</application>\n";
    return file;
  }
  static std::string Read(const std::string& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// Until a command says something.
  static void WaitForText(const std::string& command, const std::string& text) {
    WaitUntil("'runnel " + command + "' says " + text,
              [&] { return Runnel(command).text.find(text) != std::string::npos; });
  }
  /// That the robot is told to go.
  static void WaitUntilItDrives() {
    WaitUntil("the robot drives", [] {
      const std::string twist = Runnel("get --app robot /gate/wanted").text;
      return twist.find("forward: 0.") != std::string::npos;
    });
  }

  const TemporaryFolder folder_;
};

}  // namespace runnel::test
