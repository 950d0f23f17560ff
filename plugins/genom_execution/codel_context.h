#pragma once

#include <cstddef>
#include <string_view>

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

}  // namespace runnel::genom_execution
