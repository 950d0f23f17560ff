#include <set>

#include "plugins/ros_messages/message_export.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

namespace {

std::string DescriptionOf(const std::string& package, const std::set<std::string>& needed) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<package format=\"3\">\n"
      "  <name>" + package + "</name>\n"
      "  <version>0.0.0</version>\n"
      "  <description>What applications of Runnel publish.</description>\n"
      "  <maintainer email=\"you@example.com\">you</maintainer>\n"
      "  <license>that of your application</license>\n\n"
      "  <buildtool_depend>ament_cmake</buildtool_depend>\n"
      "  <buildtool_depend>rosidl_default_generators</buildtool_depend>\n";
  for (const std::string& each : needed) text += "  <depend>" + each + "</depend>\n";
  return text +
         "  <exec_depend>rosidl_default_runtime</exec_depend>\n"
         "  <member_of_group>rosidl_interface_packages</member_of_group>\n\n"
         "  <export>\n    <build_type>ament_cmake</build_type>\n  </export>\n</package>\n";
}

std::string BuildFileOf(const std::string& package, const std::set<std::string>& needed, const std::string& files) {
  std::string text = "cmake_minimum_required(VERSION 3.8)\nproject(" + package +
                     ")\n\nfind_package(ament_cmake REQUIRED)\nfind_package(rosidl_default_generators REQUIRED)\n";
  std::string dependencies;
  for (const std::string& each : needed) {
    text += "find_package(" + each + " REQUIRED)\n";
    dependencies += " " + each;
  }
  text += "\nrosidl_generate_interfaces(${PROJECT_NAME}\n" + files;
  if (!dependencies.empty()) text += "  DEPENDENCIES" + dependencies + "\n";
  return text + ")\n\nament_export_dependencies(rosidl_default_runtime)\nament_package()\n";
}

}  // namespace

FileTexts MessagePackageOf(const std::vector<const MessageDefinition*>& messages, const MessageLibrary& library) {
  FileTexts files;
  if (messages.empty()) return files;
  const std::string package = PackageOf(messages.front()->name);
  std::set<std::string> needed;
  const auto add = [&](const MessageDefinition& message) {
    if (PackageOf(message.name) == package) {
      files["msg/" + LastNameOf(message.name) + ".msg"] = TextOf(message);
    } else {
      needed.insert(PackageOf(message.name));
    }
  };
  for (const MessageDefinition* const message : messages) {
    add(*message);
    for (const MessageDefinition* const inside : library.InsideOf(*message)) add(*inside);
  }
  std::string names;
  for (const auto& [name, text] : files) names += "  \"" + name + "\"\n";
  files["package.xml"] = DescriptionOf(package, needed);
  files["CMakeLists.txt"] = BuildFileOf(package, needed, names);
  return files;
}

}  // namespace runnel
