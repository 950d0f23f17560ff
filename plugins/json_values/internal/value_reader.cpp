#include "plugins/json_values/internal/value_reader.h"

#include <algorithm>

#include "core/base/nearest_name.h"
#include "plugins/json_values/json_values.h"

namespace runnel {

Result<void> ValueReader::ReadAll(const TypeInfo& type, void* value) {
  if (auto read = Read(type, value); !read) return WithPlace(read.error());
  if (!cursor_.AtEnd()) return cursor_.Expected("the end");
  return {};
}

Result<void> ValueReader::Read(const TypeInfo& type, void* value) {
  if (depth_ == kDeepest) {
    return cursor_.ErrorHere("more than " + std::to_string(kDeepest) + " levels of nesting");
  }
  ++depth_;
  cursor_.SkipWhitespace();  // errors name the place where the value begins
  auto read = ReadKind(type, value);
  --depth_;
  return read;
}

Result<void> ValueReader::ReadKind(const TypeInfo& type, void* value) {
  switch (type.kind()) {
    case TypeKind::kOpaque:
      break;
    case TypeKind::kLeaf:
      return ReadLeaf(type, value);
    case TypeKind::kEnumeration:
      return ReadEnumeration(type, value);
    case TypeKind::kStructure:
      return ReadStructure(type, value);
    case TypeKind::kSequence:
      return ReadSequence(type, value);
    case TypeKind::kMatrix:
      return ReadMatrix(type, value);
  }
  return cursor_.ErrorHere("a " + type.name() + " cannot be read: its inside is not described");
}

Result<void> ValueReader::ReadStructure(const TypeInfo& type, void* value) {
  Names names;
  names.reserve(type.fields().size());
  for (const FieldInfo& field : type.fields()) names.push_back(&field.name);
  return ReadFields(type.name(), names, [&](std::size_t index) {
    const FieldInfo& field = type.fields()[index];
    return Read(*field.type, field.address(value));
  });
}

Result<std::size_t> ValueReader::TakeFieldName(const std::string& type, const Names& names,
                                               std::vector<bool>& is_given) {
  cursor_.SkipWhitespace();
  const JsonCursor before = cursor_;
  std::string name;
  if (auto taken = cursor_.TakeString(name); !taken) return taken.error();
  const auto found =
      std::ranges::find_if(names, [&](const std::string* each) { return *each == name; });
  const auto field = static_cast<std::size_t>(found - names.begin());
  if (found == names.end() || is_given[field]) {
    cursor_ = before;
    if (found != names.end()) return cursor_.ErrorHere("'" + name + "' is given twice");
    Error error = cursor_.ErrorHere(type + " has no field '" + name + "'");
    std::vector<std::string> known;
    for (const std::string* each : names) known.push_back(*each);
    error.hint = NearestNameHint(name, known);
    return error;
  }
  is_given[field] = true;
  if (!cursor_.Skip(':')) return cursor_.Expected("':' after \"" + name + "\"");
  return field;
}

Result<void> ValueReader::ReadSequence(const TypeInfo& type, void* value) {
  const ElementOperations& elements = type.elements();
  if (!cursor_.Skip('[')) return cursor_.Expected("'[' before a " + type.name());
  if (!elements.is_fixed) elements.resize(value, 1, 0);
  std::size_t count = 0;
  if (!cursor_.Skip(']')) {
    if (auto read = ReadElements(type, value, count); !read) return read;
    if (!cursor_.Skip(']')) return cursor_.Expected("',' or ']' in a " + type.name());
  }
  if (elements.columns(value) != count && !elements.resize(value, 1, count)) {
    return cursor_.ErrorHere(std::to_string(count) + " elements are too few for a " + type.name());
  }
  return {};
}

Result<void> ValueReader::ReadElements(const TypeInfo& type, void* value, std::size_t& count) {
  const ElementOperations& elements = type.elements();
  // Nobody has counted the elements before, so room is made for twice as many whenever there is
  // none: some lists are copied whole when they grow.
  const auto make_room = [&] {
    return count < elements.columns(value) ||
           (!elements.is_fixed && (elements.resize(value, 1, std::max<std::size_t>(4, 2 * count)) ||
                                   elements.resize(value, 1, count + 1)));
  };
  do {
    if (!make_room()) {
      return cursor_.ErrorHere("more elements than the " + std::to_string(count) + " that a " +
                               type.name() + " can have");
    }
    steps_.push_back({nullptr, count});
    if (auto read = Read(*elements.type, elements.element(value, count)); !read) return read;
    steps_.pop_back();
    ++count;
  } while (cursor_.Skip(','));
  return {};
}

Result<std::size_t> ValueReader::CountRow(JsonCursor& ahead, const TypeInfo& type) const {
  if (!ahead.Skip('[')) return ahead.Expected("'[' before a row of a " + type.name());
  std::size_t columns = 0;
  if (ahead.Skip(']')) return columns;
  do {
    if (!ahead.SkipValue(kDeepest - depth_)) return ahead.Expected("an element");
    ++columns;
  } while (ahead.Skip(','));
  if (!ahead.Skip(']')) return ahead.Expected("',' or ']' in a row");
  return columns;
}

// The rows must be counted before the matrix can be made; so the text is gone through twice.
Result<ValueReader::Shape> ValueReader::ShapeOfMatrix(const TypeInfo& type) const {
  JsonCursor ahead = cursor_;
  Shape shape;
  if (!ahead.Skip('[')) return ahead.Expected("'[' before a " + type.name());
  if (ahead.Skip(']')) return shape;
  do {
    const auto columns = CountRow(ahead, type);
    if (!columns) return columns.error();
    if (shape.rows > 0 && *columns != shape.columns) {
      return ahead.ErrorHere("the rows differ in length: " + std::to_string(shape.columns) +
                             " and " + std::to_string(*columns));
    }
    shape = {shape.rows + 1, *columns};
  } while (ahead.Skip(','));
  if (!ahead.Skip(']')) return ahead.Expected("',' or ']' after a row");
  return shape;
}

Result<void> ValueReader::ReadMatrix(const TypeInfo& type, void* value) {
  const ElementOperations& elements = type.elements();
  const auto shape = ShapeOfMatrix(type);
  if (!shape) return shape.error();
  // Without rows nothing tells how many columns there are.
  const std::size_t columns = shape->rows == 0 ? elements.columns(value) : shape->columns;
  if (!elements.resize(value, shape->rows, shape->columns) &&
      !elements.resize(value, shape->rows, columns)) {
    return cursor_.ErrorHere(std::to_string(shape->rows) + " rows of " +
                             std::to_string(shape->columns) + " are no " + type.name());
  }
  cursor_.Skip('[');
  for (std::size_t row = 0; row < shape->rows; ++row) {
    if (row > 0) cursor_.Skip(',');
    if (auto read = ReadRow(type, value, row); !read) return read;
  }
  cursor_.Skip(']');
  return {};
}

Result<void> ValueReader::ReadRow(const TypeInfo& type, void* value, std::size_t row) {
  const ElementOperations& elements = type.elements();
  const std::size_t columns = elements.columns(value);
  cursor_.Skip('[');
  steps_.push_back({nullptr, row});
  for (std::size_t column = 0; column < columns; ++column) {
    if (column > 0) cursor_.Skip(',');
    steps_.push_back({nullptr, column});
    auto read = Read(*elements.type, elements.element(value, row * columns + column));
    if (!read) return read;
    steps_.pop_back();
  }
  steps_.pop_back();
  cursor_.Skip(']');
  return {};
}

Error ValueReader::WithPlace(Error error) const {
  std::string place;
  for (const Step& step : steps_) {
    if (step.field == nullptr) {
      place += "[" + std::to_string(step.index) + "]";
    } else {
      place += (place.empty() ? "" : ".") + *step.field;
    }
  }
  if (!place.empty()) error.message = place + ": " + error.message;
  return error;
}

Result<void> SetFromJson(const TypeInfo& type, std::string_view json, void* value) {
  return ValueReader(json).ReadAll(type, value);
}

}  // namespace runnel
