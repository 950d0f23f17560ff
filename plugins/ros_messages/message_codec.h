#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace runnel {

class MessageLibrary;
class TypeInfo;

/// How values of a port become messages.
struct MessageOptions {
  /// "sensor_msgs/msg/LaserScan"; "": what fits the meaning of the type (README.md), or else its own description.
  std::string as = {};
  /// Always by the type's own description, for applications of Runnel among each other.
  bool by_description = false;
  std::string frame = {};        ///< of headers
  std::string child_frame = {};  ///< of transforms and odometry: what moves
  /// "percentage", "pose.pose.position", "ranges[0]": values are made of that field of messages `as` only, by the same rules.
  std::string field = {};
};

/// Values of one type as messages of ROS 2, and back: what the type of the messages is called, and their octets.
///
/// Threads: any number at once, each with a value of its own.
class MessageCodec {
 public:
  /// Errors: there is no such message, with the nearest name; the type has nothing of it, or fields of the same name that do
  /// not fit; a part of the type is opaque. `library`: which messages there are; it is not needed afterwards. Allocates.
  static Result<std::shared_ptr<const MessageCodec>> Make(const TypeInfo& type, const MessageOptions& options,
                                                          const MessageLibrary& library);

  virtual ~MessageCodec() = default;

  [[nodiscard]] const std::string& ros_type() const noexcept { return ros_type_; }
  /// The name under which DDS knows the type.
  [[nodiscard]] const std::string& dds_type() const noexcept { return dds_type_; }
  /// "RIHS01_…", for the USER_DATA of readers and writers from Iron on ("typehash=…;").
  [[nodiscard]] const std::string& type_hash() const noexcept { return type_hash_; }
  /// Why messages cannot become values, or values messages; "" if they can.
  [[nodiscard]] const std::string& why_no_decoding() const noexcept { return why_no_decoding_; }
  /// Fields of the value that the message does not have: they are lost on the way out, and stay as the type makes them on
  /// the way in.
  [[nodiscard]] const std::vector<std::string>& left_out() const noexcept { return left_out_; }

  /// Sets `octets` to the message, with the encapsulation header in front. `stamp`: for headers, since the begin of 1970
  /// or of simulated time. Allocates as far as the vector grows. Precondition: not of one field only.
  virtual void Encode(const void* value, Time stamp, std::vector<std::byte>& octets) const = 0;

  struct Decoded {
    std::optional<Time> stamp;  ///< of the message's own header, if it has one; not where one field is read
  };
  /// Sets `value` from octets that may be anything. Errors: what is wrong with them, and with which field; the value may
  /// then be half set. Large lists of numbers may refer to the octets, which stay as they are as long as anybody has
  /// `holder` (ReadCdr()). Allocates as far as lists and texts of the value grow.
  [[nodiscard]] virtual Result<Decoded> Decode(std::span<const std::byte> octets, void* value,
                                               std::shared_ptr<const void> holder = {}) const = 0;

 protected:
  MessageCodec() = default;

  std::string ros_type_;
  std::string dds_type_;
  std::string type_hash_;
  std::string why_no_decoding_;
  std::vector<std::string> left_out_;
};

}  // namespace runnel
