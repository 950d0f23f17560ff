#pragma once

#include <string>
#include <utility>

#include "core/lockfree/latest_value.h"
#include "core/port/lease.h"
#include "plugins/parameters/parameter_base.h"

namespace runnel {

/// A number, a switch, a small structure that can be changed while the module runs.
///
///     Parameter<double> stop_distance{this, "stop_distance",
///                                     {.default_value = 0.3, .bounds = {0.05, 5.0}, .unit = "m",
///                                      .description = "obstacles nearer than this stop the
///                                      robot"}};
///
/// Threads:     Get() from any thread, at any time; setting under the structure lock, which
///              SetFromText() and Set() take.
/// Progress:    Get() is lock-free and sees a whole value, the old or the new.
/// Allocation:  Get() none.
/// For texts, vectors and other large values there is StaticParameter.
template <typename T>
class Parameter final : public ParameterBase {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= 256,
                "a Parameter is copied as bytes while the module runs; "
                "for this type use StaticParameter");

 public:
  Parameter(FrameworkElement* module, std::string name, ParameterOptions<T> options = {})
      : ParameterBase(module, std::move(name), internal::InfoOf(options, false)),
        options_(std::move(options)) {
    value_.Publish(options_.default_value, 0);
  }

  [[nodiscard]] T Get() const noexcept {
    T value{};
    Publication publication;
    value_.Read(value, publication);
    return value;
  }
  /// Errors: out of bounds.
  Result<void> Set(const T& value) { return SetFromText(TextOf(value)); }

  [[nodiscard]] Result<void> CheckText(std::string_view text) const override {
    if (auto value = internal::Accept<T>(text, options_, info_); !value) return value.error();
    return {};
  }
  [[nodiscard]] std::string ToText() const override { return TextOf(Get()); }
  [[nodiscard]] const TypeInfo& type() const override { return TypeOf<T>(); }

 private:
  void Assign(std::string_view text) override {
    value_.Publish(*internal::Accept<T>(text, options_, info_), 0);
  }

  const ParameterOptions<T> options_;
  LatestValue<T> value_;
};

}  // namespace runnel
