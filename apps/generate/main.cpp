// The commands `runnel generate` and, for descriptions of components, `runnel check`.

#include <array>
#include <map>

#include "apps/generate/component_check.h"
#include "apps/program.h"
#include "core/base/characters.h"
#include "core/base/program_output.h"
#include "plugins/genom_description/description.h"
#include "plugins/genom_templates/template_run.h"

namespace runnel {

namespace {

struct Arguments {
  std::string what;
  std::vector<std::string> files = {};
  std::string output = {};
  bool overwrites = false;
  bool adopts = false;
  std::vector<std::string> settings = {};  // NAME=VALUE, for the template
  std::string dependencies = {};
  bool has_spin_check = false;
  genom::PreprocessorOptions options = {};
};

// What pkg-config says.
Result<std::vector<std::string>> FlagsOfPackage(const std::string& package) {
  const auto answer = OutputOf({.words = {"pkg-config", "--cflags", package}});
  if (!answer || answer->exit_code != 0) {
    return Error{.message = "pkg-config knows no package '" + package + "'",
                 .hint = "install it, or say by PKG_CONFIG_PATH where its .pc file is"};
  }
  const auto flags = PartsBetween(" \t\r\n", answer->text);
  return std::vector<std::string>(flags.begin(), flags.end());
}

// For each file by itself, as `runnel check` does with applications.
int Check(const Arguments& arguments) {
  std::size_t errors = 0;
  for (const std::string& file : arguments.files) {
    Diagnostics diagnostics;
    const auto description = genom::ReadDescription({file}, arguments.options, diagnostics);
    if (diagnostics.ok() && arguments.has_spin_check) CheckBySpin(genom::DescriptionJson(*description), diagnostics);
    std::cerr << diagnostics.ToString();
    errors += diagnostics.errors().size();
    if (diagnostics.ok()) std::cout << file << ": no errors\n" << std::flush;
  }
  if (errors == 0) return exit_code::kDone;
  std::cerr << errors << (errors == 1 ? " error\n" : " errors\n");
  return exit_code::kBadInput;
}

// By WrittenFile::What.
constexpr std::array kWhats{"new", "as it was", "made anew", "merged with your changes",
                            "in conflict with your changes"};

// What make and ninja want to know: of what the made files depend.
std::string DependenciesText(const std::string& target, const std::vector<std::string>& files) {
  std::string text = target + ":";
  for (const std::string& file : files) {
    text += " \\\n  ";
    for (const char c : file) text += c == ' ' ? std::string("\\ ") : std::string(1, c);
  }
  return text + "\n";
}

std::map<std::string, std::string> Settings(const Arguments& arguments) {
  std::map<std::string, std::string> settings;
  for (const std::string& each : arguments.settings) {
    const std::size_t equals = each.find('=');
    settings[each.substr(0, equals)] = equals == std::string::npos ? "" : each.substr(equals + 1);
  }
  return settings;
}

int RunTemplate(const Arguments& arguments, const genom::Description& description) {
  const auto folder = genom::FindTemplate(arguments.what);
  if (!folder) return Fail(folder.error());
  const auto made = genom::RunTemplate(*folder, genom::DescriptionJson(description), Settings(arguments));
  if (!made) return Fail(made.error());
  if (made->files.empty()) {
    return Fail({.message = "template '" + arguments.what + "' makes nothing of this",
                 .position = {arguments.files.front()},
                 .hint = "does it describe a component?"});
  }
  Diagnostics diagnostics;
  const std::string output = arguments.output.empty() ? "." : arguments.output;
  int conflicts = 0;
  const auto what_is_there = arguments.overwrites ? genom::WhatIsThere::kIsOverwritten
                             : arguments.adopts   ? genom::WhatIsThere::kIsAdopted
                                                  : genom::WhatIsThere::kIsMerged;
  for (const auto& file : genom::WriteFiles(output, made->files, what_is_there, diagnostics)) {
    std::cout << file.path << ": " << kWhats[static_cast<std::size_t>(file.what)] << "\n";
    conflicts += file.conflicts;
  }
  std::cout << std::flush;
  std::cerr << diagnostics.ToString();
  if (!diagnostics.ok()) return exit_code::kBadInput;
  if (!arguments.dependencies.empty()) {
    std::vector<std::string> files = description.problems.files();
    files.insert(files.end(), made->sources.begin(), made->sources.end());
    std::string target = output;
    target += "/" + made->files.front().path;
    const int failed = WriteText(DependenciesText(target, files), arguments.dependencies);
    if (failed != exit_code::kDone) return failed;
  }
  if (conflicts == 0) return exit_code::kDone;
  std::cerr << conflicts << (conflicts == 1 ? " place" : " places")
            << " to look at: between <<<<<<< and >>>>>>> stand your lines and those of the template\n";
  return exit_code::kRunFailed;
}

int Generate(const Arguments& arguments) {
  if (arguments.what == "check") return Check(arguments);
  Diagnostics diagnostics;
  const auto description = genom::ReadDescription(arguments.files, arguments.options, diagnostics);
  std::cerr << diagnostics.ToString();
  if (!diagnostics.ok()) return exit_code::kBadInput;
  if (arguments.what != "json") return RunTemplate(arguments, *description);
  return WriteText(genom::DescriptionJson(*description) + "\n", arguments.output);
}

std::string KnownTemplates() {
  std::string names = "json: all that the description says; check: nothing but what is wrong with it";
  for (const std::string& each : genom::TemplateNames()) names += "; " + each;
  return names + "; or a folder with a file template.lua";
}

}  // namespace

}  // namespace runnel

int main(int count, char** words) {
  CLI::App program("Makes something of descriptions of components (GenoM3).", "runnel generate");
  runnel::Arguments arguments;
  arguments.options.flags_of_package = runnel::FlagsOfPackage;
  program.add_option("template", arguments.what, runnel::KnownTemplates())->required();
  program.add_option("files", arguments.files, "read as one, in order")->required()->type_name("FILE.gen");
  program.add_option("-I", arguments.options.include_folders, "look there for included files")
      ->type_name("FOLDER")
      ->allow_extra_args(false);
  program.add_option("-D", arguments.options.definitions, "define a macro")
      ->type_name("NAME[=VALUE]")
      ->allow_extra_args(false);
  program.add_option("-o,--output", arguments.output, "the file, of json; the folder, of others (otherwise this one)")
      ->type_name("PATH");
  auto* const overwrites = program.add_flag("--overwrite", arguments.overwrites, "also what you have changed");
  program
      .add_flag(
          "--adopt", arguments.adopts,
          "a component that was not made here: its files stay, later changes of the description are merged into them")
      ->excludes(overwrites);
  program.add_option("-s,--set", arguments.settings, "for the template")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  program.add_flag("--spin", arguments.has_spin_check,
                   "of check: have the model checker Spin look for what threads and interruptions can come to");
  program.add_option("--depfile", arguments.dependencies, "say there what has been read, for make and ninja")
      ->type_name("FILE");
  return runnel::RunProgram(program, count, words, [&] { return runnel::Generate(arguments); });
}
