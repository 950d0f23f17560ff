#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

class Port;
class TypeInfo;

/// What is to be said about something that can be set: for error messages, listings and viewers.
struct ConfigurableInfo {
  std::string unit;           ///< SI, "" for none
  std::string bounds;         ///< "0.05 .. 5", "" for none
  std::string default_value;  ///< text format
  std::string description;
  bool is_static = false;              ///< may be set only until its module is ready
  std::optional<double> minimum = {};  ///< the bounds of a number, as viewers want them
  std::optional<double> maximum = {};
};

/// "Set me, say what you are, describe yourself", by values of the type and by their text format: what XML
/// readers, command lines and viewers need of a parameter, so that none of them needs the plugin that makes
/// parameters. An element that can be set derives from FrameworkElement and from this.
///
/// Threads:  Put() and SetFromText() under the structure lock; the rest from any thread.
class Configurable {
 public:
  virtual ~Configurable() = default;

  /// The value that `text` stands for, an object of type(). Errors: there is none, or Check() refuses it.
  [[nodiscard]] virtual Result<std::shared_ptr<const void>> Parse(std::string_view text) const = 0;
  /// Whether `value`, an object of type(), is one that this may have.
  [[nodiscard]] virtual Result<void> Check(const void* value) const = 0;
  /// What has been set: the value, unless an output has given one since.
  struct Own {
    std::shared_ptr<const void> value;  ///< an object of type(), which does not change
    /// The number of the last value that an output had given by then: later ones count instead. Without, it is set now.
    std::uint64_t given = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t settings = 0;  ///< another one after each setting, in all elements of a run; 0: it is set now
    static constexpr int kSettingsBits = 40;  ///< below the number of the element: a thousand a second for thirty years
    /// It is no default.
    [[nodiscard]] bool is_set() const noexcept { return settings << (64 - kSettingsBits) != 0; }
  };
  /// That, and what outputs have given.
  struct Values {
    const TypeInfo* type = nullptr;
    std::string unit = {};  ///< of numbers
    Own own = {};
    std::shared_ptr<const void> given = {};  ///< the last one, as `own.value`; nullptr: none
    std::uint64_t number = 0;                ///< of the last one; 0: none
    std::uint64_t refused = 0;               ///< of the last one that has been refused, likewise
    [[nodiscard]] bool is_fed() const noexcept { return given != nullptr && number > own.given; }
  };
  /// Takes it over, or leaves everything as it was and says why not. What is put back is as it was before.
  virtual Result<void> Put(const Own& own) = 0;
  /// A copy of the value, an object of type(). Allocates.
  [[nodiscard]] virtual std::shared_ptr<void> Value() const = 0;
  [[nodiscard]] virtual const TypeInfo& type() const = 0;
  [[nodiscard]] virtual const ConfigurableInfo& info() const = 0;

  /// The input by which an output may set it, made when it is first asked for; nullptr: none may. Under the structure
  /// lock.
  [[nodiscard]] virtual Port* Feed() { return nullptr; }

  /// The value is one that an output has given.
  [[nodiscard]] virtual bool is_fed() const noexcept { return false; }
  /// Both under the structure lock.
  [[nodiscard]] virtual Values values() const = 0;
  [[nodiscard]] Own own() const { return values().own; }
  /// Takes over what an output has given and waits. The module does not run.
  virtual void TakeFeed() {}
  /// Has, from now on, what outputs have given at another one, if that is newer. The module does not run. Errors: it is refused.
  virtual Result<void> TakeGiven(const Values& /*other*/) { return {}; }
  /// A value of another one, if this may have it, too: numbers in the unit here.
  [[nodiscard]] Result<std::shared_ptr<const void>> ConvertedFrom(const Values& other,
                                                                  const std::shared_ptr<const void>& value) const;
  /// Whether nothing is to be converted.
  [[nodiscard]] bool IsLike(const Values& other) const {
    return &type() == other.type && (other.unit.empty() || other.unit == info().unit);
  }

  /// What its module has made of the value that was set last: nothing as long as it has not said; an error if it has
  /// refused it, and the value is that of before.
  [[nodiscard]] virtual std::optional<Result<void>> Outcome() const { return Result<void>(); }

  // The same by the text format.
  Result<void> SetFromText(std::string_view text);
  [[nodiscard]] Result<void> CheckText(std::string_view text) const;
  [[nodiscard]] std::string ToText() const;
  [[nodiscard]] std::string OwnText() const;
};

}  // namespace runnel
