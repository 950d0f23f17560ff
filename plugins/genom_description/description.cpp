#include "plugins/genom_description/description.h"

#include "plugins/genom_description/component_json.h"
#include "plugins/genom_description/parser.h"

namespace runnel::genom {

namespace {

// What can be said only when all has been read.
void CheckTypes(Description& description) {
  for (const Type& type : description.scopes.types()) {
    const bool is_forward = type.Is(TypeKind::kForwardStruct) || type.Is(TypeKind::kForwardUnion);
    if (is_forward && type.type == nullptr) {
      description.problems.Add(type.place, KindAndName(type) + " is announced, and never defined");
    } else if (is_forward && HoldsItself(type.type)) {  // what is not announced cannot be in what it holds
      description.problems.Add(type.type->place, KindAndName(*type.type) + " would hold itself",
                               "a sequence without a bound can hold what it is in");
    }
  }
}

template <typename Read>
std::unique_ptr<Description> ReadBy(const PreprocessorOptions& options, Diagnostics& diagnostics, const Read& read) {
  auto description = std::make_unique<Description>(diagnostics);
  Preprocessor preprocessor(options, description->problems);
  read(preprocessor);
  description->notice = preprocessor.notice();
  if (preprocessor.is_given_up()) return description;  // what is missing would only lead to mistakes that are none
  Parser(TokensOf(preprocessor.TakeTokens(), description->problems), *description).Parse();
  CheckTypes(*description);
  return description;
}

}  // namespace

Component* Description::FindComponent(std::string_view name) {
  const auto found = std::ranges::find(components, name, &Component::name);
  return found == components.end() ? nullptr : &*found;
}

std::unique_ptr<Description> ReadDescription(const std::vector<std::string>& files, const PreprocessorOptions& options,
                                             Diagnostics& diagnostics) {
  return ReadBy(options, diagnostics, [&](Preprocessor& preprocessor) {
    for (const std::string& file : files) preprocessor.Read(file);
  });
}

std::unique_ptr<Description> ReadDescriptionText(const std::string& text, const std::string& name,
                                                 const PreprocessorOptions& options, Diagnostics& diagnostics) {
  return ReadBy(options, diagnostics, [&](Preprocessor& preprocessor) { preprocessor.ReadText(text, name); });
}

std::string DescriptionJson(const Description& description) {
  Layouts layouts;
  const JsonWriter writer(description.problems, layouts);
  Json json;
  json["notice"] = description.notice;
  json["files"] = description.problems.files();
  json["types"] = Json::array();
  for (const Type& each : description.scopes.types()) {
    if (JsonWriter::IsDeclared(each)) json["types"].push_back(writer.Declared(each));
  }
  json["interfaces"] = Json::array();
  json["components"] = Json::array();
  for (const Component& each : description.components) {
    json[each.is_interface ? "interfaces" : "components"].push_back(writer.ComponentJson(each));
  }
  json["masquerades"] = Json::object();
  for (const auto& [name, types] : description.masquerades) {
    for (const auto& [type, text] : types) json["masquerades"][name][type->ShownName()] = text;
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace runnel::genom
