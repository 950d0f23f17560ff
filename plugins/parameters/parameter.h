#pragma once

#include <memory>
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
///              SetFrom(), SetFromText() and Set() take.
/// Progress:    Get() is lock-free and sees a whole value, the old or the new.
/// Allocation:  Get() none.
/// For texts, vectors and other large values there is StaticParameter.
template <typename T>
class Parameter final : public ParameterBase {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= 256,
                "a Parameter is copied as bytes while the module runs; "
                "for this type use StaticParameter");

 public:
  /// Errors: throws ElementError if the default value is out of the bounds.
  Parameter(FrameworkElement* module, std::string name, const ParameterOptions<T>& options = {})
      : ParameterBase(module, std::move(name), internal::DescriptionOf(options, false),
                      &options.default_value) {
    value_.Publish(options.default_value, 0);
  }

  [[nodiscard]] T Get() const noexcept {
    T value{};
    Publication publication;
    value_.Read(value, publication);
    return value;
  }
  /// Errors: out of bounds.
  Result<void> Set(const T& value) { return SetFrom(&value); }

  [[nodiscard]] std::shared_ptr<void> Value() const override { return std::make_shared<T>(Get()); }

 private:
  void Assign(const void* value) override { value_.Publish(*static_cast<const T*>(value), 0); }

  LatestValue<T> value_;
};

}  // namespace runnel
