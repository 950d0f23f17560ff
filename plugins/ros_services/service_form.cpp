#include "plugins/ros_services/service_form.h"

#include <utility>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/types/builtin_types.h"
#include "core/types/type_of.h"
#include "plugins/ros_messages/message_codec.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"
#include "plugins/ros_services/ros_time.h"

namespace runnel {

ServiceType ServiceType::Of(const MessageDefinition& definition, const MessageLibrary& library) {
  return {DdsType(definition.name), TypeHashOf(definition, library)};
}

ServiceType ServiceType::OfRos(const std::string& message) {
  const MessageLibrary& library = MessageLibrary::Standard();
  return Of(*library.Find(message), library);
}

static void Describe(TypeBuilder<ServiceForm::Outcome>& type) {
  type.Name("ros.ServiceOutcome").Fields<&ServiceForm::Outcome::success, &ServiceForm::Outcome::message>();
}

namespace {

constexpr std::string_view kRequest = "_Request", kResponse = "_Response";

// "std_srvs/SetBool" as "std_srvs/srv/SetBool".
std::string FullName(const std::string& as) {
  const std::size_t slash = as.find('/');
  if (slash == std::string::npos || as.find("/srv/") != std::string::npos) return as;
  return as.substr(0, slash) + "/srv" + as.substr(slash);
}

Error NoSuchService(const std::string& name, const MessageLibrary& library) {
  std::vector<std::string> names;
  for (const MessageDefinition* each : library.All()) {
    if (each->name.ends_with(kRequest)) names.push_back(each->name.substr(0, each->name.size() - kRequest.size()));
  }
  std::string hint = NearestNameHint(name, names);
  if (hint.empty()) hint = "read its package: <network messages=\"…\">, a folder with <package>/srv/*.srv";
  return {.message = "there is no service type '" + name + "'", .hint = std::move(hint)};
}

bool HasField(const TypeInfo* type, std::string_view name) {
  return type != nullptr && type->kind() == TypeKind::kStructure && type->FindField(name) != nullptr;
}

}  // namespace

/// Makes one, out of a library of its own.
class ServiceForm::Maker {
 public:
  Maker(const TypeInfo* arguments, const TypeInfo* reply, const MessageLibrary& library)
      : arguments_(arguments), reply_(reply), library_(library) {}

  Result<std::shared_ptr<const ServiceForm>> Make(const std::string& as) {
    form_->arguments_ = arguments_;
    form_->ros_type_ = FullName(as);
    if (as.empty()) {
      if (const auto described = DescribeService(); !described) return described.error();
    }
    const MessageDefinition* const request = library_.Find(form_->ros_type_ + std::string(kRequest));
    const MessageDefinition* const response = library_.Find(form_->ros_type_ + std::string(kResponse));
    if (request == nullptr || response == nullptr) return NoSuchService(form_->ros_type_, library_);
    form_->request_type_ = ServiceType::Of(*request, library_);
    form_->response_type_ = ServiceType::Of(*response, library_);
    if (const auto made = MakeRequest(*request); !made) return made.error();
    if (const auto made = MakeResponse(*response); !made) return made.error();
    return std::shared_ptr<const ServiceForm>(std::move(form_));
  }

 private:
  using Codec = Result<std::shared_ptr<const MessageCodec>>;

  Codec CodecFor(const TypeInfo& type, const std::string& message) const {
    auto codec = MessageCodec::Make(type, {.as = message}, library_);
    if (codec && !(*codec)->why_no_decoding().empty()) return Error{.message = (*codec)->why_no_decoding()};
    return codec;
  }

  // Named after its types, since those of one name fit one another.
  Result<void> DescribeService() {
    const auto name_of = [](const TypeInfo* type) { return type != nullptr ? type->name() : "nothing"; };
    std::string name = name_of(reply_);
    if (arguments_ != nullptr && arguments_->kind() == TypeKind::kStructure && arguments_->name() == "arguments") {
      for (const FieldInfo& field : arguments_->fields()) name += " " + field.type->name();
    } else if (arguments_ != nullptr) {
      name += " " + arguments_->name();
    }
    form_->ros_type_ = "runnel_msgs/srv/" + NearestMessageName(name);
    auto request = Describe(arguments_, kRequest);
    if (!request) return request.error();
    auto response = Describe(reply_, kResponse);
    if (!response) return response.error();
    std::vector<MessageField> outcome;
    if (response->FindField("success") == nullptr) outcome.push_back({.name = "success", .type = MessageType::kBool});
    if (response->FindField("message") == nullptr) outcome.push_back({.name = "message", .type = MessageType::kString});
    response->fields.insert(response->fields.begin(), outcome.begin(), outcome.end());
    if (auto added = library_.Add(std::move(*request)); !added) return added;
    return library_.Add(std::move(*response));
  }

  Result<MessageDefinition> Describe(const TypeInfo* type, std::string_view end) {
    MessageDefinition definition{.name = form_->ros_type_ + std::string(end)};
    if (type == nullptr) return definition;
    const auto described = library_.AddDescribed(*type);
    if (!described) return described.error();
    definition.fields = (*described)->fields;
    // A list: what is not a structure is called data in messages.
    if (type->kind() != TypeKind::kStructure && definition.fields.size() == 1) definition.fields.front().name = "data";
    return definition;
  }

  Result<void> MakeRequest(const MessageDefinition& request) {
    const TypeInfo& type = arguments_ != nullptr ? *arguments_ : TypeOf<Signal>();
    auto codec = CodecFor(type, request.name);
    // The only argument may be called something else than the only field.
    if (!codec && type.kind() == TypeKind::kStructure && type.fields().size() == 1 && request.fields.size() == 1) {
      if (auto only = CodecFor(*type.fields().front().type, request.name)) {
        form_->is_only_argument_ = true;
        codec = std::move(only);
      }
    }
    if (!codec) return codec.error();
    form_->request_ = std::move(*codec);
    return {};
  }

  Result<void> MakeResponse(const MessageDefinition& response) {
    const auto has = [&](std::string_view name, MessageType type) {
      const MessageField* const field = response.FindField(name);
      return field != nullptr && field->type == type && field->count == MessageCount::kOne && !HasField(reply_, name);
    };
    const bool has_message = has("message", MessageType::kString);
    form_->says_success_ = has("success", MessageType::kBool);
    if (form_->says_success_ || has_message) {
      auto outcome = CodecFor(TypeOf<Outcome>(), response.name);
      if (!outcome) return outcome.error();
      form_->outcome_ = std::move(*outcome);
    }
    if (reply_ == nullptr) {
      if (form_->outcome_ != nullptr) return {};
      auto nothing = CodecFor(TypeOf<Signal>(), response.name);
      if (!nothing) return nothing.error();
      form_->nothing_ = std::move(*nothing);
      return {};
    }
    auto reply = CodecFor(*reply_, AnsweredFormOf(response).name);
    form_->reply_is_ = ReplyIs::kFields;
    if (!reply && has_message && reply_ == &TypeOf<std::string>()) {
      form_->reply_is_ = ReplyIs::kMessage;
    } else if (!reply && form_->says_success_ && reply_ == &TypeOf<bool>()) {
      form_->reply_is_ = ReplyIs::kSuccess;
    } else if (!reply) {
      return reply.error();
    } else {
      form_->reply_ = std::move(*reply);
    }
    return {};
  }

  // The response as it is when there is a reply. Nobody sees its name.
  const MessageDefinition& AnsweredFormOf(const MessageDefinition& response) {
    if (!form_->says_success_) return response;
    MessageDefinition answered = response;
    answered.name += "Answered";
    for (MessageField& field : answered.fields) {
      if (field.name == "success") field.default_value = "true";
    }
    const std::string name = answered.name;
    (void)library_.Add(std::move(answered));
    return *library_.Find(name);
  }

  const TypeInfo* const arguments_;
  const TypeInfo* const reply_;
  MessageLibrary library_;
  std::shared_ptr<ServiceForm> form_{new ServiceForm()};
};

Result<std::shared_ptr<const ServiceForm>> ServiceForm::Make(const TypeInfo* arguments, const TypeInfo* reply,
                                                             const std::string& as, const MessageLibrary& library) {
  return Maker(arguments, reply, library).Make(as);
}

void ServiceForm::WriteRequest(const void* arguments, Octets& octets) const {
  static const Signal kNothing;
  const void* value = arguments_ != nullptr ? arguments : &kNothing;
  if (is_only_argument_) value = arguments_->fields().front().address(ForLooking(arguments));
  request_->Encode(value, SinceEpoch(), octets);
}

Result<void> ServiceForm::ReadRequest(std::span<const std::byte> octets, void* arguments) const {
  if (arguments_ == nullptr) return {};
  void* const value = is_only_argument_ ? arguments_->fields().front().address(arguments) : arguments;
  const auto read = request_->Decode(octets, value);
  return read ? Result<void>() : read.error();
}

bool ServiceForm::WriteResponse(const Outcome& outcome, const void* reply, Octets& octets) const {
  static const Signal kNothing;
  if (!outcome.success) {
    // A message beside a reply would be taken for a part of that.
    const bool can_say = says_success_ || (outcome_ != nullptr && reply_is_ == ReplyIs::kNothing);
    if (can_say) outcome_->Encode(&outcome, SinceEpoch(), octets);
    return can_say;
  }
  Outcome said = outcome;
  switch (reply_is_) {
    case ReplyIs::kFields:
      reply_->Encode(reply, SinceEpoch(), octets);
      return true;
    case ReplyIs::kMessage:
      said.message = *static_cast<const std::string*>(reply);
      break;
    case ReplyIs::kSuccess:
      said.success = *static_cast<const bool*>(reply);
      break;
    case ReplyIs::kNothing:
      break;
  }
  if (outcome_ != nullptr) {
    outcome_->Encode(&said, SinceEpoch(), octets);
  } else {
    nothing_->Encode(&kNothing, SinceEpoch(), octets);
  }
  return true;
}

Result<ServiceForm::Outcome> ServiceForm::ReadResponse(std::span<const std::byte> octets, void* reply) const {
  Outcome said;
  if (outcome_ != nullptr) {
    if (const auto read = outcome_->Decode(octets, &said); !read) return read.error();
  }
  if (!says_success_) said.success = true;
  if (reply_is_ == ReplyIs::kSuccess) {
    *static_cast<bool*>(reply) = std::exchange(said.success, true);
    return said;
  }
  if (!said.success) return said;
  if (reply_is_ == ReplyIs::kMessage) *static_cast<std::string*>(reply) = said.message;
  if (reply_is_ == ReplyIs::kFields) {
    if (const auto read = reply_->Decode(octets, reply); !read) return read.error();
  }
  return said;
}

}  // namespace runnel
