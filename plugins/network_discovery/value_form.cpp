#include "plugins/network_discovery/value_form.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/types/type_info.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

namespace {

constexpr std::string_view kKey = "runnel_type=";
constexpr std::string_view kHash = "typehash=";
constexpr int kDeepest = 20;

void AppendDescription(const TypeInfo& type, int depth, std::string& text) {
  switch (type.kind()) {
    case TypeKind::kStructure:
      text += '{';
      for (const FieldInfo& field : type.fields()) {
        if (text.back() != '{') text += ',';
        text += field.name + ':';
        if (depth < kDeepest) AppendDescription(*field.type, depth + 1, text);
        if (!field.unit.empty()) text += '[' + field.unit + ']';
      }
      text += '}';
      return;
    case TypeKind::kEnumeration:
      text += '(';
      for (const EnumeratorInfo& each : type.enumerators()) {
        if (text.back() != '(') text += '|';
        text += each.name + '=' + std::to_string(each.value);
      }
      text += ')';
      return;
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      text += type.kind() == TypeKind::kMatrix ? "matrix<" : type.elements().is_fixed ? "array<" : "list<";
      AppendDescription(*type.elements().type, depth + 1, text);
      text += '>';
      return;
    case TypeKind::kLeaf:
    case TypeKind::kOpaque:
      text += type.name();
  }
}

std::string_view PartOf(std::string_view user_data, std::string_view key) {
  const std::size_t begin = user_data.find(key);
  if (begin == std::string_view::npos) return {};
  user_data.remove_prefix(begin + key.size());
  return user_data.substr(0, user_data.find(';'));
}

// From the beginning of the field in which the two differ, or of the whole.
std::string_view FieldAt(std::string_view text, std::size_t place) {
  std::size_t begin = text.find_last_of("{,", place);
  begin = begin == std::string_view::npos || begin == place ? std::min(place, text.size()) : begin + 1;
  return text.substr(begin, text.find_first_of(",}", begin) - begin);
}

}  // namespace

std::string DescriptionText(const TypeInfo& type) {
  std::string text;
  AppendDescription(type, 0, text);
  return text;
}

std::string TypeHashText(const std::string& hash) { return std::string(kHash) + hash + ";"; }

WireEndpointOptions RosEndpoint(const std::string& topic, const std::string& message, const WireQos& qos) {
  const MessageLibrary& library = MessageLibrary::Standard();
  return {.topic = DdsTopic(topic),
          .type = DdsType(message),
          .qos = qos,
          .user_data = TypeHashText(TypeHashOf(*library.Find(message), library))};
}

std::string TypeMisfit(const std::string& writers, const std::string& readers) {
  const std::string_view theirs = PartOf(writers, kKey);
  const std::string_view ours = PartOf(readers, kKey);
  if (theirs.empty() || ours.empty() || theirs == ours) return {};
  const auto differs = std::ranges::mismatch(theirs, ours).in1 - theirs.begin();
  const auto place = static_cast<std::size_t>(differs);
  const std::string_view its = FieldAt(theirs, place);
  const std::string_view own = FieldAt(ours, place);
  const auto quoted = [](std::string_view field) {
    return field.empty() ? std::string("nothing more") : "'" + std::string(field) + "'";
  };
  return "they are of two versions: the writer's has " + quoted(its) + " where the reader's has " + quoted(own);
}

std::string TypeDoubt(const std::string& writers, const std::string& readers) {
  constexpr std::size_t kBegin = 15;  // of a hash: enough to tell two apart
  const std::string theirs(PartOf(writers, kHash).substr(0, kBegin));
  const std::string ours(PartOf(readers, kHash).substr(0, kBegin));
  if (theirs.empty() || ours.empty() || theirs == ours) return {};
  return "the writer's message of this name has other fields than the reader's (" + theirs + ", not " + ours +
         "), so values may be read as what they are not";
}

Result<std::shared_ptr<const ValueForm>> ValueForm::Make(const TypeInfo& type, const std::string& as,
                                                         const std::string& frame, const std::string& child_frame,
                                                         const MessageLibrary* messages, const std::string& field) {
  auto codec = MessageCodec::Make(
      type, {.as = as, .by_description = as.empty(), .frame = frame, .child_frame = child_frame, .field = field},
      messages != nullptr ? *messages : MessageLibrary::Standard());
  if (!codec) return codec.error();
  std::string user_data = TypeHashText((*codec)->type_hash());
  if (as.empty()) user_data += std::string(kKey) + DescriptionText(type) + ";";
  return std::make_shared<const ValueForm>(ValueForm{std::move(*codec), std::move(user_data)});
}

}  // namespace runnel
