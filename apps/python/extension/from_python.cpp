// From what Python has to values, written where they are to be.

#include <cmath>
#include <cstring>

#include "apps/python/extension/errors.h"
#include "apps/python/extension/value.h"
#include "core/base/nearest_name.h"
#include "core/types/leaf_types.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"

namespace py = pybind11;

namespace runnel::python {

namespace {

[[noreturn]] void Refuse(const TypeInfo& type, py::handle object) {
  throw py::type_error("a value of type " + type.name() + " is expected, not " +
                       py::repr(object).cast<std::string>().substr(0, 60));
}

// It is none, or its conversion has thrown something of its own, as Ctrl-C does.
[[noreturn]] void RefuseNumber(const TypeInfo& type, py::handle object) {
  if (PyErr_ExceptionMatches(PyExc_TypeError) == 0) throw py::error_already_set();
  PyErr_Clear();
  Refuse(type, object);
}

template <typename T>
void SetWhole(const TypeInfo& type, py::handle object, T& value) {
  const py::object number = py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr()));
  if (!number) RefuseNumber(type, object);
  try {
    value = number.cast<T>();
  } catch (const py::cast_error&) {
    throw py::value_error(py::repr(object).cast<std::string>() + " is out of the range of " + type.name());
  }
}

double NumberOf(const TypeInfo& type, py::handle object) {
  const double number = PyFloat_AsDouble(object.ptr());
  if (number == -1.0 && PyErr_Occurred() != nullptr) RefuseNumber(type, object);
  return number;
}

void SetText(const TypeInfo& type, const std::string& text, void* at) { Checked(SetFromText(type, text, at)); }

Duration SecondsOf(const TypeInfo& type, py::handle object) {
  py::object seconds = py::reinterpret_borrow<py::object>(object);
  if (py::hasattr(object, "total_seconds")) seconds = object.attr("total_seconds")();
  const double number = NumberOf(type, seconds);
  if (!(std::abs(number) < 9e9)) throw py::value_error("no time: " + std::to_string(number) + " s");
  return FromSeconds(number);
}

void SetLeaf(const TypeInfo& type, py::handle object, void* at) {
  WithLeafType(type, [&]<typename T>(std::type_identity<T>) {
    if constexpr (std::is_same_v<T, std::string>) {
      if (!py::isinstance<py::str>(object)) Refuse(type, object);
      *static_cast<T*>(at) = object.cast<T>();
    } else if (py::isinstance<py::str>(object)) {
      SetText(type, object.cast<std::string>(), at);
    } else if constexpr (std::is_void_v<T>) {
      Refuse(type, object);
    } else if constexpr (std::is_floating_point_v<T>) {
      *static_cast<T*>(at) = static_cast<T>(NumberOf(type, object));
    } else if constexpr (std::is_same_v<T, bool>) {
      const int truth = PyObject_IsTrue(object.ptr());
      if (truth < 0) throw py::error_already_set();
      *static_cast<T*>(at) = truth != 0;
    } else if constexpr (std::is_integral_v<T>) {
      SetWhole(type, object, *static_cast<T*>(at));
    } else {
      *static_cast<T*>(at) = T(SecondsOf(type, object));
    }
  });
}

void SetEnumeration(const TypeInfo& type, py::handle object, void* at) {
  if (py::isinstance<py::str>(object)) return SetText(type, object.cast<std::string>(), at);
  if (!PyLong_Check(object.ptr())) Refuse(type, object);
  const auto number = object.cast<std::int64_t>();
  for (const EnumeratorInfo& each : type.enumerators()) {
    if (each.value == number) return type.enumeration().set(at, number);
  }
  throw py::value_error(std::to_string(number) + " is no " + type.name());
}

void Reset(const TypeInfo& type, void* at) {
  const auto fresh = type.Make();
  if (fresh) (void)CopyValue(type, fresh.get(), at);
}

void SetStructure(const TypeInfo& type, py::handle object, void* at, bool is_whole) {
  if (!py::isinstance<py::dict>(object)) Refuse(type, object);
  const auto fields = py::reinterpret_borrow<py::dict>(object);
  if (is_whole && fields.size() < type.fields().size()) Reset(type, at);
  for (const auto& [name, value] : fields) {
    const auto called = py::str(name).cast<std::string>();
    const FieldInfo* const field = type.FindField(called);
    if (field == nullptr) {
      Throw({.message = type.name() + " has no '" + called + "'",
             .hint = NearestNameHint(called, NamesOf(type.fields(), &FieldInfo::name))});
    }
    FromPython(*field->type, value, field->address(at));
  }
}

void Resize(const TypeInfo& type, void* at, std::size_t rows, std::size_t columns) {
  const ElementOperations& elements = type.elements();
  // A matrix has rows of its own; other lists may refer to what is not theirs until they are resized.
  if (type.kind() == TypeKind::kMatrix && elements.rows(at) == rows && elements.columns(at) == columns) return;
  if (!elements.resize(at, rows, columns)) {
    throw py::value_error(type.name() + " cannot have " + std::to_string(rows * columns) + " elements");
  }
}

// From whatever NumPy makes an array of; false: the elements are no numbers.
bool SetNumbers(const TypeInfo& type, py::handle object, void* at) {
  const ElementOperations& elements = type.elements();
  if (elements.type->kind() != TypeKind::kLeaf) return false;
  const py::object dtype = DtypeOf(*elements.type);
  if (dtype.is_none()) return false;
  static const py::handle as_array = py::object(py::module_::import("numpy").attr("asarray")).release();
  const py::bytes bytes = PyBytes_Check(object.ptr()) ? py::reinterpret_borrow<py::bytes>(object) : py::bytes();
  const auto array = py::reinterpret_borrow<py::array>(
      PyBytes_Check(object.ptr()) ? py::module_::import("numpy").attr("frombuffer")(bytes, dtype)
                                  : as_array(object, dtype));
  const bool is_matrix = type.kind() == TypeKind::kMatrix;
  if (array.ndim() != (is_matrix ? 2 : 1)) {
    throw py::value_error(type.name() + " is expected, not an array of " + std::to_string(array.ndim()) +
                          " dimensions");
  }
  const auto rows = is_matrix ? static_cast<std::size_t>(array.shape(0)) : 1;
  const auto columns = static_cast<std::size_t>(array.shape(is_matrix ? 1 : 0));
  Resize(type, at, rows, columns);
  if (rows * columns == 0) return true;
  auto borrowed = std::make_shared<Memory>();
  borrowed->is_writable = true;
  const py::object target = ArrayOf(type, at, borrowed);
  if (target.is_none()) return false;
  static const py::handle copy_to = py::object(py::module_::import("numpy").attr("copyto")).release();
  copy_to(target, array);
  return true;
}

void SetElements(const TypeInfo& type, py::handle object, void* at) {
  const ElementOperations& elements = type.elements();
  if (type.name().ends_with('?')) {
    Resize(type, at, 1, object.is_none() ? 0 : 1);
    if (!object.is_none()) FromPython(*elements.type, object, elements.element(at, 0));
    return;
  }
  if (py::isinstance<py::str>(object)) return SetText(type, object.cast<std::string>(), at);
  if (SetNumbers(type, object, at)) return;
  const py::list all(py::reinterpret_borrow<py::object>(object));
  Resize(type, at, 1, all.size());
  for (std::size_t i = 0; i < all.size(); ++i) FromPython(*elements.type, all[i], elements.element(at, i));
}

// The elements, if they lie one behind the other.
char* RowOf(const TypeInfo& type, const void* at, std::size_t count) {
  const ElementOperations& elements = type.elements();
  if (elements.type->kind() != TypeKind::kLeaf || DtypeOf(*elements.type).is_none() || count == 0) return nullptr;
  auto* const first = static_cast<char*>(elements.element(ForLooking(at), 0));
  const bool is_row = elements.element(ForLooking(at), count - 1) == first + (count - 1) * elements.type->size() &&
                      (count < 2 || elements.element(ForLooking(at), 1) == first + elements.type->size());
  return is_row ? first : nullptr;
}

// As CopyValue(), but numbers that lie in a row are copied as a whole.
bool Copy(const TypeInfo& type, const void* from, void* to) {
  if (type.kind() == TypeKind::kStructure) {
    for (const FieldInfo& field : type.fields()) {
      if (!Copy(*field.type, field.address(ForLooking(from)), field.address(to))) return false;
    }
    return true;
  }
  if (type.kind() != TypeKind::kSequence) return CopyValue(type, from, to);
  const std::size_t count = type.elements().columns(from);
  const char* const source = RowOf(type, from, count);
  if (source == nullptr || !type.elements().resize(to, 1, count)) return CopyValue(type, from, to);
  char* const target = RowOf(type, to, count);
  if (target == nullptr) return CopyValue(type, from, to);
  std::memcpy(target, source, count * type.elements().type->size());
  return true;
}

}  // namespace

void FromPython(const TypeInfo& type, py::handle object, void* at, bool is_whole) {
  if (py::isinstance<Value>(object)) {
    const auto& value = object.cast<const Value&>();
    if (value.type != &type) {
      throw py::type_error("a value of type " + type.name() + " is expected, not of " + value.type->name());
    }
    if (value.at != at && !Copy(type, value.at, at)) Refuse(type, object);
    return;
  }
  switch (type.kind()) {
    case TypeKind::kLeaf:
      return SetLeaf(type, object, at);
    case TypeKind::kEnumeration:
      return SetEnumeration(type, object, at);
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      return SetElements(type, object, at);
    case TypeKind::kStructure:
      if (!py::isinstance<py::str>(object)) return SetStructure(type, object, at, is_whole);
      if (is_whole) Reset(type, at);
      return SetText(type, object.cast<std::string>(), at);
    default:
      Refuse(type, object);
  }
}

Value NewValue(const TypeInfo& type) {
  auto made = type.Make();
  if (!made) throw py::type_error("only a module can make values of type " + type.name());
  void* const at = made.get();
  return {type, at, std::make_shared<Memory>(Memory{.kept = std::move(made), .is_writable = true}), false};
}

}  // namespace runnel::python
