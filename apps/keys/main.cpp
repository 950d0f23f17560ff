// The command `runnel keys`: files by which applications in a network know each other and encrypt.

#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <sys/stat.h>

#include "apps/keys/key_files.h"
#include "core/base/diagnostics.h"
#include "core/base/exception_text.h"

namespace runnel {

namespace {

constexpr int kDone = 0, kRunFailed = 1, kBadInput = 2;

int Fail(const Error& error) {
  Diagnostics diagnostics;
  diagnostics.Add(error);
  std::cerr << diagnostics.ToString();
  return kBadInput;
}

int Make(const std::string& folder, const std::vector<std::string>& names, int days) {
  umask(S_IRWXG | S_IRWXO);  // keys are nobody else's
  if (const auto made = MakeAuthority(folder, days); !made) return Fail(made.error());
  for (const std::string& name : names) {
    const auto made = MakeKeys(folder, name, days);
    if (!made) return Fail(made.error());
    std::cout << folder << '/' << name << (*made ? "" : "  (is there already)") << '\n';
  }
  return kDone;
}

}  // namespace

}  // namespace runnel

int main(int count, char** words) {
  CLI::App program("Makes keys by which applications in a network know each other: <security keys=\"FOLDER/NAME\"/>.", "runnel keys");
  std::string folder;
  std::vector<std::string> names;
  int days = 3650;
  program.add_option("folder", folder, "of all keys; with it, who has ca.key.pem can let in others")->required()->type_name("FOLDER");
  program.add_option("names", names, "applications; each has a folder of its name there, to be copied to its machine")
      ->required()
      ->type_name("NAME…");
  program.add_option("--days", days, "until they are no longer valid")->capture_default_str()->check(CLI::PositiveNumber);
  try {
    program.parse(count, words);
    return runnel::Make(folder, names, days);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::Error& error) {
    std::cerr << "error: " << error.what() << "; see 'runnel keys --help'\n";
    return runnel::kBadInput;
  } catch (...) {
    std::cerr << "error: " << runnel::DescribeException() << '\n';
    return runnel::kRunFailed;
  }
}
