#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/types/type_info.h"
#include "plugins/json_values/internal/json_cursor.h"

namespace runnel {

/// Walks through a description and through JSON side by side, and sets the value on the way.
class ValueReader {
 public:
  explicit ValueReader(std::string_view json) : cursor_(json) {}

  Result<void> ReadAll(const TypeInfo& type, void* value);

 private:
  static constexpr int kDeepest = 100;

  /// Where in the value the reader is: a field, or an element of a list. Left behind by an error.
  struct Step {
    const std::string* field;
    std::size_t index;
  };
  /// They outlive the reader, which tells errors by them.
  using Names = std::vector<const std::string*>;
  struct Shape {
    std::size_t rows = 0;
    std::size_t columns = 0;
  };

  Result<void> Read(const TypeInfo& type, void* value);
  Result<void> ReadKind(const TypeInfo& type, void* value);

  Result<void> ReadLeaf(const TypeInfo& type, void* value);
  Result<void> ReadBool(void* value);
  template <typename N>
  Result<void> ReadNumber(const TypeInfo& type, void* value);
  template <typename N>
  Error DoesNotFit(std::string_view digits, const TypeInfo& type);
  Result<void> ReadText(const TypeInfo& type, void* value);
  Result<void> ReadDuration(const TypeInfo& type, Duration& duration);
  Result<void> ReadPart(std::int64_t& number, std::int64_t minimum, std::int64_t maximum);
  Result<void> ReadEnumeration(const TypeInfo& type, void* value);
  Result<void> ReadNumberOfEnumeration(const TypeInfo& type, void* value);

  Result<void> ReadStructure(const TypeInfo& type, void* value);
  /// Calls `read_field` with the number of each field whose value comes next.
  template <typename ReadField>
  Result<void> ReadFields(const std::string& type, const Names& names, const ReadField& read_field);
  Result<std::size_t> TakeFieldName(const std::string& type, const Names& names,
                                    std::vector<bool>& is_given);

  Result<void> ReadSequence(const TypeInfo& type, void* value);
  Result<void> ReadElements(const TypeInfo& type, void* value, std::size_t& count);
  [[nodiscard]] Result<Shape> ShapeOfMatrix(const TypeInfo& type) const;
  [[nodiscard]] Result<std::size_t> CountRow(JsonCursor& ahead, const TypeInfo& type) const;
  Result<void> ReadMatrix(const TypeInfo& type, void* value);
  Result<void> ReadRow(const TypeInfo& type, void* value, std::size_t row);

  [[nodiscard]] Error WithPlace(Error error) const;

  JsonCursor cursor_;
  int depth_ = 0;
  std::vector<Step> steps_;
};

template <typename ReadField>
Result<void> ValueReader::ReadFields(const std::string& type, const Names& names,
                                     const ReadField& read_field) {
  if (!cursor_.Skip('{')) return cursor_.Expected("'{' before a " + type);
  if (cursor_.Skip('}')) return {};
  std::vector<bool> is_given(names.size());
  do {
    const auto field = TakeFieldName(type, names, is_given);
    if (!field) return field.error();
    steps_.push_back({names[*field], 0});
    if (auto read = read_field(*field); !read) return read;
    steps_.pop_back();
  } while (cursor_.Skip(','));
  if (!cursor_.Skip('}')) return cursor_.Expected("',' or '}' in a " + type);
  return {};
}

}  // namespace runnel
