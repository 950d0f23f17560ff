#pragma once

#include <memory>

namespace runnel {

/// Something that a plugin keeps with a framework element without the core knowing its type: derive
/// from it, hand it to FrameworkElement::Annotate(), get it back with FindAnnotation<T>().
class Annotation {
 public:
  virtual ~Annotation() = default;
  /// What an element that replaces this one, under the same path, is to be annotated with; nullptr: with
  /// nothing, or with what it brings itself.
  [[nodiscard]] virtual std::unique_ptr<Annotation> ForReplacement() const { return nullptr; }
};

}  // namespace runnel
