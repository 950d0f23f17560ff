#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "core/types/type_of.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_messages/internal/binding.h"
#include "plugins/ros_messages/internal/message_leaf.h"

namespace runnel::internal {

namespace {

using Kind = Step::Kind;

std::vector<std::string> FieldsOf(const MessageDefinition& definition) {
  return NamesOf(definition.fields, &MessageField::name);
}

/// Follows the name of a field, and notes what is to be passed over on the way there.
class FieldBinder {
 public:
  FieldBinder(const TypeInfo& type, const MessageOptions& options, const MessageLibrary& library)
      : type_(type), options_(options), library_(library) {}

  Result<Binding> Bind(const MessageDefinition& definition) {
    auto way = Within(definition, options_.field);
    if (!way) return way.error();
    Binding binding{.root = {}, .left_out = {}, .why_no_decoding = std::move(why_no_decoding_)};
    binding.root.inside.push_back(std::move(*way));  // as one thing, of which nothing may be missing at the end
    return binding;
  }

 private:
  Result<Step> Within(const MessageDefinition& definition, std::string_view name) {
    const std::size_t end = std::min(name.find_first_of(".["), name.size());
    const std::string first(name.substr(0, end));
    const MessageField* const field = definition.FindField(first);
    if (field == nullptr) {
      return Error{.message = definition.name + " has no field '" + first + "'",
                   .hint = NearestNameHint(first, FieldsOf(definition))};
    }
    Step step;
    for (const MessageField& each : definition.fields) {
      auto inside = &each == field ? Of(each, name.substr(end)) : DefaultStep(each, library_);
      if (!inside) return inside.error();
      inside->name = each.name;
      step.inside.push_back(std::move(*inside));
      if (&each == field) break;
    }
    return step;
  }

  // What `rest` says behind the name of the field.
  Result<Step> Of(const MessageField& field, std::string_view rest) {
    if (rest.empty()) return Itself(field);
    if (rest.starts_with('[')) return Element(field, rest);
    if (rest.starts_with('.')) rest.remove_prefix(1);
    if (field.count != MessageCount::kOne) {
      return Error{.message = "'" + field.name + "' is a list",
                   .hint = "say which of its elements: " + field.name + "[0]." + std::string(rest)};
    }
    if (field.type != MessageType::kNested) return Error{.message = "'" + field.name + "' has no fields"};
    const auto nested = library_.Get(field.nested);
    return nested ? Within(**nested, rest) : nested.error();
  }

  Result<Step> Element(const MessageField& field, std::string_view rest) {
    if (field.count == MessageCount::kOne) return Error{.message = "'" + field.name + "' has no elements"};
    const std::size_t end = rest.find(']');
    const auto index =
        end == std::string_view::npos ? std::nullopt : NumberIn<std::size_t>(std::string(rest.substr(1, end - 1)));
    if (!index)
      return Error{.message = "'" + std::string(rest) + "' names no element", .hint = "write [INDEX], counted from 0"};
    if (field.count != MessageCount::kList && *index >= field.capacity) {
      return Error{.message = "'" + field.name + "' has no element [" + std::to_string(*index) + "]",
                   .hint = "it has " + std::to_string(field.capacity) +
                           (field.count == MessageCount::kArray ? "" : " at most") + ", counted from 0"};
    }
    auto inside = Of(One(field), rest.substr(end + 1));
    if (!inside) return inside;
    auto before = DefaultStep(One(field), library_);
    if (!before) return before;
    Step step{.kind = Step::Kind::kElement, .count = field.count, .capacity = field.capacity, .index = *index};
    step.inside.push_back(std::move(*inside));
    step.element.push_back(std::move(*before));
    return step;
  }

  Result<Step> Itself(const MessageField& field) {
    auto bound = BindPart(field, type_, options_, library_);
    if (bound) {
      why_no_decoding_ = std::move(bound->why_no_decoding);
      return std::move(bound->root);
    }
    Error error = bound.error().WithContext("field '" + options_.field + "'");
    error.hint = "choose another field, or an input of its type";
    if (field.count != MessageCount::kOne) error.hint = "of its elements, the first is " + options_.field + "[0]";
    const MessageDefinition* const nested = field.count == MessageCount::kOne ? library_.Find(field.nested) : nullptr;
    if (nested != nullptr) {
      error.hint = "say which of its fields:";
      for (const std::string& each : FieldsOf(*nested)) error.hint += " " + options_.field + "." + each;
    }
    return error;
  }

  const TypeInfo& type_;
  const MessageOptions& options_;
  const MessageLibrary& library_;
  std::string why_no_decoding_;
};

bool IsSameStructure(const MessageDefinition& definition, const TypeInfo& type, const MessageLibrary& library) {
  return type.kind() == TypeKind::kStructure &&
         std::ranges::equal(definition.fields, type.fields(), [&](const MessageField& a, const FieldInfo& b) {
           return a.name == b.name && IsSame(a, *b.type, library);
         });
}

Result<Step> DefaultList(const MessageField& field, const MessageLibrary& library) {
  Step step{.kind = Kind::kNoList, .count = field.count, .capacity = field.capacity};
  auto element = DefaultStep(One(field), library);
  if (!element) return element;
  step.element.push_back(std::move(*element));
  std::string given = field.default_value;
  std::ranges::replace(given, '\'', '"');
  const auto texts = FromText<std::vector<std::string>>(given);
  if (given.empty() || !texts) return step;
  for (const std::string& text : *texts) {
    MessageField each = One(field);
    each.default_value = text;
    auto filled = DefaultStep(each, library);
    if (!filled) return filled;
    step.inside.push_back(std::move(*filled));
  }
  return step;
}

Result<Step> DefaultStructure(const MessageDefinition& definition, const MessageLibrary& library) {
  Step step{.kind = Kind::kStructure};
  for (const MessageField& field : definition.fields) {
    auto inside = DefaultStep(field, library);
    if (!inside) return inside;
    inside->name = field.name;
    step.inside.push_back(std::move(*inside));
  }
  if (definition.fields.empty()) step.inside.push_back(NumberStep(MessageType::kUint8, 0));
  return step;
}

std::string WithoutQuotes(const std::string& text) {
  const bool is_quoted = text.size() > 1 && (text.front() == '"' || text.front() == '\'');
  if (!is_quoted) return text;
  std::string inside;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] == '\\' && i + 2 < text.size()) ++i;
    inside += text[i];
  }
  return inside;
}

}  // namespace

Result<Binding> BindField(const MessageDefinition& definition, const TypeInfo& type, const MessageOptions& options,
                          const MessageLibrary& library) {
  return FieldBinder(type, options, library).Bind(definition);
}

bool IsSame(const MessageField& field, const TypeInfo& type, const MessageLibrary& library) {
  if (field.count == MessageCount::kOne && IsLeaf(type)) {
    const MessageField leaf = FieldOfLeaf(type);
    const bool is_byte = field.type == MessageType::kByte && leaf.type == MessageType::kUint8;
    if (field.type != MessageType::kNested) return leaf.type == field.type || is_byte;
    const auto* const nested = library.Find(field.nested);
    const bool is_empty = &type == &TypeOf<Signal>() && nested != nullptr && nested->fields.empty();
    if (is_empty) return true;
    const bool is_time = leaf.nested == kTimeMessage || leaf.nested == kDurationMessage;
    return leaf.nested == field.nested ||
           (is_time && (field.nested == kTimeMessage || field.nested == kDurationMessage));
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

Result<Step> DefaultStep(const MessageField& field, const MessageLibrary& library) {
  if (field.count != MessageCount::kOne) return DefaultList(field, library);
  if (field.type == MessageType::kNested) {
    const auto nested = library.Get(field.nested);
    if (!nested) return nested.error();
    return DefaultStructure(**nested, library);
  }
  const std::string& text = field.default_value;
  if (SizeOf(field.type) > 0) {
    const bool is_true = text.size() == 4 && std::tolower(text.front()) == 't';
    return NumberStep(field.type, is_true ? 1 : std::strtold(text.c_str(), nullptr));
  }
  Step step = TextStep(WithoutQuotes(text));
  step.type = field.type;
  return step;
}

Step NumberStep(MessageType type, long double number) {
  return {.kind = Kind::kNoNumber, .type = type, .number = number};
}

Step TextStep(std::string text) {
  return {.kind = Kind::kNoText, .type = MessageType::kString, .text = std::move(text)};
}

Step StampStep(bool is_own) { return {.kind = Kind::kStamp, .is_own_stamp = is_own}; }

Step HeaderStep(bool is_own, const std::string& frame) {
  Step step{.kind = Kind::kStructure, .inside = {StampStep(is_own), TextStep(frame)}};
  step.inside[0].name = "stamp";
  step.inside[1].name = "frame_id";
  return step;
}

MessageField One(MessageField field) {
  field.count = MessageCount::kOne;
  field.default_value.clear();
  return field;
}

}  // namespace runnel::internal
