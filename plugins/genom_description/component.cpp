#include "plugins/genom_description/component.h"

#include <array>

namespace runnel::genom {

namespace {

constexpr std::array<std::string_view, 21> kPropertyNames = {
    "doc",        "version", "lang",    "email",      "require", "codels-require", "clock-rate",
    "provides",   "uses",    "extends", "throw",      "period",  "delay",          "priority",
    "scheduling", "stack",   "task",    "interrupts", "before",  "after",          "codel"};
constexpr std::array<std::string_view, 3> kServiceNames = {"attribute", "function", "activity"};
constexpr std::array<std::string_view, 3> kDirectionNames = {"in", "out", "inout"};
constexpr std::array<std::string_view, 3> kCodelNames = {"validate", "simple", "state machine"};
constexpr std::array<std::string_view, 5> kSourceNames = {"", "ids", "local", "port", "remote"};

}  // namespace

std::string_view NameOf(PropertyKind kind) { return kPropertyNames.at(static_cast<std::size_t>(kind)); }
std::string_view NameOf(ServiceKind kind) { return kServiceNames.at(static_cast<std::size_t>(kind)); }
std::string_view NameOf(Direction direction) { return kDirectionNames.at(static_cast<std::size_t>(direction)); }
std::string_view NameOf(CodelKind kind) { return kCodelNames.at(static_cast<std::size_t>(kind)); }
std::string_view NameOf(ParameterSource source) { return kSourceNames.at(static_cast<std::size_t>(source)); }

const Property* Find(const Properties& properties, PropertyKind kind) {
  const auto found = std::ranges::find(properties, kind, &Property::kind);
  return found == properties.end() ? nullptr : &*found;
}

std::string TextOf(const Properties& properties, PropertyKind kind, std::string otherwise) {
  const Property* found = Find(properties, kind);
  return found == nullptr ? otherwise : found->text;
}

std::vector<Codel*> CodelsOf(const Properties& properties) {
  std::vector<Codel*> codels;
  for (const Property& each : properties) {
    if (each.kind == PropertyKind::kCodel) codels.push_back(each.codel);
  }
  return codels;
}

std::string LastName(const std::vector<PathStep>& path) {
  for (auto step = path.rbegin(); step != path.rend(); ++step) {
    if (!step->member.empty()) return step->member;
  }
  return "";
}

const Parameter* FindParameter(const std::vector<Parameter>& parameters, std::string_view name) {
  const auto found = std::ranges::find(parameters, name, &Parameter::name);
  return found == parameters.end() ? nullptr : &*found;
}

Task* Service::task() const {
  const Property* found = Find(properties, PropertyKind::kTask);
  return found == nullptr ? nullptr : found->task;
}

std::vector<Codel*> Component::codels() const {
  std::vector<Codel*> all;
  for (const Task* each : tasks) std::ranges::copy(CodelsOf(each->properties), std::back_inserter(all));
  for (const Service* each : services) std::ranges::copy(CodelsOf(each->properties), std::back_inserter(all));
  return all;
}

}  // namespace runnel::genom
