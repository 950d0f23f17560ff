#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "plugins/wire/wire.h"

namespace runnel {

class MessageLibrary;
class TypeInfo;

/// Values of one type as octets on the wire, and back.
///
/// Threads: any number at once, each with a value of its own.
class ValueForm {
 public:
  /// `as`: "sensor_msgs/msg/LaserScan"; "": by the type's own description. Errors: there is no such message; the type
  /// cannot become it; a part of the type is opaque. `messages`: which there are; nullptr: those of ROS 2.
  /// `field`: of the message, of which alone values are made (MessageOptions); nothing can be written then.
  static Result<std::shared_ptr<const ValueForm>> Make(const TypeInfo& type, const std::string& as,
                                                       const std::string& frame = {},
                                                       const std::string& child_frame = {},
                                                       const MessageLibrary* messages = nullptr,
                                                       const std::string& field = {});
  virtual ~ValueForm() = default;

  /// By which the wire knows the type.
  [[nodiscard]] const std::string& wire_type() const noexcept { return wire_type_; }
  /// What is told of the type besides its name: two of one name fit only if this is the same, or unknown.
  [[nodiscard]] const std::string& user_data() const noexcept { return user_data_; }

  /// `stamp`: since 1970, for headers.
  virtual void Write(const void* value, Time stamp, Octets& octets) const = 0;
  /// Returns the stamp of the message's own header, if it has one. Large lists may refer to the octets, which stay as they
  /// are as long as anybody has `holder`. Errors: what is wrong with the octets; the value may then be half set.
  virtual Result<std::optional<Time>> Read(std::span<const std::byte> octets, void* value,
                                           std::shared_ptr<const void> holder = {}) const = 0;
  /// Why messages cannot become values; "" if they can.
  [[nodiscard]] virtual std::string WhyNoReading() const = 0;

 protected:
  std::string wire_type_;
  std::string user_data_;
};

/// What is inside of values, in one line: "{x:double[m],y:double[m]}".
[[nodiscard]] std::string DescriptionText(const TypeInfo& type);

/// Why values of a writer cannot be read by a reader although their types have one name, from what both say of them; ""
/// if they can, as far as is known.
[[nodiscard]] std::string TypeMisfit(const std::string& writers, const std::string& readers);

/// Why they may be read wrongly: both say hashes of their messages (RIHS01), which differ. ROS 2 matches them all the same, and
/// between distributions, where fields come to an end of a message, it does no harm. "" if not.
[[nodiscard]] std::string TypeDoubt(const std::string& writers, const std::string& readers);

}  // namespace runnel
