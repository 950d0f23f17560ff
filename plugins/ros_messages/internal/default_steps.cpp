#include "plugins/ros_messages/internal/binding.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <utility>

#include "core/types/type_of.h"

namespace runnel::internal {

namespace {

using Kind = Step::Kind;

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

Step StampStep(bool is_own) {
  return {.kind = Kind::kStamp, .is_own_stamp = is_own};
}

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
