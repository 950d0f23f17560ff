#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/element/annotation.h"
#include "core/element/framework_element.h"

namespace runnel {

/// Kept with an element that has been renamed: what the file of its application still calls it. Saving has the file
/// call it as it is called now.
struct NameInFile final : Annotation {
  explicit NameInFile(std::string called) : name(std::move(called)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<NameInFile>(name);
  }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
  std::string name;

  /// Of any element.
  [[nodiscard]] static const std::string& Of(const FrameworkElement& element) {
    const auto* const known = element.FindAnnotation<NameInFile>();
    return known != nullptr ? known->name : element.name();
  }
  /// `made` stands for what has been called as `before` is.
  static void Note(FrameworkElement& made, const FrameworkElement& before) {
    if (Of(before) != made.name()) made.Annotate(std::make_unique<NameInFile>(Of(before)));
  }
};

}  // namespace runnel
