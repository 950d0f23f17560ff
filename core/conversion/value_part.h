#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/types/type_info.h"

namespace runnel {

/// A part of values of a described type: a field ("heading"), an element ("[2]", "[1][0]" of a matrix), or what
/// is inside of those ("poses[0].x"); without a name, the whole.
///
/// Threads: never changes once made.
class ValuePart {
 public:
  /// Errors: there is no such field, with the nearest; what has no fields or elements; an element that no
  /// value of the type has.
  [[nodiscard]] static Result<ValuePart> In(const TypeInfo& type, std::string_view name);

  /// Where the part is in `value`; nullptr if that has no such element.
  [[nodiscard]] const void* Find(const void* value) const;
  [[nodiscard]] const TypeInfo& type() const noexcept { return *type_; }
  /// Of the field, or of that of which it is an element; "" if nobody said.
  [[nodiscard]] const std::string& unit() const noexcept { return unit_; }
  [[nodiscard]] bool is_whole() const noexcept { return steps_.empty(); }

 private:
  struct Step {
    const FieldInfo* field = nullptr;  // nullptr: an element
    const ElementOperations* elements = nullptr;
    std::size_t row = 0;
    std::size_t column = 0;
  };
  Result<void> TakeField(std::string_view& name);
  Result<void> TakeElement(std::string_view& name);

  const TypeInfo* type_ = nullptr;
  std::string unit_;
  std::vector<Step> steps_;
};

/// Calls `visit(name, type, unit)` for each part of values of the type that has a name: fields, and fields of
/// fields; of lists the first element.
void ForEachPart(
    const TypeInfo& type,
    const std::function<void(const std::string& name, const TypeInfo& type, const std::string& unit)>& visit);

}  // namespace runnel
