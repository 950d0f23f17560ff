// The command `runnel new`: writes what a plugin, module, application or test begins with.

#include <algorithm>
#include <iostream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "apps/new/new_files.h"
#include "apps/program.h"
#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "core/base/result.h"
#include "core/plugin/plugin_manager.h"

namespace runnel::new_program {

namespace {

// Names that the project's files or targets have already.
const std::set<std::string> kTaken{"all", "build", "clean", "install", "main", "plugin", "runnel", "test", "world"};

/// Whether something can be called so, in files, in C++ and in paths: "wall_follower". Errors: why not, and a name
/// that would do.
Result<void> CheckName(const std::string& name) {
  const bool is_well_formed = IsSnakeCase(name);
  const char* const why = !is_well_formed
                              ? "': names are lower-case letters, digits and single '_', and begin with a letter"
                          : IsCppKeyword(name)    ? "', which is a word of C++"
                          : kTaken.contains(name) ? "', which is the name of something else in each project"
                                                  : nullptr;
  if (why == nullptr) return {};
  std::string proposal = is_well_formed ? "" : SnakeCase(name);
  proposal.erase(0, proposal.find_first_not_of("0123456789_"));
  return Error{.message = "nothing can be called '" + name + why,
               .hint = proposal.empty() ? "" : "how about '" + proposal + "'?"};
}

namespace fs = std::filesystem;

/// What is to be made, and where.
struct Wanted {
  std::string name;
  fs::path folder;
};

/// One kind of thing that is made. @name@, @Class@, @plugin@ and @folder@ stand for what is called so.
struct Kind {
  std::string_view name;
  const char* summary;
  bool is_of_plugin;  ///< goes into the folder of a plugin; else it has a folder of its name
  std::vector<std::pair<const char*, const char*>> files;  ///< and by which templates
  const char* said;                                        ///< how to go on
};
const std::vector<Kind> kKinds{{"plugin",
                                "a folder with a plugin: one module, its test, an application with it",
                                false,
                                {{"CMakeLists.txt", "plugin_CMakeLists.txt"},
                                 {"plugin.cpp", "plugin.cpp"},
                                 {"@name@.h", "module.h"},
                                 {"@name@_test.cpp", "test.cpp"},
                                 {"@name@.xml", "plugin_application.xml"}},
                                "cd @folder@\ncmake -B build && cmake --build build && ctest --test-dir build\n"
                                "RUNNEL_PLUGIN_PATH=build/lib/runnel/plugins runnel run @name@.xml --duration 5\n"},
                               {"module",
                                "one more module of the plugin in this folder, and its test",
                                true,
                                {{"@name@.h", "module.h"}, {"@name@_test.cpp", "test.cpp"}},
                                "plugin.cpp registers it as @plugin@/@name@\n"},
                               {"application",
                                "a folder with a robot in a world, a program that runs it, and a test",
                                false,
                                {{"CMakeLists.txt", "application_CMakeLists.txt"},
                                 {"@name@.xml", "application.xml"},
                                 {"world.xml", "world.xml"},
                                 {"main.cpp", "main.cpp"},
                                 {"@name@_test.cpp", "application_test.cpp"}},
                                "runnel run @folder@/@name@.xml --inspect\n"},
                               {"test",
                                "a test for a module of the plugin in this folder",
                                true,
                                {{"@name@_test.cpp", "own_test.cpp"}},
                                "@name@_test.cpp tests modules of the type @plugin@/@name@\n"}};

// What is to be printed.
Result<std::string> MakeFiles(const Kind& kind, const Wanted& wanted) {
  if (auto good = CheckName(wanted.name); !good) return good.error();
  auto plugin = kind.is_of_plugin ? OwnPlugin::Find(wanted.folder) : OwnPlugin();
  if (!plugin) return plugin.error();
  if (kind.name == "plugin" && std::ranges::count(PluginManager().Available(), wanted.name) > 0) {
    return Error{.message = "there is a plugin '" + wanted.name + "' already, and of two of one name only one is found",
                 .hint = "take another name"};
  }
  const fs::path folder = kind.is_of_plugin ? wanted.folder : wanted.folder / wanted.name;
  const Marks marks{{"name", wanted.name},
                    {"Class", CamelCase(wanted.name)},
                    {"plugin", kind.is_of_plugin ? plugin->name() : wanted.name},
                    {"folder", folder.string()}};
  std::vector<NewFile> files;
  for (const auto& [file, text] : kind.files) {
    files.push_back({folder / Filled(file, marks), Filled(Templates().at(text), marks)});
  }
  auto made = WriteAll(files);
  if (made && kind.name == "module") {
    made = plugin->Register(wanted.name + ".h", marks.at("Class"), plugin->name() + "/" + wanted.name);
  }
  return made ? Filled(kind.said, marks) : Result<std::string>(made.error());
}

int Make(const Kind& kind, const Wanted& wanted) {
  const auto made = MakeFiles(kind, wanted);
  if (!made) return Fail(made.error());
  std::cout << *made << std::flush;
  return std::cout ? exit_code::kDone : exit_code::kRunFailed;
}

int Main(int count, char** words) {
  CLI::App program("Writes what something new begins with: it can be built and tested at once.", "runnel new");
  Wanted wanted;
  program.require_subcommand(1);
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) {
    CLI::App& command = *program.add_subcommand(std::string(kind.name), kind.summary);
    command.add_option("name", wanted.name, "lower-case letters, digits and '_'")->required()->type_name("NAME");
    command.add_option("--in", wanted.folder, "the folder in which it is made; without, this one")->type_name("FOLDER");
    names.emplace_back(kind.name);
  }
  const std::string wanted_kind = count > 1 ? words[1] : "";
  const bool is_known = std::ranges::find(names, wanted_kind) != names.end();
  if (count > 1 && !wanted_kind.starts_with('-') && !is_known) {
    const std::string hint = NearestNameHint(wanted_kind, names);
    std::cerr << "error: there is no new '" << wanted_kind << "'; "
              << (hint.empty() ? "plugin, module, application or test" : hint) << '\n';
    return exit_code::kBadInput;
  }
  return RunProgram(program, count, words, [&] {
    const auto is_chosen = [&](const Kind& kind) { return program.got_subcommand(std::string(kind.name)); };
    return Make(*std::ranges::find_if(kKinds, is_chosen), wanted);
  });
}

}  // namespace

}  // namespace runnel::new_program

int main(int count, char** words) { return runnel::new_program::Main(count, words); }
