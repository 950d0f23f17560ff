#pragma once

#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/element/annotation.h"
#include "core/element/framework_element.h"

namespace runnel {

/// Kept with every element that an application file has made: where in the file it stands, so that
/// faults that show only later can name the place.
struct SourcePlace final : Annotation {
  explicit SourcePlace(SourcePosition at) : position(std::move(at)) {}
  SourcePosition position;
};

/// Of the element, or of the nearest one above it that has a place; unknown if there is none.
[[nodiscard]] inline SourcePosition FindSourcePlace(const FrameworkElement& element) {
  for (const FrameworkElement* at = &element; at != nullptr; at = at->parent()) {
    if (const auto* place = at->FindAnnotation<SourcePlace>()) return place->position;
  }
  return {};
}

/// How an element was called before. Files may still use it.
struct FormerName final : Annotation {
  explicit FormerName(std::string text) : name(std::move(text)) {}
  const std::string name;
};

/// Kept with elements that no tag of their own stands for: whoever saves the application passes them
/// by, with all that is below them. What they hold is either made again by other tags, or no part of
/// the application.
struct NotSaved final : Annotation {};

}  // namespace runnel
