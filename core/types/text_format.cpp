#include "core/types/text_format.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "core/base/characters.h"
#include "core/types/type_info.h"
#include "core/types/value_tokens.h"

namespace runnel {

namespace {

std::string EnumerationText(const TypeInfo& type, const void* value) {
  const std::int64_t number = type.enumeration().get(value);
  const auto named = std::ranges::find(type.enumerators(), number, &EnumeratorInfo::value);
  return named != type.enumerators().end() ? named->name : std::to_string(number);  // a value that nobody named
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
        return WriteList(type.elements().rows(value), [&](std::size_t row) { WriteRow(type, value, row); });
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

constexpr std::string_view kWhitespace = " \t\r\n";

/// White space before anything that is taken does not count.
class TextParser {
 public:
  explicit TextParser(std::string_view text) : all_(text), rest_(text) {}

  Result<ValueTokens> ParseAll() {
    if (auto value = TakeValue(); !value) return value.error();
    if (!Rest().empty()) return ErrorExpecting("the end");
    return std::move(tokens_);
  }

 private:
  using Kind = ValueToken::Kind;

  Result<void> TakeValue() {
    if (Skip('{')) return TakeInside(Kind::kStructure, '}');
    if (Skip('[')) return TakeInside(Kind::kList, ']');
    if (Rest().starts_with('"')) return TakeQuoted();
    const std::string_view word = rest_.substr(0, rest_.find_first_of(",:]}"));
    rest_.remove_prefix(word.size());
    tokens_.Add(Kind::kWord, std::string(Trimmed(word)));
    return {};
  }

  Result<void> TakeInside(Kind kind, char end) {
    if (auto begun = tokens_.Begin(kind); !begun) return begun;
    if (!Skip(end)) {
      do {
        if (kind == Kind::kStructure) {
          if (auto name = TakeName(); !name) return name;
        }
        if (auto value = TakeValue(); !value) return value;
      } while (Skip(','));
      if (!Skip(end)) return ErrorExpecting(std::string("',' or '") + end + "'");
    }
    tokens_.End();
    return {};
  }

  // Letters, digits and underscores, and the colon.
  Result<void> TakeName() {
    const auto end = std::ranges::find_if_not(
        Rest(), [](unsigned char character) { return std::isalnum(character) != 0 || character == '_'; });
    const std::string name(rest_.begin(), end);
    rest_.remove_prefix(name.size());
    tokens_.Add(Kind::kText, name);
    return Skip(':') ? Result<void>() : ErrorExpecting("':' after '" + name + "'");
  }

  Result<void> TakeQuoted() {
    constexpr std::string_view kNames = "ntr", kMeant = "\n\t\r";
    std::string text;
    std::size_t i = 1;
    for (; i < rest_.size() && rest_[i] != '"'; ++i) {
      const bool is_escaped = rest_[i] == '\\';
      if (is_escaped && ++i == rest_.size()) break;
      const std::size_t named = is_escaped ? kNames.find(rest_[i]) : std::string_view::npos;
      text += named != std::string_view::npos ? kMeant[named] : rest_[i];
    }
    if (i >= rest_.size()) return ErrorExpecting("a text in quotation marks");
    rest_.remove_prefix(i + 1);
    tokens_.Add(Kind::kText, std::move(text));
    return {};
  }

  // What has not been taken, without white space before it.
  std::string_view Rest() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kWhitespace), rest_.size()));
    return rest_;
  }

  bool Skip(char character) {
    if (!Rest().starts_with(character)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  Error ErrorExpecting(const std::string& what) {
    const std::string where = Rest().empty() ? "at the end" : "before '" + std::string(rest_) + "'";
    return {.message = "expected " + what + " " + where + " of '" + std::string(all_) + "'"};
  }

  const std::string_view all_;
  std::string_view rest_;
  ValueTokens tokens_;
};

Result<void> SetLeafFromText(const TypeInfo& type, const ValueToken& token, void* value) {
  const LeafOperations& leaf = type.leaf();
  // A text of one word may come without quotation marks, as people write it: {file: map.pgm}.
  const bool is_meant =
      token.kind == ValueToken::Kind::kWord || (leaf.needs_quotes && token.kind == ValueToken::Kind::kText);
  if (is_meant) return leaf.from_text(token.text, value);
  return Expected(leaf.needs_quotes ? "a text in quotation marks" : "a " + type.name(), token);
}

}  // namespace

std::string ToText(const TypeInfo& type, const void* value, const TextLimits& limits) {
  TextWriter writer(limits);
  writer.Write(type, value, false);
  return writer.Take();
}

Result<ValueTokens> TokensOf(std::string_view text) { return TextParser(text).ParseAll(); }

Result<void> SetFromText(const TypeInfo& type, std::string_view text, void* value) {
  if (type.kind() == TypeKind::kLeaf) {
    return type.leaf().from_text(type.leaf().needs_quotes ? text : Trimmed(text), value);
  }
  const auto tokens = TokensOf(text);
  if (!tokens) return tokens.error();
  return SetFromTokens(type, tokens->root(), SetLeafFromText, value);
}

}  // namespace runnel
