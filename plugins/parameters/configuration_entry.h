#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/element/annotation.h"

namespace runnel {

/// Kept with a parameter that an entry of the configuration may set: which one.
struct ConfigurationEntry final : Annotation {
  explicit ConfigurationEntry(std::string entry) : path(std::move(entry)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<ConfigurationEntry>(path);
  }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
  std::string path;  ///< "/safety/distance"
};

/// Kept with a module or group: what of the configuration is for all parameters within.
struct ConfigurationSection final : Annotation {
  ConfigurationSection(std::string section, std::string as_said)
      : path(std::move(section)), said(std::move(as_said)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<ConfigurationSection>(path, said);
  }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
  std::string path;  ///< "/car/left"
  std::string said;  ///< how the file has it: "left", in the section "/car"
};

}  // namespace runnel
