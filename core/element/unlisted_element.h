#pragma once

#include <memory>
#include <utility>

#include "core/element/framework_element.h"

namespace runnel {

/// An element, with all below it, that is not in the tree: not yet, or no longer. Nobody finds it by
/// its path, and no executor runs it; it knows the place where it belongs.
///
/// Ownership:  owns the element. Who destroys one that has been in the tree must know that no thread
///             can still see it: Runtime::Destroy().
/// Threads:    one at a time.
class UnlistedElement {
 public:
  UnlistedElement() = default;
  explicit UnlistedElement(std::unique_ptr<FrameworkElement> element) : element_(std::move(element)) {}
  ~UnlistedElement() { Reset(); }
  UnlistedElement(UnlistedElement&&) = default;
  UnlistedElement& operator=(UnlistedElement&& other) noexcept {
    if (this != &other) {
      Reset();
      element_ = std::move(other.element_);
    }
    return *this;
  }

  [[nodiscard]] FrameworkElement* get() const noexcept { return element_.get(); }
  [[nodiscard]] FrameworkElement& operator*() const noexcept { return *element_; }
  [[nodiscard]] FrameworkElement* operator->() const noexcept { return element_.get(); }
  [[nodiscard]] explicit operator bool() const noexcept { return element_ != nullptr; }

 private:
  friend class Runtime;
  // What was made last goes first, as in the tree.
  void Reset() noexcept {
    if (element_) element_->DestroyOwned();
    element_.reset();
  }

  std::unique_ptr<FrameworkElement> element_;
};

}  // namespace runnel
