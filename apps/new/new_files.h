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

/// A template with what its marks (@name@) stand for.
[[nodiscard]] std::string FilledTemplate(const std::string& name,
                                         const std::map<std::string, std::string>& marks);

/// Writes all of the files, or none; folders are made. Errors: one is there already, or cannot be written.
Result<void> WriteAll(const std::vector<NewFile>& files);

}  // namespace runnel::new_program
