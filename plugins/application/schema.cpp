#include "plugins/application/schema.h"

#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/element/runtime.h"
#include "core/port/port.h"
#include "core/types/type_info.h"
#include "core/xml/xml_writing.h"
#include "plugins/application_files/path_use.h"

namespace runnel {

namespace {

/// Names that may stand in an attribute, each with what is to be said of it.
using Choices = std::map<std::string, std::string>;

/// What the module types have, over all of them.
struct Known {
  Choices types;
  Choices parameters;
  Choices port_types;
};

void Join(std::string& list, const std::string& word) { list += (list.empty() ? "" : ", ") + word; }

void LookAt(const ModuleType& type, FrameworkElement& module, Known& known) {
  for (const auto& [element, configurable] : ConfigurablesOf(module)) {
    Join(known.parameters[element->name()], type.name);
  }
  for (const Port* port : PortsOf(module)) known.port_types.try_emplace(port->type().name());
}

Known LookAtAll(const ModuleRegistry& modules, Diagnostics& diagnostics) {
  Known known;
  Runtime runtime;
  for (const ModuleType* type : modules.All()) {
    known.types[type->name] = type->summary;
    const auto module = modules.CreateSample(type->name, runtime.root());
    if (!module) {
      diagnostics.Add(module.error());
      continue;
    }
    LookAt(*type, **module, known);
    if (auto deleted = runtime.Delete(**module); !deleted) diagnostics.Add(deleted.error());
  }
  return known;
}

NewElement Documentation(const std::string& text) {
  return {.name = "xs:annotation", .children = {{.name = "xs:documentation", .text = text}}};
}

NewElement Restriction(const std::string& base, std::vector<NewElement> facets) {
  return {.name = "xs:simpleType",
          .children = {{.name = "xs:restriction", .attributes = {{"base", base}}, .children = std::move(facets)}}};
}

NewElement Pattern(const std::string& expression) {
  return Restriction("xs:string", {{.name = "xs:pattern", .attributes = {{"value", expression}}}});
}

NewElement Enumeration(const Choices& choices) {
  std::vector<NewElement> facets;
  for (const auto& [name, said] : choices) {
    NewElement facet{.name = "xs:enumeration", .attributes = {{"value", name}}};
    if (!said.empty()) facet.children.push_back(Documentation(said));
    facets.push_back(std::move(facet));
  }
  return Restriction("xs:string", std::move(facets));
}

NewElement Named(std::string name, NewElement type) {
  type.attributes.insert(type.attributes.begin(), {"name", std::move(name)});
  type.after_blank_line = true;
  return type;
}

// What is said of attributes of one kind, at one place. The patterns are those of attribute_rule.cpp.
std::vector<NewElement> SimpleTypes(const Known& known) {
  return {
      Named("name", Pattern("[^/,\\s]+")),
      Named("path", Pattern("\\S(.*\\S)?")),
      Named("path_list", Pattern("[^,]*[^,\\s][^,]*")),
      Named("number", Pattern("\\s*[+\\-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+\\-]?[0-9]+)?\\s*")),
      Named("duration", Pattern("\\s*[+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+\\-]?[0-9]+)?\\s*(ns|us|ms|s|min)\\s*")),
      Named("module_type", Enumeration(known.types)),
      Named("parameter_name", Enumeration(known.parameters)),
      Named("port_type", Enumeration(known.port_types)),
  };
}

// By AttributeKind.
constexpr std::array kAttributeTypes{
    "xs:string", "name",     "name",      "path",        "path_list", "xs:nonNegativeInteger",
    "number",    "duration", "xs:string", "module_type", "port_type"};

/// Writes the schema of one set of words.
class SchemaWriter {
 public:
  SchemaWriter(const XmlTagRegistry& tags, const Known& known) : tags_(tags), known_(known) {}

  std::string Write() {
    NewElement schema{.name = "xs:schema", .attributes = {{"xmlns:xs", "http://www.w3.org/2001/XMLSchema"}}};
    for (const XmlTag* tag : AllTags()) {
      if (!tag->parents.empty()) continue;
      schema.children.push_back(
          {.name = "xs:element", .attributes = {{"name", tag->name}, {"type", TypeName("", tag->name)}}});
    }
    for (const XmlTag* tag : AllTags()) {
      std::set<std::string> written;
      for (const std::string& parent : tag->parents.empty() ? kRoot : tag->parents) {
        std::string name = TypeName(parent, tag->name);
        if (!written.insert(name).second) continue;
        schema.children.push_back(Named(std::move(name), TagType(*tag, parent)));
      }
    }
    for (NewElement& type : SimpleTypes(known_)) schema.children.push_back(std::move(type));
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<!-- Written by `runnel schema`; a test keeps it so. -->\n" +
           ElementText(schema);
  }

 private:
  // In the order of their names; every tag can be reached from a root.
  [[nodiscard]] std::vector<const XmlTag*> AllTags() const {
    std::map<std::string, const XmlTag*> found;
    std::vector<std::string> open{"application", "group_type"};
    while (!open.empty()) {
      const std::string name = std::move(open.back());
      open.pop_back();
      const XmlTag* const tag = tags_.FindTag(name);
      if (tag == nullptr || !found.emplace(name, tag).second) continue;
      for (std::string& inner : tags_.TagsIn(name)) open.push_back(std::move(inner));
    }
    std::vector<const XmlTag*> tags;
    for (const auto& [name, tag] : found) tags.push_back(tag);
    return tags;
  }

  // A parameter of a module is called as those of modules are, others as their file likes.
  static std::string TypeName(const std::string& parent, const std::string& tag) {
    return tag == "parameter" && parent == "module" ? "module_parameter" : tag + "_tag";
  }

  NewElement TagType(const XmlTag& tag, const std::string& parent) {
    NewElement type{.name = "xs:complexType"};
    if (!tag.summary.empty()) type.children.push_back(Documentation(tag.summary));
    NewElement choice{.name = "xs:choice", .attributes = {{"minOccurs", "0"}, {"maxOccurs", "unbounded"}}};
    for (const std::string& inner : tags_.TagsIn(tag.name)) {
      choice.children.push_back(
          {.name = "xs:element", .attributes = {{"name", inner}, {"type", TypeName(tag.name, inner)}}});
    }
    if (!choice.children.empty()) type.children.push_back(std::move(choice));
    for (const AttributeRule& rule : tags_.Rules(tag)) {
      type.children.push_back(Attribute(tag, parent, rule));
    }
    return type;
  }

  static NewElement Attribute(const XmlTag& tag, const std::string& parent, const AttributeRule& rule) {
    NewElement attribute{.name = "xs:attribute", .attributes = {{"name", rule.name}}};
    std::string type = kAttributeTypes[static_cast<std::size_t>(rule.kind)];
    if (parent == "module" && tag.name == "parameter" && rule.name == "name") {
      type = "parameter_name";
    }
    if (rule.choices.empty()) attribute.attributes.emplace_back("type", type);
    if (rule.required) attribute.attributes.emplace_back("use", "required");
    if (!rule.summary.empty()) attribute.children.push_back(Documentation(rule.summary));
    if (!rule.choices.empty()) {
      Choices choices;
      for (const std::string& each : rule.choices) choices.try_emplace(each);
      attribute.children.push_back(Enumeration(choices));
    }
    return attribute;
  }

  inline static const std::vector<std::string> kRoot{""};
  const XmlTagRegistry& tags_;
  const Known& known_;
};

}  // namespace

std::string SchemaText(const XmlTagRegistry& tags, const ModuleRegistry& modules, Diagnostics& diagnostics) {
  const Known known = LookAtAll(modules, diagnostics);
  return SchemaWriter(tags, known).Write();
}

}  // namespace runnel
