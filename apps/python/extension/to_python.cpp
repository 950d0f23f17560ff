// From values to what Python sees of them.

#include <cstring>

#include "apps/python/extension/value.h"
#include "core/types/type_of.h"

namespace py = pybind11;

namespace runnel::python {

namespace {

template <typename T>
const T& As(const void* at) {
  return *static_cast<const T*>(at);
}

py::object LeafToPython(const TypeInfo& type, const void* at) {
  const std::type_index is = type.cpp_type();
  if (is == typeid(double)) return py::float_(As<double>(at));
  if (is == typeid(float)) return py::float_(static_cast<double>(As<float>(at)));
  if (is == typeid(bool)) return py::bool_(As<bool>(at));
  if (is == typeid(std::string)) return py::str(As<std::string>(at));
  if (is == typeid(std::int32_t)) return py::int_(As<std::int32_t>(at));
  if (is == typeid(std::int64_t)) return py::int_(As<std::int64_t>(at));
  if (is == typeid(std::uint8_t)) return py::int_(As<std::uint8_t>(at));
  if (is == typeid(std::uint32_t)) return py::int_(As<std::uint32_t>(at));
  if (is == typeid(std::uint64_t)) return py::int_(As<std::uint64_t>(at));
  if (is == typeid(std::int8_t)) return py::int_(As<std::int8_t>(at));
  if (is == typeid(std::int16_t)) return py::int_(As<std::int16_t>(at));
  if (is == typeid(std::uint16_t)) return py::int_(As<std::uint16_t>(at));
  if (is == typeid(Duration)) return py::float_(ToSeconds(As<Duration>(at)));
  if (is == typeid(Time)) return py::float_(ToSeconds(As<Time>(at)));
  return py::str(type.leaf().to_text(at));
}

py::object NameOf(const TypeInfo& type, const void* at) {
  const std::int64_t value = type.enumeration().get(at);
  for (const EnumeratorInfo& each : type.enumerators()) {
    if (each.value == value) return py::str(each.name);
  }
  return py::int_(value);
}

bool IsOptional(const TypeInfo& type) { return type.kind() == TypeKind::kSequence && type.name().ends_with('?'); }

}  // namespace

Value::Value(const TypeInfo& of, void* where, std::shared_ptr<Memory> within, bool is_element)
    : type(&of), at(where), memory(std::move(within)), counts(is_element) {
  if (counts) ++memory->views;
}

Value::~Value() {
  if (counts) --memory->views;
}

py::object ToPython(const TypeInfo& type, void* at, const std::shared_ptr<Memory>& memory, bool is_element) {
  switch (type.kind()) {
    case TypeKind::kLeaf: return LeafToPython(type, at);
    case TypeKind::kEnumeration: return NameOf(type, at);
    case TypeKind::kSequence:
      if (IsOptional(type)) {
        if (type.elements().columns(at) == 0) return py::none();
        return ToPython(*type.elements().type, type.elements().element(at, 0), memory, true);
      }
      [[fallthrough]];
    case TypeKind::kMatrix:
      if (type.elements().type->kind() == TypeKind::kLeaf) {
        py::object array = ArrayOf(type, at, memory);
        if (!array.is_none()) return array;
      }
      [[fallthrough]];
    default: return py::cast(Value(type, at, memory, is_element));
  }
}

py::object ToPlain(const TypeInfo& type, const void* at) {
  if (type.kind() == TypeKind::kStructure) {
    py::dict all;
    for (const FieldInfo& field : type.fields()) all[py::str(field.name)] = ToPlain(*field.type, field.address(ForLooking(at)));
    return all;
  }
  if (type.kind() != TypeKind::kSequence && type.kind() != TypeKind::kMatrix) return ToPython(type, ForLooking(at), nullptr);
  const ElementOperations& elements = type.elements();
  if (IsOptional(type)) {
    if (elements.columns(at) == 0) return py::none();
    return ToPlain(*elements.type, elements.element(ForLooking(at), 0));
  }
  if (elements.type->kind() == TypeKind::kLeaf) {
    const py::object array = ArrayOf(type, ForLooking(at), std::make_shared<Memory>());
    if (!array.is_none()) return array.attr("copy")();
  }
  py::list all;
  for (std::size_t i = 0; i < elements.rows(at) * elements.columns(at); ++i) {
    all.append(ToPlain(*elements.type, elements.element(ForLooking(at), i)));
  }
  return all;
}

bool AreEqual(const TypeInfo& type, const void* one, const void* other) {
  if (one == other && type.kind() != TypeKind::kLeaf) return true;
  switch (type.kind()) {
    case TypeKind::kStructure:
      for (const FieldInfo& field : type.fields()) {
        if (!AreEqual(*field.type, field.address(ForLooking(one)), field.address(ForLooking(other)))) return false;
      }
      return true;
    case TypeKind::kEnumeration: return type.enumeration().get(one) == type.enumeration().get(other);
    case TypeKind::kLeaf:
      if (type.cpp_type() == typeid(double)) return As<double>(one) == As<double>(other);
      if (type.cpp_type() == typeid(float)) return As<float>(one) == As<float>(other);
      if (type.cpp_type() == typeid(std::string)) return As<std::string>(one) == As<std::string>(other);
      if (!DtypeOf(type).is_none()) return std::memcmp(one, other, type.size()) == 0;
      return type.leaf().to_text(one) == type.leaf().to_text(other);
    case TypeKind::kSequence:
    case TypeKind::kMatrix: {
      const ElementOperations& elements = type.elements();
      const std::size_t count = elements.columns(one) * elements.rows(one);
      if (elements.rows(one) != elements.rows(other) || elements.columns(one) != elements.columns(other)) return false;
      for (std::size_t i = 0; i < count; ++i) {
        if (!AreEqual(*elements.type, elements.element(ForLooking(one), i), elements.element(ForLooking(other), i))) return false;
      }
      return true;
    }
    default: return one == other;
  }
}

}  // namespace runnel::python
