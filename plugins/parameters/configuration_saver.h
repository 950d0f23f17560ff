#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/element/annotation.h"
#include "core/element/framework_element.h"
#include "plugins/parameters/configuration.h"

namespace runnel {

/// Kept with an application: the configuration files that it was loaded with, as they were.
struct ConfigurationSource final : Annotation {
  std::vector<Configuration::File> files = {};
};

/// Kept with a parameter that a file names, or the configuration: what it came to when these were read, or written last,
/// in text format. It may be from the command line; as long as it stays so, it is not the file's business.
struct LoadedValue final : Annotation {
  explicit LoadedValue(std::string value) : text(std::move(value)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<LoadedValue>(text);
  }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
  const std::string text;

  /// nullptr: nothing has named it.
  [[nodiscard]] static const std::string* Of(const FrameworkElement& parameter) {
    const auto* const known = parameter.FindAnnotation<LoadedValue>();
    return known != nullptr ? &known->text : nullptr;
  }
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
/// Returns what was done, for a person.
[[nodiscard]] Result<std::string> SaveConfiguration(FrameworkElement& application,
                                                    const std::filesystem::path& to = {});

}  // namespace runnel
