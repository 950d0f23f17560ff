#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/element/annotation.h"
#include "core/element/runtime.h"

namespace runnel {

/// What extensions show to clients that ask for it by a name: kept with the application, under the structure lock, as long as
/// the extension is there.
struct ExtensionTexts final : Annotation {
  /// For an argument, "" for none. Called under the structure lock, and must not wait: nothing means that it is not there
  /// yet, and may be asked for again in a while. `asking` is the asker's, at first nullptr: what the text remembers of it. Whoever
  /// asks no more lets it go, by any thread, and the text then takes back what it has begun.
  using Text =
      std::function<Result<std::optional<std::string>>(const std::string& argument, std::shared_ptr<void>& asking)>;
  std::map<std::string, Text> texts;
  /// Whoever asks for "command" is told after so long that it has failed, not sooner.
  static constexpr Duration kFarPatience = std::chrono::seconds(10);

  /// nullptr: no extension shows it.
  [[nodiscard]] static const Text* Find(Runtime& runtime, const std::string& name) {
    for (FrameworkElement* const each : runtime.root().children()) {
      auto* const known = each->FindAnnotation<ExtensionTexts>();
      if (known == nullptr) continue;
      if (const auto found = known->texts.find(name); found != known->texts.end()) return &found->second;
    }
    return nullptr;
  }
};

}  // namespace runnel
