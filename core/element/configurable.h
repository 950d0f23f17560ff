#pragma once

#include <cstdint>
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
/// Threads:  SetFrom() and SetFromText() under the structure lock; the rest from any thread.
class Configurable {
 public:
  virtual ~Configurable() = default;

  /// The value that `text` stands for, an object of type(). Errors: there is none, or Check() refuses it.
  [[nodiscard]] virtual Result<std::shared_ptr<const void>> Parse(std::string_view text) const = 0;
  /// Whether `value`, an object of type(), is one that this may have.
  [[nodiscard]] virtual Result<void> Check(const void* value) const = 0;
  /// Takes over the value, an object of type(), or leaves everything as it was and says why not.
  Result<void> SetFrom(const void* value) { return PutBack(value, {}); }
  /// A copy of the value, an object of type(). Allocates.
  [[nodiscard]] virtual std::shared_ptr<void> Value() const = 0;
  [[nodiscard]] virtual const TypeInfo& type() const = 0;
  [[nodiscard]] virtual const ConfigurableInfo& info() const = 0;

  /// The input by which an output may set it, made when it is first asked for; nullptr: none may. Under the structure
  /// lock.
  [[nodiscard]] virtual Port* Feed() { return nullptr; }

  /// Where its value has come from. What is passed on to another element, or put back, has that as well.
  struct Origin {
    bool is_fed = false;        ///< an output has given it, and nobody has set another since
    bool has_been_fed = false;  ///< an output has given one at some time: no value from before is used again
    /// Another one after each setting, by whomever, and in each element of a run. What is put back gets its own again.
    std::uint64_t settings = 0;
  };
  [[nodiscard]] virtual Origin origin() const = 0;
  /// Takes over a value of that origin, as SetFrom() does one that is set. Errors: the same; an output's need only be within the
  /// bounds.
  virtual Result<void> PutBack(const void* value, const Origin& origin) = 0;
  /// In the module's next cycle it takes the newest value of the output that is connected, though it has had that before.
  virtual void AskFeed() noexcept {}
  /// What an output has given, and has not been taken over yet, is. Its module does not run.
  virtual void TakeRest() {}

  /// What its module has made of the value that was set last: nothing as long as it has not said; an error if it has
  /// refused it, and the value is that of before.
  [[nodiscard]] virtual std::optional<Result<void>> Outcome() const { return Result<void>(); }

  // The same by the text format.
  Result<void> SetFromText(std::string_view text);
  [[nodiscard]] Result<void> CheckText(std::string_view text) const;
  [[nodiscard]] std::string ToText() const;
};

}  // namespace runnel
