#pragma once

#include <functional>

#include "apps/runnel/command_line.h"
#include "core/base/diagnostics.h"
#include "core/element/runtime.h"
#include "core/plugin/plugin_manager.h"
#include "plugins/parameters/configuration.h"
#include "plugins/runtime_construction/application_builder.h"

namespace runnel::program {

/// What each command works with: an empty runtime, and what can be put into it.
class Workplace {
 public:
  Workplace();

  using BeforeReady = std::function<Result<void>(FrameworkElement& application)>;

  /// Builds the application with its configuration files and settings; says on stderr what is wrong
  /// and what is doubtful. `application` of the outcome is nullptr where the mode leaves none.
  [[nodiscard]] BuildOutcome Build(const ApplicationArguments& arguments, BuildMode mode,
                                   BeforeReady before_ready = {});

  [[nodiscard]] Runtime& runtime() noexcept { return runtime_; }
  [[nodiscard]] PluginManager& plugins() noexcept { return plugins_; }
  [[nodiscard]] XmlTagRegistry& tags() noexcept { return tags_; }

 private:
  void ReadConfiguration(const ApplicationArguments& arguments, Diagnostics& diagnostics);

  PluginManager plugins_;
  XmlTagRegistry tags_;
  Configuration configuration_;
  Runtime runtime_;  // last, for modules may still use what plugins gave them
};

}  // namespace runnel::program
