// The command `runnel keys`: files by which applications in a network know each other and encrypt.

#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <sys/stat.h>

#include "apps/program.h"
#include "core/base/program_output.h"
#include "core/base/replace_file.h"
#include "core/base/result.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHead =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<dds xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\">\n";
constexpr std::string_view kDomains = "<domains><id_range><min>0</min><max>230</max></id_range></domains>\n";

// Everything is encrypted, and nobody without a certificate is let in.
std::string GovernanceText() {
  return std::string(kHead) + "<domain_access_rules><domain_rule>\n" + std::string(kDomains) +
         "<allow_unauthenticated_participants>false</allow_unauthenticated_participants>\n"
         "<enable_join_access_control>true</enable_join_access_control>\n"
         "<discovery_protection_kind>ENCRYPT</discovery_protection_kind>\n"
         "<liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>\n"
         "<rtps_protection_kind>SIGN</rtps_protection_kind>\n"
         "<topic_access_rules><topic_rule>\n<topic_expression>*</topic_expression>\n"
         "<enable_discovery_protection>true</enable_discovery_protection>\n"
         "<enable_liveliness_protection>true</enable_liveliness_protection>\n"
         "<enable_read_access_control>true</enable_read_access_control>\n"
         "<enable_write_access_control>true</enable_write_access_control>\n"
         "<metadata_protection_kind>ENCRYPT</metadata_protection_kind>\n"
         "<data_protection_kind>ENCRYPT</data_protection_kind>\n"
         "</topic_rule></topic_access_rules>\n</domain_rule></domain_access_rules>\n</dds>\n";
}

// An hour ago, for clocks that differ, and so many days from now.
std::string DateText(std::chrono::hours from_now) {
  const std::time_t time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now() + from_now);
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  return text.data();
}

std::string PermissionsText(const std::string& name, int days) {
  return std::string(kHead) + "<permissions><grant name=\"" + name + "\">\n<subject_name>CN=" + name +
         "</subject_name>\n" + "<validity><not_before>" + DateText(std::chrono::hours(-1)) +
         "</not_before><not_after>" + DateText(std::chrono::hours(24) * days) +
         "</not_after></validity>\n<allow_rule>\n" + std::string(kDomains) +
         "<publish><topics><topic>*</topic></topics></publish>\n<subscribe><topics><topic>*</topic></topics></"
         "subscribe>\n"
         "</allow_rule>\n<default>DENY</default>\n</grant></permissions>\n</dds>\n";
}

// The program openssl, in a folder. Errors: what it says.
Result<void> OpenSsl(const fs::path& folder, std::vector<std::string> words) {
  words.insert(words.begin(), "openssl");
  auto said = OutputOf({.words = words, .folder = folder, .keeps_complaints = true});
  if (!said) return Error{.message = said.error().message, .hint = "install the package openssl"};
  if (said->exit_code == 0) return {};
  return Error{.message = "openssl " + words[1] + " failed: " + said->text, .position = {folder.string()}};
}

const std::vector<std::string> kNewKey = {"-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes"};

std::vector<std::string> operator+(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// Writes `text` into a folder, signed by the authority that is in `authority`.
Result<void> WriteSigned(const fs::path& folder, const fs::path& authority, const std::string& name,
                         const std::string& text) {
  const std::string source = name + ".xml";
  if (auto written = ReplaceFile(folder / source, text); !written) return written;
  return OpenSsl(folder, {"smime", "-sign", "-text", "-in", source, "-out", name + ".p7s", "-signer",
                          (authority / "ca.cert.pem").string(), "-inkey", (authority / "ca.key.pem").string()});
}

Result<void> MakeFolder(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) return Error{.message = problem.message(), .position = {folder.string()}};
  return {};
}

Result<void> Copy(const fs::path& from, const fs::path& to) {
  std::error_code problem;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, problem);
  if (problem) return Error{.message = problem.message(), .position = {to.string()}};
  return {};
}

/// Makes who signs the keys of a set of applications, and what they encrypt, in a folder: ca.cert.pem, ca.key.pem and
/// governance.p7s. What is there stays. Errors: the program openssl, or the system.
Result<void> MakeAuthority(const fs::path& folder, int days) {
  if (auto made = MakeFolder(folder); !made) return made;
  std::error_code ignored;
  if (!fs::exists(folder / "ca.key.pem", ignored)) {
    const auto made =
        OpenSsl(folder, std::vector<std::string>{"req", "-x509"} + kNewKey +
                            std::vector<std::string>{"-days", std::to_string(days), "-subj", "/CN=runnel_authority",
                                                     "-keyout", "ca.key.pem", "-out", "ca.cert.pem"});
    if (!made) return made;
  }
  if (fs::exists(folder / "governance.p7s", ignored)) return {};
  return WriteSigned(folder, fs::absolute(folder), "governance", GovernanceText());
}

/// Makes the six files of one application in a folder of its name, by the authority of `folder`: those of SROS 2. False: they
/// are there, and stay. Errors: a name that is none; the program openssl, or the system.
Result<bool> MakeKeys(const fs::path& folder, const std::string& name, int days) {
  constexpr std::string_view kCharacters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if (name.empty() || name.find_first_not_of(kCharacters) != std::string::npos) {
    return Error{.message = "'" + name + "' is no name of an application", .hint = "letters, digits, _ and -"};
  }
  const fs::path own = folder / name;
  const fs::path authority = fs::absolute(folder);
  std::error_code ignored;
  if (fs::exists(own / "permissions.p7s", ignored)) return false;  // the last that is made
  if (auto made = MakeFolder(own); !made) return made.error();
  auto made =
      OpenSsl(own, std::vector<std::string>{"req", "-new"} + kNewKey +
                       std::vector<std::string>{"-subj", "/CN=" + name, "-keyout", "key.pem", "-out", "request.pem"});
  if (!made) return made.error();
  made = OpenSsl(
      own, {"x509", "-req", "-in", "request.pem", "-CA", (authority / "ca.cert.pem").string(), "-CAkey",
            (authority / "ca.key.pem").string(), "-CAcreateserial", "-days", std::to_string(days), "-out", "cert.pem"});
  if (!made) return made.error();
  fs::remove(own / "request.pem", ignored);
  for (const char* const copy : {"identity_ca.cert.pem", "permissions_ca.cert.pem"}) {
    if (made = Copy(authority / "ca.cert.pem", own / copy); !made) return made.error();
  }
  if (made = Copy(authority / "governance.p7s", own / "governance.p7s"); !made) return made.error();
  if (made = WriteSigned(own, authority, "permissions", PermissionsText(name, days)); !made) return made.error();
  return true;
}

int Make(const std::string& folder, const std::vector<std::string>& names, int days) {
  umask(S_IRWXG | S_IRWXO);  // keys are nobody else's
  if (const auto made = MakeAuthority(folder, days); !made) return Fail(made.error());
  for (const std::string& name : names) {
    const auto made = MakeKeys(folder, name, days);
    if (!made) return Fail(made.error());
    std::cout << folder << '/' << name << (*made ? "" : "  (is there already)") << '\n';
  }
  return exit_code::kDone;
}

}  // namespace

}  // namespace runnel

int main(int count, char** words) {
  CLI::App program("Makes keys by which applications in a network know each other: <security keys=\"FOLDER/NAME\"/>.",
                   "runnel keys");
  std::string folder;
  std::vector<std::string> names;
  int days = 3650;
  program.add_option("folder", folder, "of all keys; with it, who has ca.key.pem can let in others")
      ->required()
      ->type_name("FOLDER");
  program.add_option("names", names, "applications; each has a folder of its name there, to be copied to its machine")
      ->required()
      ->type_name("NAME…");
  program.add_option("--days", days, "until they are no longer valid")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  return runnel::RunProgram(program, count, words, [&] { return runnel::Make(folder, names, days); });
}
