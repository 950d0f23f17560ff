#include "core/conversion/value_part.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"

namespace runnel {

namespace {

constexpr int kDeepest = 4;  // types may contain lists of themselves

Error NoPart(const TypeInfo& type, const char* what) { return {.message = type.name() + " has no " + what}; }

// "[12]" at the beginning of `name`, which is taken off.
std::optional<std::size_t> TakeIndex(std::string_view& name) {
  const std::size_t end = name.find(']');
  if (!name.starts_with('[') || end == std::string_view::npos) return std::nullopt;
  const auto index = NumberIn<std::size_t>(std::string(name.substr(1, end - 1)));
  if (index) name.remove_prefix(end + 1);
  return index;
}

void VisitParts(const TypeInfo& type, const std::string& before, const std::string& unit, int depth,
                const auto& visit) {
  if (depth > kDeepest) return;
  for (const FieldInfo& field : type.fields()) {
    const std::string name = before.empty() ? field.name : before + "." + field.name;
    visit(name, *field.type, field.unit);
    VisitParts(*field.type, name, field.unit, depth + 1, visit);
  }
  if (type.kind() == TypeKind::kSequence || type.kind() == TypeKind::kMatrix) {
    const std::string name = before + (type.kind() == TypeKind::kMatrix ? "[0][0]" : "[0]");
    visit(name, *type.elements().type, unit);
    VisitParts(*type.elements().type, name, unit, depth + 1, visit);
  }
}

}  // namespace

Result<ValuePart> ValuePart::In(const TypeInfo& type, std::string_view name) {
  ValuePart part;
  part.type_ = &type;
  while (!name.empty()) {
    const auto taken = name.front() == '[' ? part.TakeElement(name) : part.TakeField(name);
    if (!taken) return taken.error();
  }
  return part;
}

Result<void> ValuePart::TakeField(std::string_view& name) {
  if (name.starts_with('.')) name.remove_prefix(1);
  const std::size_t end = std::min(name.find_first_of(".["), name.size());
  const std::string field_name(name.substr(0, end));
  if (type_->kind() != TypeKind::kStructure) return NoPart(*type_, "fields");
  const FieldInfo* const field = type_->FindField(field_name);
  if (field == nullptr) {
    return Error{.message = type_->name() + " has no field '" + field_name + "'",
                 .hint = NearestNameHint(field_name, NamesOf(type_->fields(), &FieldInfo::name))};
  }
  name.remove_prefix(end);
  steps_.push_back({.field = field});
  type_ = field->type;
  unit_ = field->unit;
  return {};
}

Result<void> ValuePart::TakeElement(std::string_view& name) {
  const bool is_matrix = type_->kind() == TypeKind::kMatrix;
  if (!is_matrix && type_->kind() != TypeKind::kSequence) return NoPart(*type_, "elements");
  const std::string said(name);
  Step step{.elements = &type_->elements()};
  const auto first = TakeIndex(name);
  const auto second = is_matrix && first ? TakeIndex(name) : std::optional<std::size_t>(0);
  if (!first || !second) {
    return Error{.message = "'" + said + "' names no element",
                 .hint = is_matrix ? "write [ROW][COLUMN], counted from 0" : "write [INDEX], counted from 0"};
  }
  step.row = is_matrix ? *first : 0;
  step.column = is_matrix ? *second : *first;
  if (step.elements->is_fixed) {
    const std::shared_ptr<const void> usual = type_->Make();
    const std::size_t rows = usual && is_matrix ? step.elements->rows(usual.get()) : 1;
    const std::size_t columns = usual ? step.elements->columns(usual.get()) : step.column + 1;
    if (step.row >= rows || step.column >= columns) {
      return Error{.message = type_->name() + " has no element '" + said + "'",
                   .hint = "it has " + (is_matrix ? std::to_string(rows) + " rows of " : "") + std::to_string(columns) +
                           ", counted from 0"};
    }
  }
  steps_.push_back(step);
  type_ = steps_.back().elements->type;
  return {};
}

const void* ValuePart::Find(const void* value) const {
  void* at = ForLooking(value);
  for (const Step& step : steps_) {
    if (step.field != nullptr) {
      at = step.field->address(at);
      continue;
    }
    const std::size_t columns = step.elements->columns(at);
    if (step.column >= columns || (step.row > 0 && step.row >= step.elements->rows(at))) return nullptr;
    at = step.elements->element(at, step.row * columns + step.column);
  }
  return at;
}

void ForEachPart(
    const TypeInfo& type,
    const std::function<void(const std::string& name, const TypeInfo& type, const std::string& unit)>& visit) {
  VisitParts(type, "", "", 0, visit);
}

}  // namespace runnel
