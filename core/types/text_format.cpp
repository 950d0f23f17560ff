#include "core/types/text_format.h"

#include <utility>

#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "core/types/internal/parts.h"
#include "core/types/internal/text_cursor.h"
#include "core/types/type_info.h"

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

constexpr int kMostNested = 100;
constexpr std::size_t kMostBytes = std::size_t{1} << 28;  // of elements, 256 MiB

/// Reads one value. What comes from outside may be nested as deep as it is long, and a few bytes can promise much:
/// both are limited.
class TextReader {
 public:
  explicit TextReader(std::string_view text) : cursor_(text) {}

  Result<void> ReadAll(const TypeInfo& type, void* value) {
    try {
      Read(type, value);
      if (!cursor_.AtEnd()) Fail(cursor_.Expected("the end"));
    } catch (const Failure& failure) {
      return failure.error;
    }
    return {};
  }

 private:
  struct Failure {
    Error error;
  };
  [[noreturn]] static void Fail(Error error) { throw Failure{std::move(error)}; }

  void Need(char character, std::string_view what, std::string_view of = {}) {
    if (!cursor_.Skip(character)) Fail(cursor_.Expected(std::string(what).append(of)));
  }
  static void Check(const Result<void>& done) {
    if (!done) Fail(done.error());
  }

  void Read(const TypeInfo& type, void* value) {
    if (++nested_ > kMostNested) {
      Fail({.message = "a " + type.name() + " is nested deeper than " +
                       std::to_string(kMostNested) + " levels"});
    }
    switch (type.kind()) {
      case TypeKind::kOpaque:
        Fail({.message = "a " + type.name() + " has no text format"});
      case TypeKind::kLeaf:
        ReadLeaf(type.leaf(), value);
        break;
      case TypeKind::kEnumeration:
        ReadEnumeration(type, value);
        break;
      case TypeKind::kStructure:
        ReadStructure(type, value);
        break;
      case TypeKind::kSequence:
        ReadSequence(type, value);
        break;
      case TypeKind::kMatrix:
        ReadMatrix(type, value);
        break;
    }
    --nested_;
  }

  void ReadLeaf(const LeafOperations& leaf, void* value) {
    if (!leaf.needs_quotes) return Check(leaf.from_text(cursor_.TakeToken(), value));
    std::string text;
    if (!cursor_.TakeQuoted(text)) Fail(cursor_.Expected("a text in quotation marks"));
    Check(leaf.from_text(text, value));
  }

  void ReadEnumeration(const TypeInfo& type, void* value) {
    const std::string_view text = cursor_.TakeToken();
    for (const EnumeratorInfo& each : type.enumerators()) {
      if (each.name == text || std::to_string(each.value) == text) {
        return type.enumeration().set(value, each.value);
      }
    }
    Fail({.message = "there is no " + type.name() + " '" + std::string(text) + "'",
          .hint = NearestNameHint(text, NamesOf(type.enumerators(), &EnumeratorInfo::name))});
  }

  void ReadStructure(const TypeInfo& type, void* value) {
    Need('{', "'{' before a ", type.name());
    if (cursor_.Skip('}')) return;
    do {
      ReadField(type, value);
    } while (cursor_.Skip(','));
    Need('}', "',' or '}' in a ", type.name());
  }

  void ReadField(const TypeInfo& type, void* value) {
    const std::string_view name = cursor_.TakeWord();
    const FieldInfo* const field = type.FindField(name);
    if (field == nullptr) {
      Fail({.message = type.name() + " has no field '" + std::string(name) + "'",
            .hint = NearestNameHint(name, NamesOf(type.fields(), &FieldInfo::name))});
    }
    if (!cursor_.Skip(':')) Fail(cursor_.Expected("':' after '" + field->name + "'"));
    Read(*field->type, field->address(value));
  }

  // Makes room for elements one by one, since nobody has counted them before.
  void ReadSequence(const TypeInfo& type, void* value) {
    const ElementOperations& elements = type.elements();
    Need('[', "'[' before a ", type.name());
    std::size_t count = 0;
    if (!cursor_.Skip(']')) {
      do {
        TakeRoom(1, type);
        if (!elements.is_fixed && !elements.resize(value, 1, count + 1)) {
          Fail({.message = "a " + type.name() + " cannot have that many elements"});
        }
        if (count >= elements.rows(value) * elements.columns(value)) {
          Fail({.message = "too many elements for a " + type.name()});
        }
        Read(*elements.type, elements.element(value, count));
        ++count;
      } while (cursor_.Skip(','));
      Need(']', "',' or ']' in a ", type.name());
    }
    if (!elements.resize(value, 1, count)) {
      Fail({.message = "too few elements for a " + type.name()});
    }
  }

  void TakeRoom(std::size_t count, const TypeInfo& type) {
    const std::size_t size = type.elements().type->size();
    if (size > 0 && count > (kMostBytes - bytes_) / size) {
      Fail({.message = "a " + type.name() +
                       " has too many elements: together with what it is part of, " +
                       "they take more than " + std::to_string(kMostBytes >> 20) + " MiB"});
    }
    bytes_ += count * size;
  }

  // The first row tells how many columns there are; so the text is gone through twice.
  std::pair<std::size_t, std::size_t> TakeShapeOfMatrix() {
    std::size_t rows = 0, columns = 0;
    Need('[', "'[' before a matrix");
    if (cursor_.Skip(']')) return {rows, columns};
    do {
      Need('[', "'[' before a row");
      std::size_t count = 0;
      if (!cursor_.Skip(']')) {
        do {
          cursor_.TakeToken();
          ++count;
        } while (cursor_.Skip(','));
        Need(']', "',' or ']' in a row");
      }
      if (rows > 0 && count != columns) Fail({.message = "the rows differ in length"});
      columns = count;
      ++rows;
    } while (cursor_.Skip(','));
    return {rows, columns};
  }

  void ReadMatrix(const TypeInfo& type, void* value) {
    const ElementOperations& elements = type.elements();
    const TextCursor before = cursor_;
    const auto [rows, columns] = TakeShapeOfMatrix();
    cursor_ = before;
    TakeRoom(rows * columns, type);
    if (!elements.resize(value, rows, columns)) {
      Fail({.message = std::to_string(rows) + " rows of " + std::to_string(columns) + " are no " +
                       type.name()});
    }
    cursor_.Skip('[');
    for (std::size_t row = 0; row < rows; ++row) {
      cursor_.Skip('[');
      for (std::size_t column = 0; column < columns; ++column) {
        Read(*elements.type, elements.element(value, row * columns + column));
        cursor_.Skip(',');
      }
      cursor_.Skip(']');
      cursor_.Skip(',');
    }
    Need(']', "']' after a ", type.name());
  }

  TextCursor cursor_;
  int nested_ = 0;
  std::size_t bytes_ = 0;
};

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
  return TextReader(text).ReadAll(type, value);
}

}  // namespace runnel
