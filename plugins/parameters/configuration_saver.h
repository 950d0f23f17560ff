#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/element/annotation.h"
#include "core/element/framework_element.h"

namespace runnel {

/// Kept with an application: the configuration files that it was loaded with, as they were.
struct ConfigurationSource final : Annotation {
  struct File {
    std::filesystem::path file;
    std::string text;
  };
  std::vector<File> files = {};
};

/// Writes values of parameters that have changed since they were loaded back to the entries of the configuration that
/// they came from, or could come from: what else is in the files stays, byte for byte. Entries that there are none of
/// yet are added to the file that was loaded last. Saving the application leaves these values to the configuration
/// from then on.
///
/// With a `to`, all values that entries may set are written to that file, anew, and the others stay as they are.
///
/// Threads: any outside of cycles; holds the structure lock.
/// Errors:  the application names no entries; there is no configuration file, and no `to`; a file is not what was
///          loaded; a value that no file can carry. Each file is written at once or not at all.
///
/// `loaded`: what the parameters that files name came to when they were loaded, by their paths; the default for others.
/// What has been written is put in there, so that nobody else takes it for changed any more.
/// Returns what was done, for a person.
using LoadedValues = std::map<std::string, std::string, std::less<>>;
[[nodiscard]] Result<std::string> SaveConfiguration(FrameworkElement& application,
                                                    LoadedValues& loaded,
                                                    const std::filesystem::path& to = {});

}  // namespace runnel
