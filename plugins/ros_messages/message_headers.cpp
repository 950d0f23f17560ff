#include <algorithm>
#include <set>

#include "core/base/characters.h"
#include "core/types/type_of.h"
#include "plugins/ros_messages/internal/message_leaf.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

namespace {

std::string PathOf(const std::string& name) {
  return PackageOf(name) + "/" + NearestFieldName(LastNameOf(name)) + ".h";
}

std::string MemberOf(const std::string& field) { return IsCppKeyword(field) ? field + "_" : field; }

// What Runnel has a type of its own for; "" for others.
std::string_view KnownType(const MessageDefinition& nested) {
  if (nested.name == internal::kTimeMessage) return "runnel::Time";
  if (nested.name == internal::kDurationMessage) return "runnel::Duration";
  return nested.fields.empty() ? "runnel::Signal" : "";
}

std::string NumberTypeOf(MessageType type) {
  if (type == MessageType::kBool) return "bool";
  if (type == MessageType::kFloat32) return "float";
  if (type == MessageType::kFloat64) return "double";
  if (type == MessageType::kByte) return "std::uint8_t";
  return "std::" + std::string(NameOf(type)) + (type == MessageType::kString ? "" : "_t");
}

// A number or a text as it stands in a .msg file, for C++.
std::string LiteralOf(MessageType type, std::string text) {
  const bool is_quoted = text.size() > 1 && (text.front() == '"' || text.front() == '\'');
  if (type == MessageType::kString) return Quoted(is_quoted ? text.substr(1, text.size() - 2) : text);
  if (type == MessageType::kBool)
    return text.starts_with('t') || text.starts_with('T') || text == "1" ? "true" : "false";
  if (type == MessageType::kUint64) return text + "U";
  return type == MessageType::kFloat32 ? "static_cast<float>(" + text + ")" : text;
}

class HeaderWriter {
 public:
  explicit HeaderWriter(const MessageLibrary& library) : library_(library) {}

  Result<std::string> Write(const MessageDefinition& message) {
    const std::string name = LastNameOf(message.name);
    std::string fields, constants, described;
    for (const MessageConstant& each : message.constants) constants += ConstantOf(each);
    for (const MessageField& field : message.fields) {
      if (field.type == MessageType::kWideString) {
        return Error{.message = "the field '" + field.name + "' of " + message.name + " is a wide string",
                     .hint = "take a string, in UTF-8"};
      }
      const std::string member = MemberOf(field.name);
      fields += "  " + TypeOfField(field) + " " + member + InitialOf(field) + ";\n";
      described += "\n      .Field(\"" + field.name + "\", &" + name + "::" + member + ")";
    }
    if (message.fields.empty()) {
      return Error{.message = message.name + " has no fields", .hint = "take runnel::Signal"};
    }
    std::string text = "#pragma once\n\n// " + message.name + " of ROS 2, written by 'runnel ros2 import'.\n\n";
    for (const char* header : {"array", "cstdint", "string", "vector"})
      text += "#include <" + std::string(header) + ">\n";
    text += uses_signals_ ? "\n#include <runnel/core/types/builtin_types.h>\n#include <runnel/types.h>\n\n"
                          : "\n#include <runnel/types.h>\n\n";
    for (const std::string& include : includes_) text += "#include \"" + include + "\"\n";
    if (!includes_.empty()) text += "\n";
    return text + "namespace " + PackageOf(message.name) + " {\n\nstruct " + name + " {\n" + constants + fields +
           "};\n\ninline void Describe(runnel::TypeBuilder<" + name + ">& type) {\n  type.Name(\"" + message.name +
           "\")" + described + ";\n}\n\n}  // namespace " + PackageOf(message.name) + "\n";
  }

 private:
  static std::string ConstantOf(const MessageConstant& constant) {
    const auto parsed = ParseMessage(constant.type + " value", "a/msg/A", "");
    if (!parsed || parsed->fields.front().type == MessageType::kWideString) return "";
    const MessageType type = parsed->fields.front().type;
    const std::string cpp_type = type == MessageType::kString ? "const char*" : NumberTypeOf(type);
    return "  static constexpr " + cpp_type + " " + MemberOf(constant.name) + " = " + LiteralOf(type, constant.value) +
           ";\n";
  }

  std::string ElementOf(const MessageField& field) {
    if (field.type != MessageType::kNested) return NumberTypeOf(field.type);
    const MessageDefinition& nested = **library_.Get(field.nested);
    uses_signals_ = uses_signals_ || nested.fields.empty();
    if (!KnownType(nested).empty()) return std::string(KnownType(nested));
    includes_.insert(PathOf(field.nested));
    return PackageOf(field.nested) + "::" + LastNameOf(field.nested);
  }

  std::string TypeOfField(const MessageField& field) {
    const std::string element = ElementOf(field);
    if (field.count == MessageCount::kOne) return element;
    if (field.count == MessageCount::kArray)
      return "std::array<" + element + ", " + std::to_string(field.capacity) + ">";
    // Those of bool have no elements that could be pointed at.
    return "std::vector<" + (element == "bool" ? "std::uint8_t" : element) + ">";
  }

  static std::string InitialOf(const MessageField& field) {
    const std::string& given = field.default_value;
    const bool is_number = SizeOf(field.type) > 0;
    if (given.empty())
      return is_number && field.count == MessageCount::kOne ? " = {}" : field.count == MessageCount::kArray ? "{}" : "";
    if (field.count == MessageCount::kOne) return " = " + LiteralOf(field.type, given);
    std::string with_marks = given;
    std::ranges::replace(with_marks, '\'', '"');
    const auto texts = FromText<std::vector<std::string>>(with_marks);
    std::string list;
    if (texts) {
      for (const std::string& each : *texts) list += (list.empty() ? "" : ", ") + LiteralOf(field.type, each);
    }
    return " = {" + list + "}";
  }

  const MessageLibrary& library_;
  std::set<std::string> includes_;
  bool uses_signals_ = false;
};

}  // namespace

Result<FileTexts> CppHeadersOf(const std::vector<const MessageDefinition*>& messages, const MessageLibrary& library) {
  std::set<const MessageDefinition*> wanted(messages.begin(), messages.end());
  for (const MessageDefinition* const message : messages) {
    for (const MessageDefinition* const inside : library.InsideOf(*message)) {
      if (KnownType(*inside).empty()) wanted.insert(inside);
    }
  }
  FileTexts files;
  for (const MessageDefinition* const each : wanted) {
    auto text = HeaderWriter(library).Write(*each);
    if (!text) return text.error();
    files[PathOf(each->name)] = std::move(*text);
  }
  return files;
}

namespace {

std::string DescriptionOf(const std::string& package, const std::set<std::string>& needed) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<package format=\"3\">\n"
      "  <name>" +
      package +
      "</name>\n"
      "  <version>0.0.0</version>\n"
      "  <description>What applications of Runnel publish.</description>\n"
      "  <maintainer email=\"you@example.com\">you</maintainer>\n"
      "  <license>that of your application</license>\n\n"
      "  <buildtool_depend>ament_cmake</buildtool_depend>\n"
      "  <buildtool_depend>rosidl_default_generators</buildtool_depend>\n";
  for (const std::string& each : needed) text += "  <depend>" + each + "</depend>\n";
  return text +
         "  <exec_depend>rosidl_default_runtime</exec_depend>\n"
         "  <member_of_group>rosidl_interface_packages</member_of_group>\n\n"
         "  <export>\n    <build_type>ament_cmake</build_type>\n  </export>\n</package>\n";
}

std::string BuildFileOf(const std::string& package, const std::set<std::string>& needed, const std::string& files) {
  std::string text = "cmake_minimum_required(VERSION 3.8)\nproject(" + package +
                     ")\n\nfind_package(ament_cmake REQUIRED)\nfind_package(rosidl_default_generators REQUIRED)\n";
  std::string dependencies;
  for (const std::string& each : needed) {
    text += "find_package(" + each + " REQUIRED)\n";
    dependencies += " " + each;
  }
  text += "\nrosidl_generate_interfaces(${PROJECT_NAME}\n" + files;
  if (!dependencies.empty()) text += "  DEPENDENCIES" + dependencies + "\n";
  return text + ")\n\nament_export_dependencies(rosidl_default_runtime)\nament_package()\n";
}

}  // namespace

FileTexts MessagePackageOf(const std::vector<const MessageDefinition*>& messages, const MessageLibrary& library) {
  FileTexts files;
  if (messages.empty()) return files;
  const std::string package = PackageOf(messages.front()->name);
  std::set<std::string> needed;
  const auto add = [&](const MessageDefinition& message) {
    if (PackageOf(message.name) == package) {
      files["msg/" + LastNameOf(message.name) + ".msg"] = TextOf(message);
    } else {
      needed.insert(PackageOf(message.name));
    }
  };
  for (const MessageDefinition* const message : messages) {
    add(*message);
    for (const MessageDefinition* const inside : library.InsideOf(*message)) add(*inside);
  }
  std::string names;
  for (const auto& [name, text] : files) names += "  \"" + name + "\"\n";
  files["package.xml"] = DescriptionOf(package, needed);
  files["CMakeLists.txt"] = BuildFileOf(package, needed, names);
  return files;
}

}  // namespace runnel
