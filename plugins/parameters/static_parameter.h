#pragma once

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
  StaticParameter(FrameworkElement* module, std::string name, ParameterOptions<T> options = {})
      : ParameterBase(module, std::move(name), internal::InfoOf(options, true)),
        options_(std::move(options)),
        value_(options_.default_value) {}

  [[nodiscard]] const T& Get() const noexcept { return value_; }

  [[nodiscard]] Result<void> CheckText(std::string_view text) const override {
    if (auto value = internal::Accept<T>(text, options_, info_); !value) return value.error();
    return {};
  }
  [[nodiscard]] std::string ToText() const override { return TextOf(value_); }
  [[nodiscard]] const TypeInfo& type() const override { return TypeOf<T>(); }

 private:
  void Assign(std::string_view text) override {
    value_ = *internal::Accept<T>(text, options_, info_);
  }

  const ParameterOptions<T> options_;
  T value_;
};

}  // namespace runnel
