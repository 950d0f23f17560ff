#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/base/result.h"
#include "core/element/configurable.h"
#include "core/element/framework_element.h"
#include "core/types/type_of.h"
#include "plugins/parameters/cycle_lock.h"

namespace runnel {

/// A number with a unit, "15 cm", as text of the same number in another unit: "0.15" in "m". A number
/// without a unit is returned as it is, and so is a text that is no number; whoever reads it says why.
///
/// Units: m, s, min, h, rad, deg, °, rpm, Hz, g, t, N, J, W, Pa, A, V, K, %, with the prefixes k, M, G, d, c,
/// m, u, µ, n where they are usual; products and quotients of them with whole exponents: "m/s^2", "m/s²",
/// "N*m", "1/s". Any other unit of a parameter is taken when it is written just so.
///
/// Errors: a unit that is none, or one of something else than `unit`; the hint names `unit`.
[[nodiscard]] Result<std::string> NumberInUnit(std::string_view text, std::string_view unit);

/// The closed interval that a value must lie in; either end may be missing.
template <typename T>
struct Bounds {
  std::optional<T> lowest = {};
  std::optional<T> highest = {};

  [[nodiscard]] bool Contain(const T& value) const {
    // Written so that NaN, which compares with nothing, is outside of any bound.
    return (!lowest || value >= *lowest) && (!highest || value <= *highest);
  }
  [[nodiscard]] bool empty() const { return !lowest && !highest; }
};

/// Numbers have bounds, other types have none.
template <typename T>
concept Bounded = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

class Module;

/// What an author says of a parameter.
template <typename T>
struct ParameterOptions {
  T default_value = {};
  Bounds<T> bounds = {};
  std::string unit = {};
  std::string description = {};
};
template <typename T>
requires(!Bounded<T>) struct ParameterOptions<T> {
  T default_value = {};
  std::string unit = {};
  std::string description = {};
};

namespace internal {

/// The same without the type.
struct ParameterDescription {
  const TypeInfo& type;
  ConfigurableInfo info;
  bool is_number;
  std::function<bool(const void* value)> is_within_bounds;  ///< empty: all values are
};

template <typename T>
ParameterDescription DescriptionOf(const ParameterOptions<T>& options, bool is_static) {
  ParameterDescription description{
      TypeOf<T>(),
      {options.unit, "", TextOf(options.default_value), options.description, is_static, {}, {}},
      Bounded<T>,
      {}};
  if constexpr (Bounded<T>) {
    const Bounds<T>& bounds = options.bounds;
    if (bounds.empty()) return description;
    if (bounds.lowest) description.info.minimum = static_cast<double>(*bounds.lowest);
    if (bounds.highest) description.info.maximum = static_cast<double>(*bounds.highest);
    description.info.bounds = (bounds.lowest ? TextOf(*bounds.lowest) + " " : "") + ".." +
                              (bounds.highest ? " " + TextOf(*bounds.highest) : "");
    description.is_within_bounds = [bounds](const void* value) {
      return bounds.Contain(*static_cast<const T*>(value));
    };
  }
  return description;
}

}  // namespace internal

/// The part of a parameter that does not depend on its type: its place in the tree, the way from
/// text, what it accepts. A parameter hangs below its module, in the group "parameter".
class ParameterBase : public FrameworkElement, public Configurable {
 public:
  [[nodiscard]] Result<std::shared_ptr<const void>> Parse(std::string_view text) const override;
  [[nodiscard]] Result<void> Check(const void* value) const final;
  Result<void> Put(const Own& own) final;
  /// In the group "feed" below: a task of its own, run where the module is, takes over what comes there, unless
  /// it is out of bounds. None of static parameters, and of types that no port has.
  [[nodiscard]] Port* Feed() final;
  [[nodiscard]] bool is_fed() const noexcept final {
    return given_.load(std::memory_order_relaxed) > own_given_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] Values values() const final;
  void TakeFeed() final;
  Result<void> TakeGiven(const Values& other) final;
  [[nodiscard]] const TypeInfo& type() const final { return description_.type; }
  [[nodiscard]] const ConfigurableInfo& info() const final { return description_.info; }

 protected:
  ParameterBase(FrameworkElement* module, std::string name, internal::ParameterDescription description,
                const void* default_value);
  ~ParameterBase() override;

  /// Takes over a value that Check() has accepted; whether it is another one. One at a time.
  virtual bool Assign(const void* value) = 0;

 private:
  class Feeder;
  void Assume(const void* value);
  [[nodiscard]] bool MayBeFed(const void* value) const;
  [[nodiscard]] bool HasFeeder() const;
  [[nodiscard]] std::uint64_t LastNumber() const noexcept;
  [[nodiscard]] bool IsToReadAgain() const noexcept;

  const internal::ParameterDescription description_;
  Module* const module_;  // nullptr: of something else
  CycleLock assigning_{[]() noexcept {}};
  // Numbers of the last value that an output has given, of the last one that has been refused, and of what had come when the
  // own one was set; relaxed: they only inform others.
  std::atomic<std::uint64_t> given_{0};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<std::uint64_t> own_given_{0};
  // Under the structure lock. The own value, and the last given one while that is not the value; both once an output may
  // give any, since there is no memory to be had then.
  std::shared_ptr<const void> own_;
  std::shared_ptr<const void> last_given_;
  std::uint64_t settings_ = id() << Own::kSettingsBits;
  Feeder* feeder_ = nullptr;  // once somebody has asked for it; a child
};

}  // namespace runnel
