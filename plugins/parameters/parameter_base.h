#pragma once

#include <string>
#include <string_view>

#include "core/element/configurable.h"
#include "core/element/framework_element.h"
#include "core/types/type_of.h"
#include "plugins/parameters/bounds.h"

namespace runnel {

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

/// The part of a parameter that does not depend on its type: its place in the tree and the way from
/// text. A parameter hangs below its module, in the group "parameter".
class ParameterBase : public FrameworkElement, public Configurable {
 public:
  [[nodiscard]] const ConfigurableInfo& info() const override { return info_; }
  Result<void> SetFromText(std::string_view text) final;

 protected:
  ParameterBase(FrameworkElement* module, std::string name, ConfigurableInfo info);

  /// Takes over a text that CheckText() has accepted.
  virtual void Assign(std::string_view text) = 0;

  ConfigurableInfo info_;
};

namespace internal {

template <typename T>
std::string BoundsText(const ParameterOptions<T>& options) {
  if constexpr (Bounded<T>) {
    const Bounds<T>& bounds = options.bounds;
    if (bounds.empty()) return "";
    return (bounds.lowest ? TextOf(*bounds.lowest) + " " : "") + ".." +
           (bounds.highest ? " " + TextOf(*bounds.highest) : "");
  } else {
    return "";
  }
}

template <typename T>
ConfigurableInfo InfoOf(const ParameterOptions<T>& options, bool is_static) {
  return {options.unit, BoundsText(options), TextOf(options.default_value), options.description,
          is_static};
}

/// `text` without the unit of a number, which is then in `unit` (units.h). Errors: a character that
/// no file can carry, so that the value could not be saved; a unit of something else.
Result<std::string> ReadableText(std::string_view text, bool is_number, const std::string& unit);

/// The value in `text`, or what is wrong with it.
template <typename T>
Result<T> Accept(std::string_view text, const ParameterOptions<T>& options,
                 const ConfigurableInfo& info) {
  const auto readable = ReadableText(text, Bounded<T>, info.unit);
  if (!readable) return readable.error();
  auto value = FromText<T>(*readable);
  if (!value) {
    Error error = value.error();
    if (Bounded<T> && error.hint.empty() && !info.unit.empty()) {
      error.hint = "write a number; without a unit it is in " + info.unit;
    }
    return error;
  }
  if constexpr (Bounded<T>) {
    if (!options.bounds.Contain(*value)) {
      const std::string unit = info.unit.empty() ? "" : " " + info.unit;
      return Error{.message = *readable + unit + " is out of bounds",
                   .hint = "allowed is " + info.bounds + unit};
    }
  }
  return value;
}

}  // namespace internal

}  // namespace runnel
