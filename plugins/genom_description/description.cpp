#include "plugins/genom_description/description.h"

#include "core/base/nearest_name.h"
#include "plugins/genom_description/component_json.h"
#include "plugins/genom_description/parser.h"

namespace runnel::genom {

namespace {

constexpr auto kOfModule = TypeKind::kInvalid;  // a module is opened again
constexpr std::size_t kLongestGuess = 100;      // guessing what was meant is not cheap

bool IsForwardOf(TypeKind forward, TypeKind kind) {
  return (forward == TypeKind::kForwardStruct && kind == TypeKind::kStruct) ||
         (forward == TypeKind::kForwardUnion && kind == TypeKind::kUnion);
}

}  // namespace

Scopes::Scopes(Problems& problems) : problems_(problems) { current_ = MakeScope("", {}, true); }

Scope* Scopes::MakeScope(const std::string& name, Place place, bool is_module) {
  Scope& scope = scopes_.emplace_back();
  scope.name = name;
  scope.full_name = current_ == nullptr ? "" : current_->full_name + "::" + name;
  scope.place = place;
  scope.is_module = is_module;
  scope.parent = current_;
  return &scope;
}

// Tells why if not. A forward declaration leaves its name free for what it announces.
bool Scopes::IsNameFree(const std::string& name, Place place, TypeKind kind) {
  if (current_->is_module && current_->parent != nullptr && name == current_->name) {
    problems_.Add(place, "'" + name + "' cannot be declared within what is called so itself",
                  problems_.DeclaredAt(current_->place));
    return false;
  }
  const auto type = current_->types.find(name);
  if (type != current_->types.end() && !IsForwardOf(type->second->kind, kind)) {
    if (type->second->kind != TypeKind::kInvalid) {
      problems_.Add(place, "there is " + KindAndName(*type->second) + " already",
                    problems_.DeclaredAt(type->second->place));
    }
    return false;
  }
  const auto child = current_->children.find(name);
  if (child == current_->children.end() || kind == kOfModule) return true;
  problems_.Add(place, "there is a module '" + name + "' already", problems_.DeclaredAt(child->second->place));
  return false;
}

Scope* Scopes::EnterModule(const std::string& name, Place place) {
  const bool is_free = IsNameFree(name, place, kOfModule);
  const auto child = current_->children.find(name);
  if (is_free && child != current_->children.end()) return current_ = child->second;
  Scope* scope = MakeScope(is_free ? name : "&" + name, place, true);
  current_->children.insert_or_assign(scope->name, scope);
  return current_ = scope;
}

Scope* Scopes::EnterMembers(const std::string& name, Place place, TypeKind kind) {
  return current_ = MakeScope(IsNameFree(name, place, kind) ? name : "&" + name, place, false);
}

Type* Scopes::Make(TypeKind kind, Place place, Type* of) {
  Type& type = types_.emplace_back();
  type.kind = kind;
  type.place = place;
  type.type = of;
  return &type;
}

// The forward declaration becomes known by another name, so that both can be found.
Type* Scopes::Completed(TypeKind kind, Type* forward, Place place) {
  if (forward->place.file != place.file) {
    problems_.Add(place, KindAndName(*forward) + " must be defined in the file that announces it",
                  problems_.DeclaredAt(forward->place));
    return nullptr;
  }
  by_full_name_.erase(forward->full_name);
  current_->types.erase(forward->name);
  Type* type = Declare(kind, forward->name, place);
  forward->type = type;
  return type;
}

Type* Scopes::Declare(TypeKind kind, const std::string& name, Place place) {
  if (kind == TypeKind::kForwardStruct || kind == TypeKind::kForwardUnion) {
    const auto again = current_->types.find(name);
    if (again != current_->types.end() && again->second->kind == kind) return again->second;
  }
  if (!IsNameFree(name, place, kind)) return nullptr;
  if (const auto before = current_->types.find(name); before != current_->types.end()) {
    return Completed(kind, before->second, place);
  }
  return Name(*Make(kind, place), name);
}

Type* Scopes::Name(Type& type, const std::string& name) {
  type.name = name;
  type.full_name = current_->full_name + "::" + name;
  current_->types.emplace(name, &type);
  by_full_name_.emplace(type.full_name, &type);
  return &type;
}

void Scopes::DeclareInvalid(const std::string& name, Place place) {
  if (current_->types.contains(name) || current_->children.contains(name)) return;
  (void)Name(*Make(TypeKind::kInvalid, place), name);
}

Type* Scopes::Find(std::string_view name) const {
  if (name.starts_with("::")) {
    const auto found = by_full_name_.find(name);
    return found == by_full_name_.end() ? nullptr : found->second;
  }
  for (const Scope* scope = current_; scope != nullptr; scope = scope->parent) {
    const auto found = by_full_name_.find(scope->full_name + "::" + std::string(name));
    if (found != by_full_name_.end()) return found->second;
  }
  return nullptr;
}

void Scopes::TellUnknown(std::string_view name, Place place) const {
  std::vector<std::string> names;
  for (const auto& [full_name, type] : by_full_name_) {
    if (name.size() > kLongestGuess || problems_.count() > Problems::kMost || names.size() > 2000) break;
    if (full_name.find('&') != std::string::npos || full_name.size() > kLongestGuess) continue;
    for (const Scope* scope = current_; scope != nullptr; scope = scope->parent) {
      if (!full_name.starts_with(scope->full_name + "::")) continue;
      names.push_back(full_name.substr(scope->full_name.size() + 2));
      break;
    }
  }
  const std::string nearest = NearestName(name, names);
  problems_.Add(place, "unknown type '" + std::string(name) + "'",
                nearest.empty() ? "a type is declared before it is used" : "did you mean '" + nearest + "'?");
}

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
