#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/element/annotation.h"

namespace runnel {

/// Kept with an application that came from a file: what the file said, so that it can be saved again
/// with what has changed, and with nothing else.
struct ApplicationSource final : Annotation {
  std::filesystem::path file;
  std::string text;  ///< of the file, byte for byte
  /// Of the files that describe the inside of its groups, by the names that errors have for them.
  std::map<std::string, std::string> parts;
  /// What the parameters that the file names came to, by their paths, in text format. It may be from
  /// the command line or a configuration; as long as it stays so, it is not the file's business.
  std::map<std::string, std::string, std::less<>> values;
};

}  // namespace runnel
