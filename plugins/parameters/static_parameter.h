#pragma once

#include <memory>
#include <string>
#include <utility>

#include "plugins/parameters/parameter_base.h"

namespace runnel {

/// A value of any describable type that is settled once the module is ready: a file name, the
/// number of rays, a list of points.
///
/// Threads:  Get() from Prepare() on, from any thread; it never changes afterwards.
template <typename T>
class StaticParameter final : public ParameterBase {
 public:
  /// Errors: throws ElementError if the default value is out of the bounds.
  StaticParameter(FrameworkElement* module, std::string name, const ParameterOptions<T>& options = {})
      : ParameterBase(module, std::move(name), internal::DescriptionOf(options, true), &options.default_value),
        value_(options.default_value) {}

  [[nodiscard]] const T& Get() const noexcept { return value_; }
  /// Errors: out of bounds; the module is ready, or its ports have been made by the value before.
  Result<void> Set(const T& value) { return Put({std::make_shared<const T>(value)}); }

  [[nodiscard]] std::shared_ptr<void> Value() const override { return std::make_shared<T>(value_); }

 private:
  bool Assign(const void* value) override {
    value_ = *static_cast<const T*>(value);
    return true;
  }

  T value_;
};

}  // namespace runnel
