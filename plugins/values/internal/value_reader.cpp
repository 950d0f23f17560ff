#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/types/type_info.h"
#include "plugins/values/internal/json_cursor.h"
#include "plugins/values/internal/leaf_types.h"
#include "plugins/values/json_values.h"

namespace runnel {

namespace {

/// Walks through a description and through JSON side by side, and sets the value on the way.
class ValueReader {
 public:
  explicit ValueReader(std::string_view json) : cursor_(json) {}

  Result<void> ReadAll(const TypeInfo& type, void* value) {
    try {
      Read(type, value);
    } catch (const JsonFailure& failure) {
      return WithPath(failure.error);
    }
    if (!cursor_.AtEnd()) return cursor_.ExpectedAt(cursor_.place(), "the end");
    return {};
  }

 private:
  static constexpr int kDeepest = 100;

  // Where in the value the reader is: a field, or an element of a list. Left behind by a failure.
  struct Step {
    std::string_view field;
    std::size_t index;
  };
  using Names = std::vector<std::string_view>;
  struct Shape {
    std::size_t rows = 0;
    std::size_t columns = 0;
  };

  void Read(const TypeInfo& type, void* value) {
    if (depth_ == kDeepest) {
      cursor_.Fail("more than " + std::to_string(kDeepest) + " levels of nesting");
    }
    ++depth_;
    cursor_.SkipWhitespace();  // errors name the place where the value begins
    switch (type.kind()) {
      case TypeKind::kOpaque:
        cursor_.Fail("a " + type.name() + " cannot be read: its inside is not described");
      case TypeKind::kLeaf:
        ReadLeaf(type, value);
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
    --depth_;
  }

  void ReadLeaf(const TypeInfo& type, void* value) {
    WithLeafType(type, [&]<typename T>(std::type_identity<T>) {
      if constexpr (std::same_as<T, bool>) {
        const bool is_true = cursor_.SkipWord("true");
        if (!is_true && !cursor_.SkipWord("false")) cursor_.FailExpecting("true or false");
        *static_cast<bool*>(value) = is_true;
      } else if constexpr (std::is_arithmetic_v<T>) {
        ReadNumber(type, *static_cast<T*>(value));
      } else if constexpr (std::same_as<T, std::string>) {
        cursor_.TakeString(*static_cast<std::string*>(value));
      } else if constexpr (std::same_as<T, Duration> || std::same_as<T, Time>) {
        *static_cast<T*>(value) = T(ReadDuration(type));
      } else {
        ReadText(type, value);
      }
    });
  }

  template <typename N>
  void ReadNumber(const TypeInfo& type, N& value) {
    const std::size_t place = cursor_.place();
    if constexpr (std::floating_point<N>) {
      if (cursor_.SkipWord("null")) {
        value = std::numeric_limits<N>::quiet_NaN();
        return;
      }
    }
    const std::string_view digits = cursor_.TakeNumber();
    if (digits.empty()) {
      cursor_.FailExpecting(std::floating_point<N> ? "a number" : "a whole number");
    }
    const auto number = NumberOf<N>(digits);
    if (!number) {
      using Limits = std::numeric_limits<N>;
      cursor_.FailAt(place, "'" + std::string(digits) + "' does not fit into " + type.name(),
                     std::floating_point<N>
                         ? ""
                         : "allowed are whole numbers " + std::to_string(Limits::lowest()) +
                               " .. " + std::to_string(Limits::max()));
    }
    value = *number;
  }

  // A leaf with a text format of its own.
  void ReadText(const TypeInfo& type, void* value) {
    const std::size_t place = cursor_.place();
    std::string text;
    cursor_.TakeString(text);
    const auto set = type.leaf().from_text(text, value);
    if (!set) cursor_.FailAt(place, set.error().message, set.error().hint);
  }

  Duration ReadDuration(const TypeInfo& type) {
    constexpr std::int64_t kPerSecond = 1'000'000'000;
    constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
    std::int64_t seconds = 0, nanoseconds = 0;
    ReadFields(type.name(), {"sec", "nsec"}, [&](std::size_t field) {
      if (field == 0) {
        seconds = ReadPart(-kMost, kMost);
      } else {
        nanoseconds = ReadPart(0, kPerSecond - 1);
      }
    });
    // The earliest time lies in a second whose begin cannot be said in nanoseconds.
    if (seconds < 0) {
      ++seconds;
      nanoseconds -= kPerSecond;
    }
    std::int64_t sum = 0;
    if (__builtin_mul_overflow(seconds, kPerSecond, &sum) ||
        __builtin_add_overflow(sum, nanoseconds, &sum)) {
      cursor_.Fail("a " + type.name() + " cannot be that long");
    }
    return Duration(sum);
  }

  std::int64_t ReadPart(std::int64_t minimum, std::int64_t maximum) {
    cursor_.SkipWhitespace();
    const std::size_t place = cursor_.place();
    const auto read = NumberOf<std::int64_t>(cursor_.TakeNumber());
    if (read && *read >= minimum && *read <= maximum) return *read;
    throw JsonFailure{cursor_.ExpectedAt(
        place, "a whole number, " + std::to_string(minimum) + " .. " + std::to_string(maximum))};
  }

  void ReadEnumeration(const TypeInfo& type, void* value) {
    const std::size_t place = cursor_.place();
    std::string name;
    std::optional<std::int64_t> number;
    const bool is_text = cursor_.Peek() == '"';
    if (is_text) {
      cursor_.TakeString(name);
    } else {
      number = NumberOf<std::int64_t>(cursor_.TakeNumber());
    }
    for (const EnumeratorInfo& each : type.enumerators()) {
      if (is_text ? each.name == name : number == each.value) {
        return type.enumeration().set(value, each.value);
      }
    }
    const std::string hint =
        NearestNameHint(name, NamesOf(type.enumerators(), &EnumeratorInfo::name));
    if (is_text) cursor_.FailAt(place, "there is no " + type.name() + " '" + name + "'", hint);
    Error error = cursor_.ExpectedAt(place, "the name of a " + type.name() + " in quotation marks");
    error.hint = hint;
    throw JsonFailure{std::move(error)};
  }

  void ReadStructure(const TypeInfo& type, void* value) {
    Names names;
    names.reserve(type.fields().size());
    for (const FieldInfo& field : type.fields()) names.push_back(field.name);
    ReadFields(type.name(), names, [&](std::size_t index) {
      const FieldInfo& field = type.fields()[index];
      Read(*field.type, field.address(value));
    });
  }

  // Calls `read_field` with the number of each field whose value comes next.
  template <typename ReadField>
  void ReadFields(const std::string& type, const Names& names, const ReadField& read_field) {
    cursor_.Need('{', "'{' before a ", type);
    if (cursor_.Skip('}')) return;
    std::vector<bool> is_given(names.size());
    do {
      const std::size_t field = TakeFieldName(type, names);
      if (is_given[field])
        cursor_.FailAt(name_place_, "'" + std::string(names[field]) + "' is given twice");
      is_given[field] = true;
      if (!cursor_.Skip(':')) {
        cursor_.FailExpecting("':' after \"" + std::string(names[field]) + "\"");
      }
      steps_.push_back({names[field], 0});
      read_field(field);
      steps_.pop_back();
    } while (cursor_.Skip(','));
    cursor_.Need('}', "',' or '}' in a ", type);
  }

  std::size_t TakeFieldName(const std::string& type, const Names& names) {
    cursor_.SkipWhitespace();
    name_place_ = cursor_.place();
    std::string name;
    cursor_.TakeString(name);
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      cursor_.FailAt(name_place_, type + " has no field '" + name + "'",
                     NearestNameHint(name, std::vector<std::string>(names.begin(), names.end())));
    }
    return static_cast<std::size_t>(found - names.begin());
  }

  void ReadSequence(const TypeInfo& type, void* value) {
    const ElementOperations& elements = type.elements();
    cursor_.Need('[', "'[' before a ", type.name());
    if (!elements.is_fixed) elements.resize(value, 1, 0);
    std::size_t count = 0;
    if (!cursor_.Skip(']')) {
      do {
        MakeRoom(type, value, count);
        ReadElement(type, value, count, count);
        ++count;
      } while (cursor_.Skip(','));
      cursor_.Need(']', "',' or ']' in a ", type.name());
    }
    if (elements.columns(value) != count && !elements.resize(value, 1, count)) {
      cursor_.Fail(std::to_string(count) + " elements are too few for a " + type.name());
    }
  }

  // Nobody has counted the elements before, so room is made for twice as many whenever there is
  // none: some lists are copied whole when they grow.
  void MakeRoom(const TypeInfo& type, void* value, std::size_t count) const {
    const ElementOperations& elements = type.elements();
    if (count < elements.columns(value)) return;
    if (!elements.is_fixed && (elements.resize(value, 1, std::max<std::size_t>(4, 2 * count)) ||
                               elements.resize(value, 1, count + 1))) {
      return;
    }
    cursor_.Fail("more elements than the " + std::to_string(count) + " that a " + type.name() +
                 " can have");
  }

  // `shown`: its number in the list or row that errors name.
  void ReadElement(const TypeInfo& type, void* value, std::size_t index, std::size_t shown) {
    steps_.push_back({{}, shown});
    Read(*type.elements().type, type.elements().element(value, index));
    steps_.pop_back();
  }

  void ReadMatrix(const TypeInfo& type, void* value) {
    const ElementOperations& elements = type.elements();
    const Shape shape = ShapeOfMatrix(type);
    // Without rows nothing tells how many columns there are.
    if (!elements.resize(value, shape.rows, shape.columns) &&
        (shape.rows > 0 || !elements.resize(value, 0, elements.columns(value)))) {
      cursor_.Fail(std::to_string(shape.rows) + " rows of " + std::to_string(shape.columns) +
                   " are no " + type.name());
    }
    cursor_.Skip('[');
    for (std::size_t row = 0; row < shape.rows; ++row) {
      cursor_.Skip('[');
      steps_.push_back({{}, row});
      for (std::size_t column = 0; column < shape.columns; ++column) {
        ReadElement(type, value, row * shape.columns + column, column);
        cursor_.Skip(',');
      }
      steps_.pop_back();
      cursor_.Skip(']');
      cursor_.Skip(',');
    }
    cursor_.Skip(']');
  }

  // The rows must be counted before the matrix can be made; so the text is gone through twice.
  [[nodiscard]] Shape ShapeOfMatrix(const TypeInfo& type) const {
    JsonCursor ahead = cursor_;
    Shape shape;
    ahead.Need('[', "'[' before a ", type.name());
    if (ahead.Skip(']')) return shape;
    do {
      const std::size_t columns = CountRow(ahead, type);
      if (shape.rows > 0 && columns != shape.columns) {
        ahead.Fail("the rows differ in length: " + std::to_string(shape.columns) + " and " +
                   std::to_string(columns));
      }
      shape = {shape.rows + 1, columns};
    } while (ahead.Skip(','));
    ahead.Need(']', "',' or ']' after a row");
    return shape;
  }

  std::size_t CountRow(JsonCursor& ahead, const TypeInfo& type) const {
    ahead.Need('[', "'[' before a row of a ", type.name());
    std::size_t columns = 0;
    if (ahead.Skip(']')) return columns;
    do {
      if (!ahead.SkipValue(kDeepest - depth_)) ahead.FailExpecting("an element");
      ++columns;
    } while (ahead.Skip(','));
    ahead.Need(']', "',' or ']' in a row");
    return columns;
  }

  [[nodiscard]] Error WithPath(Error error) const {
    std::string path;
    for (const Step& step : steps_) {
      if (step.field.empty()) {
        path += "[" + std::to_string(step.index) + "]";
      } else {
        path.append(path.empty() ? "" : ".").append(step.field);
      }
    }
    if (!path.empty()) error.message = path + ": " + error.message;
    return error;
  }

  JsonCursor cursor_;
  int depth_ = 0;
  std::size_t name_place_ = 0;  // of the last field's name
  std::vector<Step> steps_;
};

}  // namespace

Result<void> SetFromJson(const TypeInfo& type, std::string_view json, void* value) {
  return ValueReader(json).ReadAll(type, value);
}

}  // namespace runnel
