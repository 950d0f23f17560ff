#pragma once

#include <memory>

#include "core/element/annotation.h"
#include "core/element/framework_element.h"

namespace runnel::internal {

/// That somebody has paused the element, or lets it run again. It goes along with the element's other annotations.
struct PauseMark final : Annotation {
  explicit PauseMark(bool is_it) : is_paused(is_it) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<PauseMark>(is_paused);
  }
  /// Not of what is above it.
  [[nodiscard]] static bool IsAt(const FrameworkElement& element) {
    const auto* const mark = element.FindAnnotation<PauseMark>();
    return mark != nullptr && mark->is_paused;
  }

  const bool is_paused;
};

}  // namespace runnel::internal
