#pragma once

#include <memory>

namespace runnel {

/// Something that a plugin keeps with a framework element without the core knowing its type: derive
/// from it, hand it to FrameworkElement::Annotate(), get it back with FindAnnotation<T>().
class Annotation {
 public:
  virtual ~Annotation() = default;
  /// What an element that stands for this one from now on is to be annotated with (it replaces it, has another name,
  /// is made again by an undo); nullptr: with nothing, or with what it brings itself.
  [[nodiscard]] virtual std::unique_ptr<Annotation> ForReplacement() const { return nullptr; }
  /// The same of an element like this one, at another place. Nothing of what is said of the place in a file.
  [[nodiscard]] virtual std::unique_ptr<Annotation> ForCopy() const { return ForReplacement(); }
};

}  // namespace runnel
