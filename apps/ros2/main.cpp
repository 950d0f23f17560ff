// The command `runnel ros2`: messages of ROS 2 for types of Runnel, and types of Runnel for messages of ROS 2.

#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "apps/program.h"
#include "core/base/files.h"
#include "core/types/type_info.h"
#include "plugins/application/application_description.h"
#include "plugins/manifest/plugin_manifest.h"
#include "plugins/ros_messages/message_codec.h"
#include "plugins/ros_messages/message_library.h"

namespace runnel {

namespace {

constexpr std::string_view kOwnPackage = "runnel_msgs/";

int WriteFiles(const FileTexts& files, const std::filesystem::path& folder) {
  for (const auto& [name, text] : files) {
    std::filesystem::create_directories((folder / name).parent_path());
    if (auto written = ReplaceFile(folder / name, text); !written) return Fail(written.error(), exit_code::kRunFailed);
    std::cout << (folder / name).string() << '\n';
  }
  return exit_code::kDone;
}

// The types of all ports of the plugins' modules, for which one of each is made.
Result<std::set<std::string>> TypesOf(const std::vector<std::string>& plugins, ApplicationDescription& surroundings) {
  for (const std::string& plugin : plugins) {
    if (auto loaded = surroundings.plugins().Load(plugin); !loaded) return loaded.error();
  }
  std::set<std::string> types;
  for (const ModuleType* type : surroundings.plugins().modules().All()) {
    const auto module = DescribeByMaking(surroundings.runtime(), surroundings.plugins().modules(), type->name);
    if (!module) continue;
    for (const auto& port : module->ports) types.insert(port.type);
  }
  return types;
}

int Export(const std::vector<std::string>& plugins, const std::string& folder) {
  ApplicationDescription surroundings;
  const auto types = TypesOf(plugins, surroundings);
  if (!types) return Fail(types.error());
  MessageLibrary library;
  std::vector<const MessageDefinition*> messages;
  for (const std::string& name : *types) {
    const TypeInfo* const type = FindType(name);
    if (type == nullptr) continue;  // its module has none of it in this process
    const auto made = library.AddDescribed(*type);
    if (!made) {
      std::cerr << "left out: " << made.error().message << '\n';
    } else if ((*made)->name.starts_with(kOwnPackage)) {
      messages.push_back(*made);
    }
  }
  if (messages.empty())
    return Fail(
        {.message = "these plugins have no types of their own", .hint = "name others: 'runnel modules' lists all"});
  return WriteFiles(MessagePackageOf(messages, library), folder);
}

// Of names and of files and folders; of a service, its request and its response.
Result<std::vector<const MessageDefinition*>> FindMessages(const std::vector<std::string>& wanted,
                                                           MessageLibrary& library) {
  std::set<const MessageDefinition*> found;
  for (const std::string& each : wanted) {
    if (!std::filesystem::exists(each)) continue;
    std::set<const MessageDefinition*> before;
    for (const auto* const known : library.All()) before.insert(known);
    if (auto read = library.Read(each); !read) return read.error();
    for (const auto* const known : library.All()) {
      if (!before.contains(known)) found.insert(known);
    }
  }
  for (const std::string& each : wanted) {
    if (std::filesystem::exists(each)) continue;
    const auto* const request = library.Find(each + "_Request");
    const auto* const response = library.Find(each + "_Response");
    if (request != nullptr && response != nullptr) {
      found.insert({request, response});
      continue;
    }
    auto message = library.Get(each);
    if (!message) return message.error();
    found.insert(*message);
  }
  return std::vector(found.begin(), found.end());
}

int Import(const std::vector<std::string>& wanted, const std::string& folder) {
  MessageLibrary library;
  const auto messages = FindMessages(wanted, library);
  if (!messages) return Fail(messages.error());
  const auto files = CppHeadersOf(*messages, library);
  return files ? WriteFiles(*files, folder) : Fail(files.error());
}

int Show(const std::vector<std::string>& wanted) {
  MessageLibrary library;
  const auto messages = FindMessages(wanted, library);
  if (!messages) return Fail(messages.error());
  for (const MessageDefinition* const each : *messages) {
    std::cout << "# " << each->name << ' ' << TypeHashOf(*each, library) << '\n' << TextOf(*each) << '\n';
  }
  return exit_code::kDone;
}

}  // namespace

}  // namespace runnel

int main(int count, char** words) {
  CLI::App program("Messages of ROS 2 for types of Runnel, and the other way round.", "runnel ros2");
  program.require_subcommand(1);
  std::vector<std::string> plugins, messages;
  std::string folder = ".";
  auto* const export_command =
      program.add_subcommand("export", "writes a package of ROS 2 with the types of plugins as messages");
  export_command->add_option("plugins", plugins, "whose modules have ports of these types")
      ->required()
      ->type_name("PLUGIN…");
  export_command->add_option("-o,--output", folder, "folder of the package")
      ->type_name("FOLDER")
      ->capture_default_str();
  auto* const import_command = program.add_subcommand("import", "writes C++ types for messages, which ports can carry");
  import_command
      ->add_option("messages", messages,
                   "sensor_msgs/msg/Imu; std_srvs/srv/SetBool; a .msg or .srv file; a folder of such files")
      ->required()
      ->type_name("MESSAGE…");
  import_command->add_option("-o,--output", folder, "folder of the headers")
      ->type_name("FOLDER")
      ->capture_default_str();
  auto* const show_command = program.add_subcommand("show", "shows messages, with the hash of their types");
  show_command
      ->add_option("messages", messages,
                   "sensor_msgs/msg/Imu; std_srvs/srv/SetBool; a .msg or .srv file; a folder of such files")
      ->required()
      ->type_name("MESSAGE…");
  return runnel::RunProgram(program, count, words, [&] {
    if (*export_command) return runnel::Export(plugins, folder);
    return *import_command ? runnel::Import(messages, folder) : runnel::Show(messages);
  });
}
