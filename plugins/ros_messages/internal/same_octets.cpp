#include <algorithm>

#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_messages/internal/binding.h"
#include "plugins/ros_messages/internal/message_leaf.h"

namespace runnel::internal {

namespace {

using Kind = Step::Kind;

bool IsSameStructure(const MessageDefinition& definition, const TypeInfo& type, const MessageLibrary& library) {
  return type.kind() == TypeKind::kStructure &&
         std::ranges::equal(definition.fields, type.fields(), [&](const MessageField& a, const FieldInfo& b) {
           return a.name == b.name && IsSame(a, *b.type, library);
         });
}

}  // namespace

bool IsSame(const MessageField& field, const TypeInfo& type, const MessageLibrary& library) {
  if (field.count == MessageCount::kOne && IsLeaf(type)) {
    const MessageField leaf = FieldOfLeaf(type);
    const bool is_byte = field.type == MessageType::kByte && leaf.type == MessageType::kUint8;
    if (field.type != MessageType::kNested) return leaf.type == field.type || is_byte;
    const auto* const nested = library.Find(field.nested);
    const bool is_empty = &type == &TypeOf<Signal>() && nested != nullptr && nested->fields.empty();
    if (is_empty) return true;
    const bool is_time = leaf.nested == kTimeMessage || leaf.nested == kDurationMessage;
    return leaf.nested == field.nested || (is_time && (field.nested == kTimeMessage || field.nested == kDurationMessage));
  }
  if (field.count == MessageCount::kOne) {
    const auto* const nested = field.type == MessageType::kNested ? library.Find(field.nested) : nullptr;
    return nested != nullptr && IsSameStructure(*nested, type, library);
  }
  if (type.kind() != TypeKind::kSequence && !(IsElements(type) && type.elements().is_fixed)) return false;
  const bool is_array = field.count == MessageCount::kArray;
  // What bounds a list is looked at element by element.
  if (field.count == MessageCount::kBounded || is_array != type.elements().is_fixed) return false;
  return (!is_array || FixedCount(type) == field.capacity) && IsSame(One(field), *type.elements().type, library);
}

std::size_t FewestOctets(const Step& step) {
  switch (step.kind) {
    case Kind::kPlain:
      return FewestCdrOctets(*step.part);
    case Kind::kNumber:
    case Kind::kNoNumber:
    case Kind::kLastAngle:
      return SizeOf(step.type);
    case Kind::kHeading:
      return 4 * SizeOf(MessageType::kFloat64);
    case Kind::kStamp:
      return 2 * SizeOf(MessageType::kInt32);
    case Kind::kElements:
    case Kind::kElement:
    case Kind::kNoList:
      return step.count == MessageCount::kArray ? step.capacity * FewestOctets(step.element.front()) : 4;
    case Kind::kListOfOne:
    case Kind::kNoText:
      return 4;
    case Kind::kStructure:
      break;
  }
  std::size_t sum = 0;
  for (const Step& each : step.inside) sum += FewestOctets(each);
  return sum;
}

}  // namespace runnel::internal
