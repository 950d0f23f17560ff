#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// An option of the command line, as `runnel run` has it: "--record FILE.mcap".
struct ExtensionOption {
  enum class Kind {
    kFlag,           ///< --name
    kOptionalValue,  ///< --name or --name=VALUE
    kValue,          ///< --name VALUE
    kList,           ///< the same, again and again
    kArgument,       ///< VALUE, before the application file
  };
  std::string name;
  Kind kind = Kind::kFlag;
  std::string value_name = {};
  std::string summary = {};  ///< one line
  std::string command = {};  ///< only of this one; "": of all that run an application
  /// A library that must be in the process from its start if the option is given, as a path; "": none.
  std::string preload = {};
  /// The value is a file that is written, another one for each run.
  bool is_output = false;
};

/// The file that a further run of the same program writes instead of `file`: run_2.mcap, or the first that is free.
[[nodiscard]] std::string FileOfNextRun(const std::string& file);

/// What a plugin adds to applications that can do without it, known before its library is loaded: the file
/// <name>.extension.xml beside <name>.so. It may be there although the library is not installed.
///
///     <extension summary="records what ports publish, and plays it again">
///       <tag name="recording"/>                      words of application files
///       <command name="record"/>                     what `runnel` or its clients can do by it
///       <option name="record" kind="value" value="FILE.mcap" summary="records what ports publish"/>
///     </extension>
struct ExtensionDescription {
  std::string name;
  std::string summary;  ///< one line
  std::vector<std::string> tags = {};
  std::vector<std::string> commands = {};
  std::vector<ExtensionOption> options = {};
};

/// The extensions that are described in the folders of plugins.
class ExtensionCatalogue {
 public:
  /// The first description of a name is the one. Errors: a file is no description, with its place.
  static Result<ExtensionCatalogue> Read(const std::vector<std::filesystem::path>& folders);

  /// Sorted by name.
  [[nodiscard]] const std::vector<ExtensionDescription>& all() const noexcept { return all_; }
  // nullptr if there is none.
  [[nodiscard]] const ExtensionDescription* Find(std::string_view name) const;
  [[nodiscard]] const ExtensionDescription* FindTag(std::string_view tag) const;
  [[nodiscard]] const ExtensionDescription* FindCommand(std::string_view command) const;

 private:
  std::vector<ExtensionDescription> all_;
};

}  // namespace runnel
