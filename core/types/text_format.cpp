#include "core/types/text_format.h"

#include <utility>

#include "core/base/characters.h"
#include "core/types/internal/text_tokens.h"
#include "core/types/type_info.h"
#include "core/types/value_tokens.h"

namespace runnel {

namespace {

std::string EnumerationText(const TypeInfo& type, const void* value) {
  const std::int64_t number = type.enumeration().get(value);
  for (const EnumeratorInfo& each : type.enumerators()) {
    if (each.value == number) return each.name;
  }
  return std::to_string(number);  // a value that nobody named
}

class TextWriter {
 public:
  explicit TextWriter(const TextLimits& limits) : limits_(limits) {}

  // `is_inner`: within a structure or a list, where strings need marks at their ends.
  void Write(const TypeInfo& type, const void* value, bool is_inner) {
    switch (type.kind()) {
      case TypeKind::kOpaque:
        text_ += '?';
        return;
      case TypeKind::kLeaf:
        return WriteLeaf(type.leaf(), value, is_inner);
      case TypeKind::kEnumeration:
        text_ += EnumerationText(type, value);
        return;
      case TypeKind::kStructure:
        return WriteStructure(type, value);
      case TypeKind::kSequence:
        return WriteRow(type, value, 0);
      case TypeKind::kMatrix:
        return WriteList(type.elements().rows(value),
                         [&](std::size_t row) { WriteRow(type, value, row); });
    }
  }
  [[nodiscard]] std::string Take() { return std::move(text_); }

 private:
  [[nodiscard]] bool IsFull() const { return text_.size() >= limits_.all; }

  void WriteLeaf(const LeafOperations& leaf, const void* value, bool is_inner) {
    std::string text = leaf.to_text(value);
    const std::size_t size = text.size();
    const bool is_cut = size > limits_.text;
    if (is_cut) text = Shortened(std::move(text), limits_.text);
    text_ += is_inner && leaf.needs_quotes ? Quoted(text) : text;
    if (is_cut) text_ += " " + std::to_string(size) + " bytes in all";
  }
  void WriteStructure(const TypeInfo& type, const void* value) {
    text_ += '{';
    const char* separator = "";
    for (const FieldInfo& field : type.fields()) {
      text_.append(separator).append(field.name).append(": ");
      if (IsFull()) {
        text_ += "…";
        break;
      }
      Write(*field.type, field.address(ForLooking(value)), true);
      separator = ", ";
    }
    text_ += '}';
  }
  void WriteRow(const TypeInfo& type, const void* value, std::size_t row) {
    const ElementOperations& elements = type.elements();
    const std::size_t columns = elements.columns(value);
    WriteList(columns, [&](std::size_t i) {
      Write(*elements.type, elements.element(ForLooking(value), row * columns + i), true);
    });
  }
  template <typename WriteOne>
  void WriteList(std::size_t count, const WriteOne& write_one) {
    text_ += '[';
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) text_ += ", ";
      if (i >= limits_.elements || IsFull()) {
        text_ += "… " + std::to_string(count) + " in all";
        break;
      }
      write_one(i);
    }
    text_ += ']';
  }

  const TextLimits& limits_;
  std::string text_;
};

Result<void> SetLeafFromText(const TypeInfo& type, const ValueToken& token, void* value) {
  const LeafOperations& leaf = type.leaf();
  // A text of one word may come without quotation marks, as people write it: {file: map.pgm}.
  const bool is_meant = token.kind == ValueToken::Kind::kWord ||
                        (leaf.needs_quotes && token.kind == ValueToken::Kind::kText);
  if (is_meant) return leaf.from_text(token.text, value);
  return Expected(leaf.needs_quotes ? "a text in quotation marks" : "a " + type.name(), token);
}

}  // namespace

std::string ToText(const TypeInfo& type, const void* value, const TextLimits& limits) {
  TextWriter writer(limits);
  writer.Write(type, value, false);
  return writer.Take();
}

Result<void> SetFromText(const TypeInfo& type, std::string_view text, void* value) {
  if (type.kind() == TypeKind::kLeaf) {
    return type.leaf().from_text(type.leaf().needs_quotes ? text : WithoutWhitespace(text), value);
  }
  const auto tokens = TokensOf(text);
  if (!tokens) return tokens.error();
  return SetFromTokens(type, tokens->root(), SetLeafFromText, value);
}

}  // namespace runnel
