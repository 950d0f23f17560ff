#include "modules/behaviours/value_fusion.h"

#include <cmath>
#include <memory>

#include "core/conversion/number_conversion.h"
#include "core/types/type_of.h"
#include "core/types/value_copy.h"
#include "modules/behaviours/algorithm/fusion.h"

namespace runnel {

namespace {

bool IsBroken(const TypeInfo& type) { return &type == &TypeOf<double>() || &type == &TypeOf<float>(); }

bool IsSummable(const TypeInfo& type) { return internal::IsNumber(type) && &type != &TypeOf<bool>(); }

}  // namespace

Result<ValueFusion> ValueFusion::Make(const TypeInfo& type, const std::string& unit, std::size_t values) {
  const std::shared_ptr<void> value = type.Make();
  if (value == nullptr) return Error{.message = "values of type " + type.name() + " can be made by their own module only"};
  ValueFusion fusion(type);
  if (auto added = fusion.AddNumbers(type, unit, value.get(), value.get()); !added) return added.error();
  fusion.found_.resize(values);
  return fusion;
}

Result<void> ValueFusion::AddNumbers(const TypeInfo& type, const std::string& unit, void* at, const void* value) {
  if (IsSummable(type)) {
    const auto offset = static_cast<const std::byte*>(at) - static_cast<const std::byte*>(value);
    numbers_.push_back({static_cast<std::size_t>(offset), &type, unit == "rad"});
    return {};
  }
  switch (type.kind()) {
    case TypeKind::kEnumeration:
      return {};
    case TypeKind::kStructure:
      for (const FieldInfo& field : type.fields()) {
        if (auto added = AddNumbers(*field.type, field.unit, field.address(at), value); !added) return added;
      }
      return {};
    case TypeKind::kSequence:
    case TypeKind::kMatrix: {
      const ElementOperations& elements = type.elements();
      if (!elements.is_fixed) break;
      const std::size_t count = elements.rows(at) * elements.columns(at);
      for (std::size_t i = 0; i < count; ++i) {
        if (auto added = AddNumbers(*elements.type, unit, elements.element(at, i), value); !added) return added;
      }
      return {};
    }
    case TypeKind::kLeaf:
      if (&type == &TypeOf<bool>()) return {};
      break;
    case TypeKind::kOpaque:
      break;
  }
  return Error{.message = "values of type " + type_->name() + " cannot be weighted: there is '" + type.name() +
                          "' in them, which is neither a number nor of a fixed size",
               .hint = "the method winner_takes_all takes values of any type"};
}

void ValueFusion::Fuse(std::span<const double> weights, std::span<const void* const> values,
                       std::size_t winner, void* fused) {
  (void)CopyValue(*type_, values[winner], fused);
  for (const Number& number : numbers_) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] == nullptr) continue;
      found_[i] = internal::NumberIn(*number.type, static_cast<const std::byte*>(values[i]) + number.offset);
    }
    const std::span<const double> numbers(found_.data(), values.size());
    double sum = number.is_angle ? FuseAngles(weights, numbers, winner) : FuseNumbers(weights, numbers);
    if (!IsBroken(*number.type)) sum = std::round(sum);
    internal::SetNumber(*number.type, static_cast<std::byte*>(fused) + number.offset, sum);
  }
}

}  // namespace runnel
