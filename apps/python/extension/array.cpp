// Lists and matrices of numbers as NumPy sees them: where they lie, without a copy.

#include <cstdint>
#include <map>

#include "apps/python/extension/value.h"
#include "core/types/leaf_types.h"

namespace py = pybind11;

namespace runnel::python {

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
