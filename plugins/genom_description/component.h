#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plugins/genom_description/type.h"

namespace runnel::genom {

struct Codel;
struct Component;
struct Service;
struct Task;

enum class Direction { kIn, kOut, kInOut };
enum class ParameterSource { kNone, kIds, kLocal, kPort, kRemote };

/// A value that is the default of a parameter, of a member of one, of an element; or only its documentation.
struct Initializer {
  Place place = {};
  std::string member = {};                  ///< for which member, "" if not said
  std::optional<std::uint64_t> index = {};  ///< for which element
  std::string doc = {};
  bool has_doc = false;
  Constant value = {};  ///< kNone: none, or the parts
  bool is_compound = false;
  std::vector<Initializer> parts = {};
};

struct PathStep {
  std::string member = {};  ///< "": an index
  std::uint64_t index = 0;

  friend bool operator==(const PathStep&, const PathStep&) = default;
};

/// Data published by a component, or taken by it.
struct Port {
  Place place = {};
  std::string name = {};
  bool is_input = false;
  bool is_multiple = false;
  Type* type = nullptr;
  Type* entry = nullptr;  ///< its name in the scope of the component
  std::string doc = {};
  std::string interface = {};  ///< that it is of; "": the component's own
};

/// A service of others that the component calls.
struct Remote;

/// Of a service, or of a codel.
struct Parameter {
  Place place = {};
  ParameterSource source = ParameterSource::kNone;
  Direction direction = Direction::kIn;
  bool is_variable = false;  ///< declared by `local`: no parameter of the service
  std::string name = {};
  std::vector<PathStep> path = {};  ///< into the ids or the local; of a port or remote its name
  Type* type = nullptr;
  Port* port = nullptr;
  Remote* remote = nullptr;
  std::optional<Initializer> initial = {};
};

enum class ServiceKind { kAttribute, kFunction, kActivity };

struct Remote {
  Place place = {};
  std::string name = {};
  ServiceKind kind = ServiceKind::kFunction;
  std::vector<Parameter> parameters = {};
  Type* entry = nullptr;
};

enum class CodelKind { kValidate, kSimple, kStateMachine };

/// A function of the user.
struct Codel {
  Place place = {};
  std::string name = {};
  CodelKind kind = CodelKind::kSimple;
  bool is_async = false;
  std::vector<Parameter> parameters = {};
  std::vector<Type*> triggers = {};  ///< the states in which it runs
  std::vector<Type*> yields = {};    ///< the events that it may return
  Component* component = nullptr;
  Task* task = nullptr;        ///< in which it runs; nullptr: in the control task
  Service* service = nullptr;  ///< nullptr: of the permanent activity of its task
  bool is_reached_from_start = false;
  bool is_reached_from_stop = false;
};

enum class PropertyKind {
  kDoc,
  kVersion,
  kLanguage,
  kEmail,
  kRequire,
  kCodelsRequire,
  kClockRate,
  kProvides,
  kUses,
  kExtends,
  kThrow,
  kPeriod,
  kDelay,
  kPriority,
  kScheduling,
  kStack,
  kTask,
  kInterrupts,
  kBefore,
  kAfter,
  kCodel
};

/// What is said of a component, task, service or port.
struct Property {
  PropertyKind kind = PropertyKind::kDoc;
  Place place = {};
  std::string text = {};                ///< doc, version, …
  double number = 0;                    ///< s, or bytes
  std::vector<std::string> texts = {};  ///< of lists of texts and names
  std::vector<Place> places = {};       ///< of these
  std::vector<Type*> exceptions = {};
  std::vector<Component*> interfaces = {};
  Task* task = nullptr;
  Codel* codel = nullptr;
};

using Properties = std::vector<Property>;
[[nodiscard]] std::string_view NameOf(PropertyKind kind);
[[nodiscard]] std::string_view NameOf(ServiceKind kind);
[[nodiscard]] std::string_view NameOf(Direction direction);
[[nodiscard]] std::string_view NameOf(CodelKind kind);
[[nodiscard]] std::string_view NameOf(ParameterSource source);
/// The first property of the kind, nullptr if there is none.
[[nodiscard]] const Property* Find(const Properties& properties, PropertyKind kind);
[[nodiscard]] std::string TextOf(const Properties& properties, PropertyKind kind, std::string otherwise = {});

struct Task {
  Place place = {};
  std::string name = {};
  Component* component = nullptr;
  Properties properties = {};
  std::map<std::string, Codel*, std::less<>> states = {};  ///< which codel runs in which state
};

struct Service {
  Place place = {};
  std::string name = {};
  ServiceKind kind = ServiceKind::kFunction;
  Component* component = nullptr;
  Properties properties = {};
  std::vector<Parameter> parameters = {};  ///< and the variables declared by `local`
  std::map<std::string, Codel*, std::less<>> states = {};

  [[nodiscard]] Task* task() const;
};

struct Component {
  Place place = {};
  std::string name = {};
  bool is_interface = false;
  bool is_open = false;
  Scope* scope = nullptr;
  Scope* pause_scope = nullptr;
  Scope* ids_scope = nullptr;
  Type* ids = nullptr;  ///< nullptr without any
  Properties properties = {};
  std::vector<Task*> tasks = {};
  std::vector<Port*> ports = {};
  std::vector<Service*> services = {};
  std::vector<Remote*> remotes = {};
  double clock_rate = 0;  ///< s

  [[nodiscard]] std::vector<Codel*> codels() const;
};

/// The codels among the properties, in order.
[[nodiscard]] std::vector<Codel*> CodelsOf(const Properties& properties);

/// The name that a path gives to what it leads to.
[[nodiscard]] std::string LastName(const std::vector<PathStep>& path);
/// nullptr if there is none of that name.
[[nodiscard]] const Parameter* FindParameter(const std::vector<Parameter>& parameters, std::string_view name);
/// The thing of that name, nullptr if there is none.
template <typename Thing>
[[nodiscard]] Thing* FindByName(const std::vector<Thing*>& things, std::string_view name) {
  const auto found = std::ranges::find(things, name, &Thing::name);
  return found == things.end() ? nullptr : *found;
}

/// Sixteen hexadecimal digits that change when what others see of the component changes: ports with their types,
/// services with parameters and exceptions. Comments, codels and defaults change nothing.
[[nodiscard]] std::string DigestOf(const Component& component);

/// The constant as a value of the type; nullopt if it is none, which has then been told.
[[nodiscard]] std::optional<Constant> Cast(const Constant& value, const Type* type, Place place, Problems& problems);

/// Whether the default fits the type, at all depths; tells what does not. Fills in the constants as the type has them, and
/// the member or index that each part stands for.
bool CheckInitializer(Initializer& initial, Type* type, Problems& problems);

}  // namespace runnel::genom
