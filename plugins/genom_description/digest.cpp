#include <set>

#include <fmt/format.h>

#include "plugins/genom_description/component.h"

namespace runnel::genom {

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
