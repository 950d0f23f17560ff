#include "core/types/value_tokens.h"

#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

using Kind = ValueToken::Kind;

constexpr std::size_t kMostBytes = std::size_t{1} << 28;  // of elements, 256 MiB

/// Walks through a description and through tokens side by side, and sets the value on the way.
class ValueReader {
 public:
  explicit ValueReader(LeafReader read_leaf) : read_leaf_(read_leaf) {}

  Result<void> ReadAll(const TypeInfo& type, const ValueToken& token, void* value) {
    auto read = Read(type, token, value);
    if (read || steps_.empty()) return read;
    std::string path;
    for (const Step& step : steps_) {
      if (step.field.empty()) {
        path += "[" + std::to_string(step.index) + "]";
      } else {
        path.append(path.empty() ? "" : ".").append(step.field);
      }
    }
    return read.error().WithContext(path);
  }

 private:
  // Where in the value the reader is: a field, or an element of a list. Left behind by a failure.
  struct Step {
    std::string_view field;
    std::size_t index;
  };

  Result<void> Read(const TypeInfo& type, const ValueToken& token, void* value) {
    switch (type.kind()) {
      case TypeKind::kOpaque:
        break;
      case TypeKind::kLeaf:
        return read_leaf_(type, token, value);
      case TypeKind::kEnumeration:
        return ReadEnumeration(type, token, value);
      case TypeKind::kStructure:
        return ReadStructure(type, token, value);
      case TypeKind::kSequence:
        return ReadSequence(type, token, value);
      case TypeKind::kMatrix:
        return ReadMatrix(type, token, value);
    }
    return Error{.message = "a " + type.name() + " has no text format: its inside is not described"};
  }

  Result<void> ReadAt(const Step& step, const TypeInfo& type, const ValueToken& token, void* value) {
    steps_.push_back(step);
    auto read = Read(type, token, value);
    if (read) steps_.pop_back();
    return read;
  }

  static Result<void> ReadEnumeration(const TypeInfo& type, const ValueToken& token, void* value) {
    if (token.kind != Kind::kWord && token.kind != Kind::kText) {
      return Expected("the name of a " + type.name(), token);
    }
    for (const EnumeratorInfo& each : type.enumerators()) {
      const bool is_number = token.kind == Kind::kWord && std::to_string(each.value) == token.text;
      if (each.name != token.text && !is_number) continue;
      type.enumeration().set(value, each.value);
      return {};
    }
    return Error{.message = "there is no " + type.name() + " '" + token.text + "'",
                 .hint = NearestNameHint(token.text, NamesOf(type.enumerators(), &EnumeratorInfo::name))};
  }

  Result<void> ReadStructure(const TypeInfo& type, const ValueToken& token, void* value) {
    if (token.kind != Kind::kStructure) return Expected("'{' before a " + type.name(), token);
    std::vector<bool> is_given(type.fields().size());
    const ValueToken* name = token.First();
    for (std::size_t i = 0; i < token.count; i += 2) {
      const FieldInfo* const field = type.FindField(name->text);
      if (field == nullptr) {
        return Error{.message = type.name() + " has no field '" + name->text + "'",
                     .hint = NearestNameHint(name->text, NamesOf(type.fields(), &FieldInfo::name))};
      }
      const auto index = static_cast<std::size_t>(field - type.fields().data());
      if (is_given[index]) return Error{.message = "'" + name->text + "' is given twice"};
      is_given[index] = true;
      const ValueToken* const given = name->Next();
      auto read = ReadAt({field->name, 0}, *field->type, *given, field->address(value));
      if (!read) return read;
      name = given->Next();
    }
    return {};
  }

  Result<void> ReadSequence(const TypeInfo& type, const ValueToken& token, void* value) {
    const ElementOperations& elements = type.elements();
    if (token.kind != Kind::kList) return Expected("'[' before a " + type.name(), token);
    if (auto room = TakeRoom(token.count, type); !room) return room;
    if (!elements.is_fixed) elements.resize(value, 1, 0);
    if (!elements.resize(value, 1, token.count)) {
      const bool are_few = elements.is_fixed && token.count < elements.columns(value);
      return Error{.message = std::to_string(token.count) + " elements are too " + (are_few ? "few" : "many") +
                              " for a " + type.name()};
    }
    return ReadRow(type, token, value, 0);
  }

  Result<void> ReadRow(const TypeInfo& type, const ValueToken& row, void* value, std::size_t first) {
    const ElementOperations& elements = type.elements();
    const ValueToken* token = row.First();
    for (std::size_t i = 0; i < row.count; ++i, token = token->Next()) {
      auto read = ReadAt({{}, i}, *elements.type, *token, elements.element(value, first + i));
      if (!read) return read;
    }
    return {};
  }

  Result<void> ReadMatrix(const TypeInfo& type, const ValueToken& token, void* value) {
    const ElementOperations& elements = type.elements();
    if (token.kind != Kind::kList) return Expected("'[' before a " + type.name(), token);
    const std::size_t rows = token.count;
    const std::size_t columns = rows > 0 ? token.First()->count : 0;
    const ValueToken* row = token.First();
    for (std::size_t i = 0; i < rows; ++i, row = row->Next()) {
      if (row->kind != Kind::kList) return Expected("'[' before a row of a " + type.name(), *row);
      if (row->count == columns) continue;
      return Error{.message =
                       "the rows differ in length: " + std::to_string(columns) + " and " + std::to_string(row->count)};
    }
    if (auto room = TakeRoom(rows * columns, type); !room) return room;
    // Without rows nothing tells how many columns there are.
    if (!elements.resize(value, rows, columns) && (rows > 0 || !elements.resize(value, 0, elements.columns(value)))) {
      return Error{.message = std::to_string(rows) + " rows of " + std::to_string(columns) + " are no " + type.name()};
    }
    row = token.First();
    for (std::size_t i = 0; i < rows; ++i, row = row->Next()) {
      steps_.push_back({{}, i});
      if (auto read = ReadRow(type, *row, value, i * columns); !read) return read;
      steps_.pop_back();
    }
    return {};
  }

  Result<void> TakeRoom(std::size_t count, const TypeInfo& type) {
    const std::size_t size = type.elements().type->size();
    if (size > 0 && count > (kMostBytes - bytes_) / size) {
      return Error{.message = "a " + type.name() + " has too many elements: together with what it is part of, " +
                              "they take more than " + std::to_string(kMostBytes >> 20) + " MiB"};
    }
    bytes_ += count * size;
    return {};
  }

  const LeafReader read_leaf_;
  std::vector<Step> steps_;
  std::size_t bytes_ = 0;
};

}  // namespace

void ValueTokens::Add(Kind kind, std::string text) {
  if (!open_.empty()) ++tokens_[open_.back()].count;
  tokens_.push_back({kind, std::move(text)});
}

Result<void> ValueTokens::Begin(Kind kind) {
  if (open_.size() == static_cast<std::size_t>(deepest_)) {
    return Error{.message = "it is nested deeper than " + std::to_string(deepest_) + " levels"};
  }
  Add(kind, {});
  open_.push_back(tokens_.size() - 1);
  return {};
}

void ValueTokens::End() {
  tokens_[open_.back()].extent = tokens_.size() - open_.back();
  open_.pop_back();
}

Result<void> SetFromTokens(const TypeInfo& type, const ValueToken& token, LeafReader read_leaf, void* value) {
  return ValueReader(read_leaf).ReadAll(type, token, value);
}

Error Expected(std::string_view what, const ValueToken& found) {
  constexpr std::size_t kShown = 20;
  std::string shown = Shortened(found.text, kShown);
  if (found.kind == Kind::kText) shown = Quoted(shown);
  if (found.kind == Kind::kList) shown = "[";
  if (found.kind == Kind::kStructure) shown = "{";
  return {.message = "expected " + std::string(what) + ", found '" + shown + "'"};
}

}  // namespace runnel
