// The commands `runnel generate` and, for descriptions of components, `runnel check`.

#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>

#include "apps/generate/package_flags.h"
#include "plugins/genom_description/description_json.h"

namespace runnel {

namespace {

constexpr int kDone = 0, kFailed = 1, kBadInput = 2;

struct Arguments {
  std::string what;
  std::vector<std::string> files = {};
  std::string output = {};
  genom::PreprocessorOptions options = {};
};

// For each file by itself, as `runnel check` does with applications.
int Check(const Arguments& arguments) {
  std::size_t errors = 0;
  for (const std::string& file : arguments.files) {
    Diagnostics diagnostics;
    (void)genom::ReadDescription({file}, arguments.options, diagnostics);
    std::cerr << diagnostics.ToString();
    errors += diagnostics.errors().size();
    if (diagnostics.ok()) std::cout << file << ": no errors\n" << std::flush;
  }
  if (errors == 0) return kDone;
  std::cerr << errors << (errors == 1 ? " error\n" : " errors\n");
  return kBadInput;
}

int Write(const std::string& text, const std::string& file) {
  if (file.empty()) {
    std::cout << text << std::flush;
    return std::cout ? kDone : kFailed;
  }
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << text << std::flush;
  if (stream) return kDone;
  std::cerr << "error: " << file << " cannot be written\n";
  return kFailed;
}

int Generate(const Arguments& arguments) {
  if (arguments.what == "check") return Check(arguments);
  Diagnostics diagnostics;
  const auto description = genom::ReadDescription(arguments.files, arguments.options, diagnostics);
  std::cerr << diagnostics.ToString();
  if (!diagnostics.ok()) return kBadInput;
  return Write(genom::DescriptionJson(*description) + "\n", arguments.output);
}

}  // namespace

}  // namespace runnel

int main(int count, char** words) {
  CLI::App program("Makes something of descriptions of components (GenoM3).", "runnel generate");
  runnel::Arguments arguments;
  arguments.options.flags_of_package = runnel::FlagsOfPackage;
  program.add_option("template", arguments.what, "json: all that the description says; check: nothing but what is wrong with it")
      ->required()
      ->check(CLI::IsMember({"check", "json"}));
  program.add_option("files", arguments.files, "read as one, in order")->required()->type_name("FILE.gen");
  program.add_option("-I", arguments.options.include_folders, "look there for included files")
      ->type_name("FOLDER")->allow_extra_args(false);
  program.add_option("-D", arguments.options.definitions, "define a macro")->type_name("NAME[=VALUE]")->allow_extra_args(false);
  program.add_option("-o,--output", arguments.output, "instead of standard output")->type_name("FILE");
  try {
    program.parse(count, words);
    return runnel::Generate(arguments);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "; see 'runnel generate --help'\n";
    return runnel::kBadInput;
  }
}
