#pragma once

#include <memory>
#include <span>
#include <string>

#include "core/base/result.h"
#include "plugins/wire/wire.h"

namespace runnel {

class MessageCodec;
class MessageLibrary;
struct MessageDefinition;
class TypeInfo;

/// What requests or responses of a service are on the wire.
struct ServiceType {
  std::string name = {};  ///< "std_srvs::srv::dds_::SetBool_Request_"
  std::string hash = {};  ///< "RIHS01_…" (TypeHashOf()), which others are told; "": they are not

  /// `library`: has the messages inside.
  [[nodiscard]] static ServiceType Of(const MessageDefinition& definition, const MessageLibrary& library);
  /// Of a message that ROS 2 has: "std_srvs/srv/SetBool_Request".
  [[nodiscard]] static ServiceType OfRos(const std::string& message);

  friend bool operator==(const ServiceType&, const ServiceType&) = default;
};

/// The arguments of a call and its reply as request and response of a service of ROS 2, whose fields have the same names.
///
/// Services of ROS 2 have no errors. Where a response has fields `success` and `message` that are not of the reply itself, they
/// say whether there is one, and if not, why; a `message` alone says why where there is no reply at all. A reply that is a
/// text or a bool may be these, too.
///
/// Threads: any number at once, each with values of its own. The types must outlive it.
class ServiceForm {
 public:
  /// `as`: "std_srvs/srv/SetBool"; "": a service made of the types, runnel_msgs/srv/<reply and arguments>, with `success` and
  /// `message`. nullptr: no arguments, no reply. Errors: there is no such service, with the nearest name; what does not fit.
  static Result<std::shared_ptr<const ServiceForm>> Make(const TypeInfo* arguments, const TypeInfo* reply,
                                                         const std::string& as, const MessageLibrary& library);

  /// "std_srvs/srv/SetBool".
  [[nodiscard]] const std::string& ros_type() const noexcept { return ros_type_; }
  [[nodiscard]] const ServiceType& request_type() const noexcept { return request_type_; }
  [[nodiscard]] const ServiceType& response_type() const noexcept { return response_type_; }

  /// How a call has ended: with a reply, or why not.
  struct Outcome {
    bool success = false;
    std::string message;
  };

  void WriteRequest(const void* arguments, Octets& octets) const;
  /// Errors: what is wrong with the octets.
  Result<void> ReadRequest(std::span<const std::byte> octets, void* arguments) const;
  /// `reply`: of a success. False: the response cannot say that there is none.
  [[nodiscard]] bool WriteResponse(const Outcome& outcome, const void* reply, Octets& octets) const;
  /// Errors: what is wrong with the octets, after which the reply may be half set.
  Result<Outcome> ReadResponse(std::span<const std::byte> octets, void* reply) const;

 private:
  class Maker;
  enum class ReplyIs { kNothing, kMessage, kSuccess, kFields };

  std::string ros_type_;
  ServiceType request_type_;
  ServiceType response_type_;
  const TypeInfo* arguments_ = nullptr;
  bool is_only_argument_ = false;  // the request is the value of the structure's only field
  bool says_success_ = false;
  ReplyIs reply_is_ = ReplyIs::kNothing;
  std::shared_ptr<const MessageCodec> request_;
  std::shared_ptr<const MessageCodec> reply_;    // of kFields
  std::shared_ptr<const MessageCodec> outcome_;  // nullptr: the response has no such fields
  std::shared_ptr<const MessageCodec> nothing_;  // of a response without fields
};

}  // namespace runnel
