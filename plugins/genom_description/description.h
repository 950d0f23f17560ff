#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/genom_description/component.h"
#include "plugins/genom_description/type.h"
#include "plugins/genom_text/preprocessor.h"

namespace runnel::genom {

/// All scopes and types of a description, and the rules of names: what may be declared where, and what a name means.
class Scopes {
 public:
  explicit Scopes(Problems& problems);
  Scopes(const Scopes&) = delete;
  Scopes& operator=(const Scopes&) = delete;

  [[nodiscard]] Scope* current() const { return current_; }
  void Enter(Scope* scope) { current_ = scope; }
  void Leave() { current_ = current_->parent != nullptr ? current_->parent : current_; }

  /// Enters a module, component or interface, made or opened again. If its name is taken, that is told, and a scope
  /// that nobody finds is entered.
  Scope* EnterModule(const std::string& name, Place place);
  /// The same for what has members; it cannot be opened again.
  Scope* EnterMembers(const std::string& name, Place place, TypeKind kind);

  /// A type without a name.
  Type* Make(TypeKind kind, Place place, Type* of = nullptr);
  /// A named one in the current scope; if the name is taken, that is told, and the result is nullptr.
  Type* Declare(TypeKind kind, const std::string& name, Place place);
  /// Stands for a declaration that was wrong, if its name is still free.
  void DeclareInvalid(const std::string& name, Place place);

  /// What "a::b" or "::a::b" means in the current scope; nullptr if it means nothing.
  [[nodiscard]] Type* Find(std::string_view name) const;
  /// "unknown type nav::pos", with the nearest name that can be seen from here as cure.
  void TellUnknown(std::string_view name, Place place) const;

  /// In the order of declaration.
  [[nodiscard]] const std::deque<Type>& types() const { return types_; }

 private:
  Scope* MakeScope(const std::string& name, Place place, bool is_module);
  [[nodiscard]] bool IsNameFree(const std::string& name, Place place, TypeKind kind);
  Type* Name(Type& type, const std::string& name);
  [[nodiscard]] Type* Completed(TypeKind kind, Type* forward, Place place);

  Problems& problems_;
  std::deque<Scope> scopes_ = {};
  std::deque<Type> types_ = {};
  std::map<std::string, Type*, std::less<>> by_full_name_ = {};
  Scope* current_ = nullptr;
};

/// All that a description says: types, interfaces, components. Owns what its pointers lead to.
///
/// Threads: not thread-safe; once read it does not change.
class Description {
 public:
  explicit Description(Diagnostics& diagnostics) : problems(diagnostics), scopes(problems) {}

  Problems problems;
  Scopes scopes;
  std::deque<Component> components = {};  ///< and interfaces, in order
  std::deque<Task> tasks = {};
  std::deque<Service> services = {};
  std::deque<Port> ports = {};
  std::deque<Remote> remotes = {};
  std::deque<Codel> codels = {};
  std::map<std::string, std::map<const Type*, std::string>> masquerades = {};  ///< by template
  std::string notice = {};                                                     ///< for the top of what is made from it

  [[nodiscard]] Component* FindComponent(std::string_view name);
};

/// Reads files as one description, in order. What is wrong is in the diagnostics; the description is complete only if
/// these are ok. Never throws, however the files look.
[[nodiscard]] std::unique_ptr<Description> ReadDescription(const std::vector<std::string>& files,
                                                           const PreprocessorOptions& options,
                                                           Diagnostics& diagnostics);
/// The same from a text; `name` stands in messages, and says where included files are looked for.
[[nodiscard]] std::unique_ptr<Description> ReadDescriptionText(const std::string& text, const std::string& name,
                                                               const PreprocessorOptions& options,
                                                               Diagnostics& diagnostics);

/// The whole description as JSON: types with their layout, interfaces, components with ports, tasks, services, codels and
/// what these exclude. What each field is, says the README.
[[nodiscard]] std::string DescriptionJson(const Description& description);

}  // namespace runnel::genom
