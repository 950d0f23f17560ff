#pragma once

#include <vector>

#include "plugins/genom_description/component.h"
#include "plugins/genom_description/description.h"
#include "plugins/genom_text/token.h"

namespace runnel::genom {

/// Of what properties are said.
enum class PropertyOwner { kComponent, kInterface, kPort, kTask, kAttribute, kFunction, kActivity };

[[nodiscard]] PropertyOwner OwnerOf(ServiceKind kind);

/// Adds what is said of the owner to what has been said before: some properties add up, of some the first holds, and
/// some may be said only once. Tells what may not be said.
bool AddProperty(Properties& properties, Property property, PropertyOwner owner, Problems& problems);

/// Puts components together of what the parser has read, and holds that against the rules. Whatever is against one is
/// told and left out; the rest stays.
class ComponentRules {
 public:
  explicit ComponentRules(Description& description) : description_(description), problems_(description.problems) {}

  /// The component or interface that is open, nullptr if none is.
  [[nodiscard]] Component* current() const { return current_; }

  /// Opens a component or an interface, made or opened again; nullptr if that cannot be.
  Component* Open(const Token& name, bool is_interface);
  /// Checks what can be checked only when all is there.
  void Close();

  /// From #pragma: what all components that are opened later require and provide.
  void RequireForAll(const Property& property) {
    AddProperty(for_all_, property, PropertyOwner::kInterface, problems_);
  }
  void ProvideForAll(Component& component) { provided_by_all_.push_back(&component); }

  bool AddComponentProperty(Property property);
  void AddIdsMember(const Token& name, Type* type);
  void AddPort(Port port, Properties properties);
  void AddTask(Task draft);
  /// If there is a service of that name, the draft must agree with it, and adds to it.
  void AddService(Service draft);

  /// The event of a state, made if it is new; nullptr if its name is taken.
  Type* Event(const Token& name, bool is_pause);
  /// A codel with parameters in the given locals; nullptr if it contradicts one of the same name.
  Codel* MakeCodel(Codel codel);
  /// A codel has been left out, so that nobody knows how state machines were meant.
  void LeaveCodelOut() { is_codel_left_out_ = true; }
  /// Finds what a parameter of a codel stands for. `has_source_name`: its path begins with a name in the source.
  [[nodiscard]] bool Resolve(Parameter& parameter, const std::vector<Parameter>& locals);

 private:
  void DeclareStandardEvents(Component& component);
  void Merge(Component& interface, PropertyKind how);
  void MergeIds(const Component& interface);
  void MergePorts(const Component& interface, bool is_turned);
  void MergeServices(const Component& interface, bool as_remotes);
  void AddRemote(const Service& service);
  [[nodiscard]] Properties CopiedProperties(const Properties& properties, const std::vector<Parameter>& locals);
  [[nodiscard]] Codel* Copied(const Codel& codel, const std::vector<Parameter>& locals);
  [[nodiscard]] bool IsNameUsed(std::string_view name, Place place, bool is_service);
  [[nodiscard]] bool Agree(const Service& draft, const Service& before);
  [[nodiscard]] bool CheckServiceCodels(const Service& service);
  void AttachCodels(const Properties& properties, Task* task, Service* service);
  void CheckNames(const Service& service);
  bool FollowPath(Parameter& parameter, Type* type, std::size_t from);

  Description& description_;
  Problems& problems_;
  Component* current_ = nullptr;
  bool is_codel_left_out_ = false;  // of the current one
  Properties for_all_ = {};
  std::vector<Component*> provided_by_all_ = {};
  std::map<std::string, Codel*, std::less<>> codels_ = {};  // the first of each name
};

/// The state machines of a component's tasks and activities; see closing_checks.cpp.
void BuildStateMachine(const std::vector<Codel*>& codels, std::map<std::string, Codel*, std::less<>>& states,
                       Problems& problems);
void CheckStateMachine(const std::map<std::string, Codel*, std::less<>>& states, bool needs_start, Place place,
                       Problems& problems);
/// Periods, delays and the clock of a component.
void CheckTimes(Component& component, Problems& problems);
/// Of codels whose names the headers in C have for something else.
void WarnOfCodelNames(const Component& component, Problems& problems);
/// Of services that must come after others which cannot come before.
void WarnOfServicesThatNeverStart(const Component& component, Problems& problems);
/// Asynchronous codels exclude nothing.
void CheckAsyncCodels(const Component& component, Problems& problems);

/// The codels of its component that must not run while this one does: those that use what it uses, where one of the
/// two writes, and that can run at the same time.
[[nodiscard]] std::vector<const Codel*> ConflictingCodels(const Codel& codel);
/// The attributes that must not be set or read meanwhile.
[[nodiscard]] std::vector<const Service*> ConflictingServices(const Codel& codel);
/// The codels that must not run while a service's parameters are set or read.
[[nodiscard]] std::vector<const Codel*> ConflictingCodels(const Service& service);

/// Whether a service names another of its component among what it interrupts, is before or is after: "all" are all, but it is
/// not before or after itself by that.
[[nodiscard]] bool Names(PropertyKind relation, const Service& service, const Service& other);
[[nodiscard]] inline bool Interrupts(const Service& service, const Service& other) {
  return Names(PropertyKind::kInterrupts, service, other);
}

}  // namespace runnel::genom
