#include "core/types/text_format.h"

#include <utility>

#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "core/types/internal/parts.h"
#include "core/types/internal/reading_limits.h"
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

Result<void> ReadEnumeration(const TypeInfo& type, std::string_view text, void* value) {
  std::vector<std::string> names;
  for (const EnumeratorInfo& each : type.enumerators()) {
    if (each.name == text || std::to_string(each.value) == text) {
      type.enumeration().set(value, each.value);
      return {};
    }
    names.push_back(each.name);
  }
  return Error{.message = "there is no " + type.name() + " '" + std::string(text) + "'",
               .hint = NearestNameHint(text, names)};
}

Error TooLarge(const TypeInfo& type) {
  return {.message =
              "a " + type.name() + " has too many elements: together with what it is part of, " +
              "they take more than " + std::to_string(ReadingLimits::kMostBytes >> 20) + " MiB"};
}

Result<void> Read(const TypeInfo& type, TextCursor& cursor, ReadingLimits& limits, void* value);

Result<void> ReadField(const TypeInfo& type, TextCursor& cursor, ReadingLimits& limits,
                       void* value) {
  const std::string_view name = cursor.TakeWord();
  const FieldInfo* field = type.FindField(name);
  if (field == nullptr) {
    std::vector<std::string> names;
    for (const FieldInfo& each : type.fields()) names.push_back(each.name);
    return Error{.message = type.name() + " has no field '" + std::string(name) + "'",
                 .hint = NearestNameHint(name, names)};
  }
  if (!cursor.Skip(':')) return cursor.Expected("':' after '" + field->name + "'");
  return Read(*field->type, cursor, limits, field->address(value));
}

Result<void> ReadStructure(const TypeInfo& type, TextCursor& cursor, ReadingLimits& limits,
                           void* value) {
  if (!cursor.Skip('{')) return cursor.Expected("'{' before a " + type.name());
  if (cursor.Skip('}')) return {};
  do {
    if (auto read = ReadField(type, cursor, limits, value); !read) return read;
  } while (cursor.Skip(','));
  if (!cursor.Skip('}')) return cursor.Expected("',' or '}' in a " + type.name());
  return {};
}

// Makes room one by one, since nobody has counted the elements before.
Result<void> ReadElement(const TypeInfo& type, TextCursor& cursor, ReadingLimits& limits,
                         void* value, std::size_t rows, std::size_t columns, std::size_t index) {
  const ElementOperations& elements = type.elements();
  if (!limits.Take(1, elements.type->size())) return TooLarge(type);
  if (!elements.is_fixed && !elements.resize(value, rows, columns)) {
    return Error{.message = "a " + type.name() + " cannot have that many elements"};
  }
  if (index >= elements.rows(value) * elements.columns(value)) {
    return Error{.message = "too many elements for a " + type.name()};
  }
  return Read(*elements.type, cursor, limits, elements.element(value, index));
}

Result<void> ReadSequence(const TypeInfo& type, TextCursor& cursor, ReadingLimits& limits,
                          void* value) {
  if (!cursor.Skip('[')) return cursor.Expected("'[' before a " + type.name());
  std::size_t count = 0;
  if (!cursor.Skip(']')) {
    do {
      if (auto read = ReadElement(type, cursor, limits, value, 1, count + 1, count); !read)
        return read;
      ++count;
    } while (cursor.Skip(','));
    if (!cursor.Skip(']')) return cursor.Expected("',' or ']' in a " + type.name());
  }
  if (!type.elements().resize(value, 1, count)) {
    return Error{.message = "too few elements for a " + type.name()};
  }
  return {};
}

// The first row tells how many columns there are; so the text is gone through twice.
Result<std::pair<std::size_t, std::size_t>> ShapeOfMatrix(TextCursor cursor) {
  std::size_t rows = 0, columns = 0;
  if (!cursor.Skip('[')) return cursor.Expected("'[' before a matrix");
  if (cursor.Skip(']')) return std::pair{rows, columns};
  do {
    if (!cursor.Skip('[')) return cursor.Expected("'[' before a row");
    std::size_t count = 0;
    if (!cursor.Skip(']')) {
      do {
        cursor.TakeToken();
        ++count;
      } while (cursor.Skip(','));
      if (!cursor.Skip(']')) return cursor.Expected("',' or ']' in a row");
    }
    if (rows > 0 && count != columns) return Error{.message = "the rows differ in length"};
    columns = count;
    ++rows;
  } while (cursor.Skip(','));
  return std::pair{rows, columns};
}

Result<void> ReadMatrix(const TypeInfo& type, TextCursor& cursor, ReadingLimits& limits,
                        void* value) {
  const ElementOperations& elements = type.elements();
  const auto shape = ShapeOfMatrix(cursor);
  if (!shape) return shape.error();
  const auto [rows, columns] = *shape;
  if (!limits.Take(rows * columns, elements.type->size())) return TooLarge(type);
  if (!elements.resize(value, rows, columns)) {
    return Error{.message = std::to_string(rows) + " rows of " + std::to_string(columns) +
                            " are no " + type.name()};
  }
  cursor.Skip('[');
  for (std::size_t index = 0; index < rows * columns; ++index) {
    if (index % columns == 0) cursor.Skip('[');
    if (auto read = Read(*elements.type, cursor, limits, elements.element(value, index)); !read) {
      return read;
    }
    if (!cursor.Skip(',')) {
      cursor.Skip(']');
      cursor.Skip(',');
    }
  }
  while (columns == 0 && cursor.Skip('[')) {
    cursor.Skip(']');
    cursor.Skip(',');
  }
  if (!cursor.Skip(']')) return cursor.Expected("']' after a " + type.name());
  return {};
}

Result<void> Read(const TypeInfo& type, TextCursor& cursor, ReadingLimits& limits, void* value) {
  const ReadingLimits::Level level(limits);
  if (level.is_too_deep()) {
    return Error{.message = "a " + type.name() + " is nested deeper than " +
                            std::to_string(ReadingLimits::kMostNested) + " levels"};
  }
  switch (type.kind()) {
    case TypeKind::kOpaque:
      return Error{.message = "a " + type.name() + " has no text format"};
    case TypeKind::kLeaf: {
      std::string text;
      if (!type.leaf().needs_quotes) {
        return type.leaf().from_text(cursor.TakeToken(), value);
      }
      if (!cursor.TakeQuoted(text)) return cursor.Expected("a text in quotation marks");
      return type.leaf().from_text(text, value);
    }
    case TypeKind::kEnumeration:
      return ReadEnumeration(type, cursor.TakeToken(), value);
    case TypeKind::kStructure:
      return ReadStructure(type, cursor, limits, value);
    case TypeKind::kSequence:
      return ReadSequence(type, cursor, limits, value);
    case TypeKind::kMatrix:
      return ReadMatrix(type, cursor, limits, value);
  }
  return Error{.message = "a " + type.name() + " has no text format"};
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
  TextCursor cursor(text);
  ReadingLimits limits;
  if (auto read = Read(type, cursor, limits, value); !read) return read;
  if (!cursor.AtEnd()) return cursor.Expected("the end");
  return {};
}

}  // namespace runnel
