#pragma once

namespace runnel {

/// Something that a plugin keeps with a framework element without the core knowing its type: derive
/// from it, hand it to FrameworkElement::Annotate(), get it back with FindAnnotation<T>().
class Annotation {
 public:
  virtual ~Annotation() = default;
};

}  // namespace runnel
