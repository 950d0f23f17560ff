// runnel.Value, runnel.Type: values of every described type, without code for it.

#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>
#include <thread>

#include <pybind11/stl.h>

#include "apps/python/extension/errors.h"
#include "apps/python/extension/interpreter.h"
#include "apps/python/extension/value.h"
#include "core/base/nearest_name.h"
#include "core/plugin/plugin_manager.h"
#include "core/port/typed_ports.h"
#include "core/types/text_format.h"

namespace py = pybind11;

namespace runnel::python {

namespace {

constexpr TextLimits kShown{.elements = 12, .text = 200, .all = 1000};

const FieldInfo& FieldOf(const Value& value, const std::string& name) {
  if (const FieldInfo* const field = value.type->FindField(name)) return *field;
  const std::string hint = NearestNameHint(name, NamesOf(value.type->fields(), &FieldInfo::name));
  PyErr_SetString(PyExc_AttributeError, (value.type->name() + " has no '" + name + "'; " + hint).c_str());
  throw py::error_already_set();
}

bool HasFreeLists(const TypeInfo& type) {
  return type.HasPart([](const TypeInfo& part) {
    return (part.kind() == TypeKind::kSequence || part.kind() == TypeKind::kMatrix) && !part.elements().is_fixed;
  });
}

py::object GetField(const Value& value, const std::string& name) {
  const FieldInfo& field = FieldOf(value, name);
  return ToPython(*field.type, field.address(value.at), value.memory, value.counts);
}

void SetField(Value& value, const std::string& name, const py::object& to) {
  if (!value.memory->is_writable) {
    PyErr_SetString(PyExc_AttributeError, "what has been published does not change; change a copy: value.copy()");
    throw py::error_already_set();
  }
  const FieldInfo& field = FieldOf(value, name);
  if (value.memory->views > (value.counts ? 1 : 0) && HasFreeLists(*field.type)) {
    throw py::buffer_error(
        "an array or an element still looks at this value, whose lists would move: let go of it first, "
        "or change it in place: value." +
        name + "[:] = ...");
  }
  const Counted stays(value.memory->views);  // while Python makes what the elements are
  FromPython(*field.type, to, field.address(value.at));
}

std::size_t CountOf(const Value& value) {
  if (value.type->kind() == TypeKind::kStructure) throw py::type_error(value.type->name() + " is no list");
  return value.type->elements().rows(value.at) * value.type->elements().columns(value.at);
}

py::object ElementOf(const Value& value, py::ssize_t index) {
  const auto count = static_cast<py::ssize_t>(CountOf(value));
  if (index < 0) index += count;
  if (index < 0 || index >= count) throw py::index_error("there are " + std::to_string(count) + " elements");
  const ElementOperations& elements = value.type->elements();
  return ToPython(*elements.type, elements.element(value.at, static_cast<std::size_t>(index)), value.memory, true);
}

py::object AsArray(const Value& value) {
  if (value.type->kind() == TypeKind::kStructure) throw py::type_error(value.type->name() + " is no list");
  py::object array = ArrayOf(*value.type, value.at, value.memory);
  if (array.is_none()) throw py::type_error("the elements of " + value.type->name() + " are no numbers");
  return array;
}

Value CopyOf(const Value& value) {
  Value copy = NewValue(*value.type);
  FromPython(*value.type, py::cast(value), copy.at);
  return copy;
}

struct Type {
  const TypeInfo* info;
};

py::list FieldsOf(const Type& type) {
  py::list fields;
  for (const FieldInfo& each : type.info->fields()) {
    fields.append(py::make_tuple(each.name, each.type->name(), each.unit, each.description));
  }
  return fields;
}

std::string HelpOf(const Type& type) {
  std::string text = type.info->name();
  for (const FieldInfo& each : type.info->fields()) {
    text += "\n  " + each.name + ": " + each.type->name() + (each.unit.empty() ? "" : " [" + each.unit + "]") +
            (each.description.empty() ? "" : "  " + each.description);
  }
  for (const EnumeratorInfo& each : type.info->enumerators()) text += "\n  " + each.name;
  return text;
}

py::object MakeOf(const Type& type, const py::args& positional, const py::dict& named) {
  Value value = NewValue(*type.info);
  if (positional.size() > 1) throw py::type_error(type.info->name() + " takes one value, or fields by their names");
  if (!positional.empty()) FromPython(*type.info, positional[0], value.at);
  if (!named.empty()) FromPython(*type.info, named, value.at, positional.empty());
  const TypeKind kind = type.info->kind();
  if (kind == TypeKind::kLeaf || kind == TypeKind::kEnumeration) return ToPython(*type.info, value.at, value.memory);
  return py::cast(std::move(value));
}

// Plugins in whose manifests the type stands: their modules make it known.
void LoadPluginWith(const std::string& name) {
  static auto* const plugins = new PluginManager;
  static auto* const scratch = new Runtime;
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const std::string wanted = "type=\"" + name + "\"";
  for (const auto& folder : plugins->search_path()) {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
      const std::string file = entry.path().filename().string();
      if (!file.ends_with(".manifest.xml")) continue;
      std::stringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      if (text.str().find(wanted) == std::string::npos) continue;
      const std::string plugin = file.substr(0, file.find('.'));
      if (!plugins->Load(plugin)) continue;
      for (const ModuleType* const type : plugins->modules().All()) {
        if (type->plugin == plugin) (void)plugins->modules().CreateSample(type->name, scratch->root());
      }
      if (FindType(name) != nullptr) return;
    }
  }
}

}  // namespace

const TypeInfo* LookForType(const std::string& name) {
  if (const TypeInfo* const known = FindType(name)) return known;
  // In a thread of its own: who asks may have an application's structure lock, and samples need another one's.
  WithoutGil([&] { std::thread([&] { LoadPluginWith(name); }).join(); });
  return FindType(name);
}

const TypeInfo& TypeNamed(const std::string& name) {
  if (const TypeInfo* const type = LookForType(name)) return *type;
  Throw({.message = "there is no type '" + name + "'",
         .hint = NearestNameHint(name, NamesOf(RegisteredTypes(), &TypeInfo::name))});
}

void BindValues(py::module_& module) {
  py::class_<Value>(module, "Value", R"(One value of a described type: its fields are attributes.

What has been published never changes, and lives as long as this object or an array of it, even if its buffer would
have been used again since. Numbers have the SI units that ``type(value).help`` tells; times are seconds. Lists of numbers
are NumPy arrays that look at the value where it lies, without a copy.

>>> pose = runnel.types.Pose2(x=1, y=2)
>>> pose.x, pose == pose.copy()
(1.0, True)
>>> pose
Pose2 {x: 1, y: 2, heading: 0}
)")
      .def("__getattr__",
           [](const Value& value, const std::string& name) {
             if (name.starts_with("__")) throw py::attribute_error(name);
             return GetField(value, name);
           })
      .def("__setattr__", SetField)
      .def("__dir__",
           [](const Value& value) {
             py::list names;
             for (const char* each : {"array", "copy", "plain", "type"}) names.append(each);
             for (const FieldInfo& each : value.type->fields()) names.append(each.name);
             return names;
           })
      .def("__repr__",
           [](const Value& value) { return value.type->name() + " " + ToText(*value.type, value.at, kShown); })
      .def("__str__", [](const Value& value) { return ToText(*value.type, value.at); })
      .def("__eq__",
           [](const Value& value, const py::object& other) -> py::object {
             if (py::isinstance<Value>(other)) {
               const auto& with = other.cast<const Value&>();
               return py::bool_(with.type == value.type && AreEqual(*value.type, value.at, with.at));
             }
             return py::reinterpret_borrow<py::object>(Py_NotImplemented);
           })
      .def("__len__", CountOf)
      .def("__bool__",
           [](const Value& value) { return value.type->kind() == TypeKind::kStructure || CountOf(value) > 0; })
      .def("__getitem__", ElementOf)
      .def("__getitem__", GetField, "A field, whatever its name is.")
      .def(
          "__array__",
          [](const Value& value, const py::object& dtype) {
            const py::object array = AsArray(value);
            return dtype.is_none() ? array : array.attr("astype")(dtype);
          },
          py::arg("dtype") = py::none())
      .def("__reduce__",
           [](const Value& value) {
             return py::make_tuple(py::module_::import("runnel._types").attr("restore"),
                                   py::make_tuple(value.type->name(), ToPlain(*value.type, value.at)));
           })
      .def("__copy__", CopyOf)
      .def("__deepcopy__", [](const Value& value, const py::dict&) { return CopyOf(value); })
      .def("array", AsArray, "A list of structures as a structured array that looks at it, without a copy.")
      .def("copy", CopyOf, "A value of one's own, which can be changed.")
      .def(
          "plain", [](const Value& value) { return ToPlain(*value.type, value.at); },
          "A copy made of dict, list, arrays, numbers and texts.")
      .def_property_readonly(
          "type", [](const Value& value) { return Type{value.type}; }, "The runnel.Type of the value.")
      .attr("__hash__") = py::none();

  py::class_<Type>(module, "Type", R"(A described type: called, it makes a value.

>>> runnel.types.Pose2.fields[2]
('heading', 'double', 'rad', '')
)")
      .def("__call__", [](const Type& type, const py::args& positional,
                          const py::kwargs& named) { return MakeOf(type, positional, named); })
      .def("__repr__", [](const Type& type) { return "<type " + type.info->name() + ">"; })
      .def("__eq__", [](const Type& type, const Type& other) { return type.info == other.info; })
      .def("__hash__", [](const Type& type) { return std::hash<const void*>()(type.info); })
      .def_property_readonly("name", [](const Type& type) { return type.info->name(); })
      .def_property_readonly(
          "meaning", [](const Type& type) { return type.info->semantic_tag(); },
          "What values stand for: 'pose', 'range_scan', ... or ''.")
      .def_property_readonly("fields", FieldsOf, "(name, type, SI unit, description) of each field.")
      .def_property_readonly(
          "names", [](const Type& type) { return NamesOf(type.info->enumerators(), &EnumeratorInfo::name); },
          "Of an enumeration.")
      .def_property_readonly(
          "dtype", [](const Type& type) { return DtypeOf(*type.info); },
          "As NumPy has it, or None where a value is not only numbers.")
      .def_property_readonly("help", HelpOf, "Fields with their units, as text.");
  module.def("type_named", [](const std::string& name) { return Type{&TypeNamed(name)}; });
  module.def("known_types", [] { return NamesOf(RegisteredTypes(), &TypeInfo::name); });
  module.def(
      "make",
      [](const std::string& type, const py::args& positional, const py::kwargs& named) {
        return MakeOf(Type{&TypeNamed(type)}, positional, named);
      },
      R"(A value of the type with this name, from fields, a dict, a list, an array or a text.

>>> runnel.make("Point2", "{x: 1, y: 2}") == runnel.make("Point2", x=1, y=2)
True
)");

  // What modules in Python have between them, though no C++ module has a port of it.
  internal::MakeTypedPortsKnown<bool>();
  internal::MakeTypedPortsKnown<std::int64_t>();
  internal::MakeTypedPortsKnown<double>();
  internal::MakeTypedPortsKnown<std::string>();
  internal::MakeTypedPortsKnown<std::vector<double>>();
  internal::MakeTypedPortsKnown<std::vector<float>>();
  internal::MakeTypedPortsKnown<std::vector<std::uint8_t>>();
}

}  // namespace runnel::python
