#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

class TypeInfo;

/// What is to be said about something that can be set: for error messages, listings and viewers.
struct ConfigurableInfo {
  std::string unit;           ///< SI, "" for none
  std::string bounds;         ///< "0.05 .. 5", "" for none
  std::string default_value;  ///< text format
  std::string description;
  bool is_static = false;  ///< may be set only until its module is ready
};

/// "Set me from text, give me as text, describe me": what XML readers, command lines and viewers
/// need of a parameter, so that none of them needs the plugin that makes parameters. An element
/// that can be set derives from FrameworkElement and from this.
///
/// Threads:  SetFromText() under the structure lock; the rest from any thread.
class Configurable {
 public:
  virtual ~Configurable() = default;

  /// Takes over the value, or leaves everything as it was and says why not.
  virtual Result<void> SetFromText(std::string_view text) = 0;
  /// Whether SetFromText() would accept the text, without doing it.
  [[nodiscard]] virtual Result<void> CheckText(std::string_view text) const = 0;
  [[nodiscard]] virtual std::string ToText() const = 0;
  [[nodiscard]] virtual const TypeInfo& type() const = 0;
  [[nodiscard]] virtual const ConfigurableInfo& info() const = 0;
};

}  // namespace runnel
