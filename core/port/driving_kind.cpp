#include "core/port/driving_kind.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <unordered_set>

#include "core/base/unit.h"
#include "core/conversion/number_conversion.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "core/types/type_of.h"

namespace runnel {

namespace {

constexpr Dimensions kLength{1}, kAngle{0, 0, 0, 0, 0, 1};

Dimensions PerSecond(Dimensions place) {
  --place[2];
  return place;
}

// Of the type, and of all that it is made of, with their units. Each type once, as one may contain itself.
void VisitInside(const TypeInfo& type, const std::string& unit,
                 const std::function<void(const TypeInfo&, const std::string&)>& visit) {
  std::unordered_set<const TypeInfo*> seen;
  const std::function<void(const TypeInfo&, const std::string&)> look = [&](const TypeInfo& at,
                                                                            const std::string& its_unit) {
    visit(at, its_unit);
    if (!seen.insert(&at).second) return;
    for (const FieldInfo& each : at.fields()) look(*each.type, each.unit);
    if (at.kind() == TypeKind::kSequence || at.kind() == TypeKind::kMatrix) look(*at.elements().type, {});
  };
  look(type, unit);
}

}  // namespace

const std::vector<std::string>& DrivingKindNames() {
  static const std::vector<std::string> names{"position", "velocity", "effort"};
  return names;
}

const std::string& NameOf(DrivingKind kind) { return DrivingKindNames()[static_cast<std::size_t>(kind) - 1]; }

std::optional<DrivingKind> DrivingKindCalled(std::string_view name) {
  const auto found = std::ranges::find(DrivingKindNames(), name);
  if (found == DrivingKindNames().end()) return {};
  return static_cast<DrivingKind>(found - DrivingKindNames().begin() + 1);
}

bool IsVelocity(const TypeInfo& type, const std::string& unit) {
  const auto parsed = ParseUnit(unit);
  const bool is_per_second =
      parsed && (parsed->dimensions == PerSecond(kLength) || parsed->dimensions == PerSecond(kAngle));
  if (type.semantic_tag() == "twist" || is_per_second) return true;
  return !type.fields().empty() &&
         std::ranges::all_of(type.fields(), [](const FieldInfo& field) { return IsVelocity(*field.type, field.unit); });
}

DrivingKind DrivingKindByUnits(const TypeInfo& type, const std::string& unit) {
  std::vector<Dimensions> all;
  VisitInside(type, unit, [&](const TypeInfo&, const std::string& each) {
    if (const auto parsed = ParseUnit(each)) all.push_back(parsed->dimensions);
  });
  const auto has = [&](const Dimensions& each) { return std::ranges::find(all, each) != all.end(); };
  const auto has_only_speed_of = [&](const Dimensions& place) { return has(PerSecond(place)) && !has(place); };
  if (IsVelocity(type, unit) || has_only_speed_of(kLength) || has_only_speed_of(kAngle)) return DrivingKind::kVelocity;
  if (has(kLength) || has(kAngle)) return DrivingKind::kPosition;
  return all.empty() ? DrivingKind::kUnspecified : DrivingKind::kEffort;
}

bool HasNumbers(const TypeInfo& type) {
  bool has_numbers = false;
  VisitInside(type, {}, [&](const TypeInfo& each, const std::string&) {
    has_numbers = has_numbers || (internal::IsNumber(each) && &each != &TypeOf<bool>());
  });
  return has_numbers;
}

bool HasLists(const TypeInfo& type) {
  bool has_lists = false;
  VisitInside(type, {}, [&](const TypeInfo& each, const std::string&) {
    const bool is_list = each.kind() == TypeKind::kSequence || each.kind() == TypeKind::kMatrix;
    has_lists = has_lists || (is_list && !each.elements().is_fixed);
  });
  return has_lists;
}

bool IsZero(const AnyValue& value) {
  const std::shared_ptr<const void> zero = value.type().Make();
  return zero != nullptr && value.type().is_transparent() &&
         ToText(value.type(), value.get()) == ToText(value.type(), zero.get());
}

bool IsSafeInAnyUnit(const AnyValue& safe_value, DrivingKind command) {
  return IsZero(safe_value) && command != DrivingKind::kPosition;
}

}  // namespace runnel
