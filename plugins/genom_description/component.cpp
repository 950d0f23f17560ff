#include "plugins/genom_description/component.h"

#include <array>
#include <set>

#include <fmt/format.h>

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

namespace {

// FNV-1a.
class Hash {
 public:
  void Add(std::string_view text) {
    for (const char c : text) AddByte(static_cast<unsigned char>(c));
    AddByte(0);
  }
  [[nodiscard]] std::string ToText() const { return fmt::format("{:016x}", value_); }

 private:
  void AddByte(unsigned char byte) { value_ = (value_ ^ byte) * 1099511628211u; }
  std::uint64_t value_ = 14695981039346656037u;
};

// What a type is made of, and not how it is called, which each type does once.
class TypeHash {
 public:
  explicit TypeHash(Hash& hash) : hash_(hash) {}

  void Add(const Type* type) {
    open_.push_back(type);
    while (!open_.empty()) {
      const Type* next = FinalType(open_.back());
      open_.pop_back();
      AddOne(*next);
    }
  }

 private:
  void AddOne(const Type& type) {
    hash_.Add(NameOf(type.kind));
    hash_.Add(type.full_name);
    if (!type.full_name.empty() && !seen_.insert(&type).second) return;
    if (type.length != Type::kUnbounded) hash_.Add(std::to_string(type.length));
    for (const Type* each : type.members) {
      hash_.Add(each->name);
      for (const Constant& label : each->labels) hash_.Add(label.ToText());
      if (each->kind != TypeKind::kEnumerator) open_.push_back(each->type);
    }
    if (type.type != nullptr && type.kind != TypeKind::kEnumerator) open_.push_back(type.type);
  }

  Hash& hash_;
  std::vector<const Type*> open_ = {};
  std::set<const Type*> seen_ = {};
};

}  // namespace

std::string DigestOf(const Component& component) {
  Hash hash;
  TypeHash types(hash);
  for (const Port* each : component.ports) {
    hash.Add(each->is_input ? "in" : "out");
    hash.Add(each->is_multiple ? "multiple" : "");
    hash.Add(each->name);
    types.Add(each->type);
  }
  for (const Service* service : component.services) {
    hash.Add(NameOf(service->kind));
    hash.Add(service->name);
    for (const Parameter& each : service->parameters) {
      if (each.is_variable) continue;
      hash.Add(NameOf(each.direction));
      hash.Add(each.name);  // by which requests say it
      types.Add(each.type);
    }
    const Task* const task = service->task();
    std::set<std::string> exceptions;
    for (const Properties* from : {&service->properties, &component.properties, task ? &task->properties : nullptr}) {
      const Property* const found = from != nullptr ? Find(*from, PropertyKind::kThrow) : nullptr;
      if (found == nullptr) continue;
      for (const Type* each : found->exceptions) exceptions.insert(each->full_name);
    }
    for (const std::string& each : exceptions) hash.Add(each);
  }
  return hash.ToText();
}

}  // namespace runnel::genom
