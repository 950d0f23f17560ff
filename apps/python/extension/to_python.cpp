// From values to what Python sees of them.
#include <cstdint>
#include <cstring>
#include <map>

#include "apps/python/extension/value.h"
#include "core/types/leaf_types.h"

namespace py = pybind11;

namespace runnel::python {

namespace {

template <typename T>
const T& As(const void* at) {
  return *static_cast<const T*>(at);
}

py::object LeafToPython(const TypeInfo& type, const void* at) {
  return WithLeafType(type, [&]<typename T>(std::type_identity<T>) -> py::object {
    if constexpr (std::is_void_v<T>) {
      return py::str(type.leaf().to_text(at));
    } else if constexpr (std::is_same_v<T, Duration> || std::is_same_v<T, Time>) {
      return py::float_(ToSeconds(As<T>(at)));
    } else {
      return py::cast(As<T>(at));
    }
  });
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
    case TypeKind::kLeaf:
      return LeafToPython(type, at);
    case TypeKind::kEnumeration:
      return NameOf(type, at);
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
    default:
      return py::cast(Value(type, at, memory, is_element));
  }
}

py::object ToPlain(const TypeInfo& type, const void* at) {
  if (type.kind() == TypeKind::kStructure) {
    py::dict all;
    for (const FieldInfo& field : type.fields())
      all[py::str(field.name)] = ToPlain(*field.type, field.address(ForLooking(at)));
    return all;
  }
  if (type.kind() != TypeKind::kSequence && type.kind() != TypeKind::kMatrix)
    return ToPython(type, ForLooking(at), nullptr);
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
    case TypeKind::kEnumeration:
      return type.enumeration().get(one) == type.enumeration().get(other);
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
        if (!AreEqual(*elements.type, elements.element(ForLooking(one), i), elements.element(ForLooking(other), i)))
          return false;
      }
      return true;
    }
    default:
      return one == other;
  }
}

// Lists and matrices of numbers as NumPy sees them: where they lie, without a copy.

namespace {

py::object LeafDtype(const TypeInfo& type) {
  return WithLeafType(type, []<typename T>(std::type_identity<T>) -> py::object {
    if constexpr (std::is_arithmetic_v<T>) return py::dtype::of<T>();
    if constexpr (std::is_same_v<T, Duration> || std::is_same_v<T, Time>) return py::dtype::of<std::int64_t>();
    return py::none();
  });
}

py::object StructureDtype(const TypeInfo& type) {
  const auto sample = type.Make();
  if (!sample) return py::none();
  py::list names, formats, offsets;
  for (const FieldInfo& field : type.fields()) {
    py::object format = DtypeOf(*field.type);
    if (format.is_none()) return format;
    names.append(field.name);
    formats.append(format);
    offsets.append(static_cast<const char*>(field.address(sample.get())) - static_cast<const char*>(sample.get()));
  }
  py::dict all;
  all["names"] = names;
  all["formats"] = formats;
  all["offsets"] = offsets;
  all["itemsize"] = type.size();
  return py::dtype::from_args(all);
}

py::object FixedListDtype(const TypeInfo& type) {
  const ElementOperations& elements = type.elements();
  if (!elements.is_fixed || type.kind() != TypeKind::kSequence) return py::none();
  py::object element = DtypeOf(*elements.type);
  const auto sample = type.Make();
  if (element.is_none() || !sample) return py::none();
  const std::size_t count = elements.columns(sample.get());
  if (count == 0 || elements.element(sample.get(), 0) != sample.get() || type.size() != count * elements.type->size())
    return py::none();
  return py::dtype::from_args(py::make_tuple(element, py::make_tuple(count)));
}

}  // namespace

py::object DtypeOf(const TypeInfo& type) {
  static auto* const known = new std::map<const TypeInfo*, py::object>;  // with the GIL; never freed, as types are
  if (const auto found = known->find(&type); found != known->end()) return found->second;
  py::object made = py::none();
  if (type.kind() == TypeKind::kLeaf) {
    made = LeafDtype(type);
  } else if (type.kind() == TypeKind::kStructure && !type.fields().empty()) {
    made = StructureDtype(type);
  } else if (type.kind() == TypeKind::kSequence || type.kind() == TypeKind::kMatrix) {
    made = FixedListDtype(type);
  }
  (*known)[&type] = made;
  return made;
}

py::object ArrayOf(const TypeInfo& type, void* at, const std::shared_ptr<Memory>& memory) {
  const ElementOperations& elements = type.elements();
  const py::object dtype = DtypeOf(*elements.type);
  if (dtype.is_none()) return py::none();
  const std::size_t rows = elements.rows(at);
  const std::size_t columns = elements.columns(at);
  const bool is_matrix = type.kind() == TypeKind::kMatrix;
  const auto address = [&](std::size_t index) { return static_cast<char*>(elements.element(at, index)); };
  const auto size = static_cast<py::ssize_t>(elements.type->size());
  char* const first = rows * columns > 0 ? address(0) : nullptr;
  const py::ssize_t across = columns > 1 ? address(1) - first : size;
  const py::ssize_t down =
      is_matrix && rows > 1 ? address(columns) - first : across * static_cast<py::ssize_t>(columns);
  // A container whose elements do not lie in a row is not looked at like that.
  if (first != nullptr && address(rows * columns - 1) != first + static_cast<py::ssize_t>(rows - 1) * down +
                                                             static_cast<py::ssize_t>(columns - 1) * across) {
    return py::none();
  }
  const py::capsule base(new Value(type, at, memory, true), [](void* view) { delete static_cast<Value*>(view); });
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(columns)};
  std::vector<py::ssize_t> strides{across};
  if (is_matrix) {
    shape.insert(shape.begin(), static_cast<py::ssize_t>(rows));
    strides.insert(strides.begin(), down);
  }
  static char nothing[64];
  py::array array(py::reinterpret_borrow<py::dtype>(dtype), shape, strides, first != nullptr ? first : nothing, base);
  if (!memory->is_writable) array.attr("flags").attr("writeable") = false;
  return array;
}

}  // namespace runnel::python
