
#include <algorithm>
#include <vector>

#include "plugins/ros_messages/internal/message_leaf.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

namespace {

using internal::FieldOfLeaf;
using internal::FixedCount;
using internal::IsElements;
using internal::IsLeaf;

constexpr const char* kPackage = "runnel_msgs/msg/";

bool IsMessageName(std::string_view name) {
  const std::size_t middle = name.find("/msg/");
  return middle != std::string_view::npos && IsRosPackageName(name.substr(0, middle)) &&
         IsRosMessageName(name.substr(middle + 5));
}

// Without a package.
std::string WordsOf(const TypeInfo& type) {
  if (!IsElements(type)) {
    const std::string_view name = type.name();
    return NearestMessageName(name.substr(name.rfind('/') + 1));
  }
  const std::string element = WordsOf(*type.elements().type);
  if (type.elements().is_fixed) return element + "Array" + std::to_string(FixedCount(type));
  return element + (type.kind() == TypeKind::kMatrix ? "Matrix" : "List");
}

std::string StandardNameOf(const TypeInfo& type) {
  const MessageField field = FieldOfLeaf(type);
  if (field.type == MessageType::kNested) return field.nested;
  std::string name(NameOf(field.type));
  name.front() = static_cast<char>(name.front() - 'a' + 'A');
  if (name.starts_with("Uint")) name[1] = 'I';
  return "std_msgs/msg/" + name;
}

std::string CommentOf(const FieldInfo& field) {
  std::string comment = field.unit.empty() ? "" : "[" + field.unit + "]";
  const auto add = [&](const std::string& text) {
    if (!text.empty()) comment += (comment.empty() ? "" : " ") + text;
  };
  add(field.description);
  if (field.type->kind() != TypeKind::kEnumeration) return comment;
  std::string names;
  for (const EnumeratorInfo& each : field.type->enumerators()) {
    names += (names.empty() ? "" : ", ") + std::to_string(each.value) + " " + each.name;
  }
  add(names);
  std::ranges::replace(comment, '\n', ' ');
  return comment;
}

/// Makes the definitions of a type and of all that is inside.
class Describer {
 public:
  explicit Describer(MessageLibrary& library) : library_(library) {}

  Result<std::string> Add(const TypeInfo& type) {
    if (IsLeaf(type)) return StandardNameOf(type);
    MessageDefinition definition{.name = MessageNameOf(type)};
    if (std::ranges::find(open_, &type) != open_.end()) {
      return Error{.message = "a " + type.name() + " contains itself, which no message of ROS 2 can"};
    }
    open_.push_back(&type);
    auto filled = IsElements(type) ? FillElements(type, definition) : FillFields(type, definition);
    open_.pop_back();
    if (!filled) return filled.error();
    std::string name = definition.name;
    if (auto added = library_.Add(std::move(definition)); !added) return added.error();
    return name;
  }

 private:
  Result<void> FillFields(const TypeInfo& type, MessageDefinition& definition) {
    if (type.kind() == TypeKind::kOpaque) {
      return Error{.message = "a " + type.name() + " cannot be a message: its inside is not described",
                   .hint = "Describe() of the type is to name its fields"};
    }
    for (const FieldInfo& field : type.fields()) {
      auto described = FieldOf(*field.type);
      if (!described) return described.error();
      described->name = NearestFieldName(field.name);
      while (definition.FindField(described->name) != nullptr) described->name += "2";
      described->comment = CommentOf(field);
      definition.fields.push_back(std::move(*described));
    }
    return {};
  }

  // A message that is one list or matrix.
  Result<void> FillElements(const TypeInfo& type, MessageDefinition& definition) {
    const ElementOperations& elements = type.elements();
    auto field = FieldOf(*elements.type);
    if (field && field->count != MessageCount::kOne) field = NestedIn(*elements.type);
    if (!field) return field.error();
    if (!elements.is_fixed && type.kind() == TypeKind::kMatrix) {
      definition.fields.push_back({.name = "rows", .type = MessageType::kUint32});
      definition.fields.push_back({.name = "columns", .type = MessageType::kUint32});
    }
    field->name = "elements";
    field->count = elements.is_fixed ? MessageCount::kArray : MessageCount::kList;
    if (elements.is_fixed) field->capacity = FixedCount(type);
    if (elements.is_fixed && field->capacity == 0)
      return Error{.message = "a " + type.name() + " has no elements, which no message of ROS 2 can"};
    definition.fields.push_back(std::move(*field));
    return {};
  }

  Result<MessageField> NestedIn(const TypeInfo& type) {
    auto name = Add(type);
    if (!name) return name.error();
    return MessageField{.name = {}, .type = MessageType::kNested, .nested = *name};
  }

  Result<MessageField> FieldOf(const TypeInfo& type) {
    if (IsLeaf(type)) return FieldOfLeaf(type);
    if (!IsElements(type)) return NestedIn(type);
    MessageDefinition as_message;
    if (auto filled = FillElements(type, as_message); !filled) return filled.error();
    if (as_message.fields.size() > 1) return NestedIn(type);
    return as_message.fields.front();
  }

  MessageLibrary& library_;
  std::vector<const TypeInfo*> open_;
};

}  // namespace

std::string MessageNameOf(const TypeInfo& type) {
  if (IsLeaf(type)) return StandardNameOf(type);
  return !IsElements(type) && IsMessageName(type.name()) ? type.name() : kPackage + WordsOf(type);
}

Result<const MessageDefinition*> MessageLibrary::AddDescribed(const TypeInfo& type) {
  MessageLibrary wanted = *this;
  auto name = Describer(wanted).Add(type);
  if (!name) return name.error();
  definitions_.merge(wanted.definitions_);
  return Get(*name);
}

}  // namespace runnel
