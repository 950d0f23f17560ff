#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel::new_program {

/// A file that is not there yet.
struct NewFile {
  std::filesystem::path path;
  std::string text;
};

using Marks = std::map<std::string, std::string>;
/// A template with what its marks (@name@) stand for.
[[nodiscard]] std::string Filled(std::string text, const Marks& marks);

/// Writes all of the files, or none; folders are made. Errors: one is there already, or cannot be written.
Result<void> WriteAll(const std::vector<NewFile>& files);

/// The plugin of the project in a folder: the file plugin.cpp in which its modules are registered.
class OwnPlugin {
 public:
  /// Errors: there is none, or it does not look like one.
  [[nodiscard]] static Result<OwnPlugin> Find(const std::filesystem::path& folder);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// Has it register a module, in the file too. Errors: as ReplaceFile().
  Result<void> Register(const std::string& header, const std::string& class_name, const std::string& type);

 private:
  std::filesystem::path file_;
  std::string text_;
  std::string name_;
  std::string registry_;      // as the file calls it
  std::size_t body_ = 0;      // behind the '{' of the registration
  std::size_t includes_ = 0;  // behind the last of them
};

/// What the files of templates/ say, by their names without ".in".
[[nodiscard]] const std::map<std::string, std::string>& Templates();

}  // namespace runnel::new_program
