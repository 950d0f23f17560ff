#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/clock.h"

namespace runnel::genom_execution {

class Request;

/// What a codel returns: the address of a name, nullptr for "done". Two events are the same if their addresses are.
using Event = const char*;

/// What a codel gets as its last argument: laid out as `struct genom_context_iface` of the headers in C.
struct CodelContext {
  void* data;  ///< the glue's: EngineOptions::glue
  /// Keeps a copy of the detail, and returns the exception.
  Event (*raise)(Event exception, const void* detail, std::size_t size, const CodelContext* self);
  /// The exception that a remote's call has raised last, and its detail.
  const void* (*raised)(Event* exception, const CodelContext* self);
  Request* request =
      nullptr;  ///< of whose activity the codel is; nullptr: of a permanent one. Codels in C do not see it
};

/// What the engine itself raises. Their details are words: see Outcome.
inline constexpr char kBadTransition[] = "::genom::bad_transition";  ///< from, to
inline constexpr char kInterrupted[] = "::genom::interrupted";       ///< by
inline constexpr char kTooManyActivities[] = "::genom::too_many_activities";
inline constexpr char kDisallowed[] = "::genom::disallowed";
inline constexpr char kNoSuchActivity[] = "::genom::no_such_activity";
inline constexpr char kUnknownException[] = "::genom::unkex";  ///< what
inline constexpr char kMiddlewareError[] = "::genom::mwerr";   ///< what

/// An mwerr, for a codel to return.
inline Event RaiseMiddlewareError(const CodelContext& context, std::string_view what) {
  char detail[128] = {};
  (void)what.copy(detail, sizeof(detail) - 1);
  return context.raise(kMiddlewareError, detail, sizeof(detail), &context);
}

/// What a codel is called with.
struct Invocation {
  void* ids;   ///< of the component
  void* data;  ///< parameters and locals of the service; nullptr for permanent activities
  const CodelContext* context;
};

/// A function of the user, and how it gets its arguments.
struct CodelTable {
  const char* name;
  Event (*call)(const Invocation&);
  bool is_async = false;      ///< may take long: never called in a cycle
  bool calls_others = false;  ///< has remotes: may wait for other components
};

inline constexpr std::uint16_t kEther = 0xffff;
inline constexpr std::uint16_t kNowhere = 0xfffe;

/// Where an event leads.
struct Transition {
  Event event;
  std::uint16_t state;  ///< of the same machine, or kEther
  bool pauses = false;
};

struct StateTable {
  const char* name;
  std::uint16_t codel;
  std::span<const Transition> transitions;
};

struct MachineTable {
  std::span<const StateTable> states = {};
  std::uint16_t start = kNowhere;
  std::uint16_t stop = kNowhere;
};

struct TaskTable {
  const char* name;
  Duration period{};  ///< 0: not periodic
  Duration delay{};
  int priority = 0;
  bool is_real_time = false;
  std::size_t stack = 0;  ///< bytes, 0: the system's choice
  MachineTable machine = {};
  std::span<const Event> throws = {};
};

enum class ServiceKind : std::uint8_t { kAttribute, kFunction, kActivity, kAbort, kKill };

struct ServiceTable {
  const char* name;
  ServiceKind kind;
  std::uint16_t number = 0;                       ///< in ComponentTable::services
  std::uint16_t task = 0;                         ///< of an activity
  std::span<const std::uint16_t> validates = {};  ///< codels
  std::span<const std::uint16_t> codels = {};     ///< simple ones
  MachineTable machine = {};
  std::span<const Event> throws = {};
  std::span<const std::uint16_t> interrupts = {};  ///< services
  std::span<const std::uint16_t> before = {};
  std::span<const std::uint16_t> after = {};
  /// Parameters and locals of one request; may be nullptr if there are none. Outside of cycles.
  void* (*make)() = nullptr;
  void (*destroy)(void* data) = nullptr;
  /// Before anything else is done with the request: outputs and locals as in the beginning.
  void (*begin)(void* data) = nullptr;
  /// Of an attribute: inputs to the ids, outputs from them.
  void (*assign)(void* ids, void* data) = nullptr;
};

struct ExceptionTable {
  Event exception;
  const char* name;                                          ///< "nav::bad_speed"
  std::string (*detail_text)(const void* detail) = nullptr;  ///< nullptr: has none
};

/// Two that must not run at the same time: codels by their numbers, attributes by ComponentTable::AttributeUnit().
using Conflict = std::pair<std::uint16_t, std::uint16_t>;

/// All that the engine knows of a component: made by a template, the same for all instances, never changed.
struct ComponentTable {
  const char* name;
  const char* version = "";
  const char* digest = "";
  std::span<const CodelTable> codels = {};
  std::span<const TaskTable> tasks = {};
  std::span<const ServiceTable> services = {};
  std::span<const Conflict> conflicts = {};
  std::span<const ExceptionTable> exceptions = {};
  std::size_t largest_detail = 0;  ///< of its exceptions, in bytes

  [[nodiscard]] std::size_t AttributeUnit(std::size_t service) const { return codels.size() + service; }
  [[nodiscard]] std::size_t units() const { return codels.size() + services.size(); }
};

}  // namespace runnel::genom_execution
