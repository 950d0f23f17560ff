#pragma once

#include <cstring>
#include <type_traits>

#include "plugins/genom_execution/component_table.h"

// What tables of components whose codels are in C++ are made with.
namespace runnel::genom_execution {

/// As in the beginning; lists and texts keep their memory.
template <typename Value>
void ClearValue(Value& value) {
  if constexpr (std::is_array_v<Value>) {
    for (auto& each : value) ClearValue(each);
  } else if constexpr (requires { value.clear(); }) {
    value.clear();
  } else if constexpr (std::is_trivially_copyable_v<Value>) {
    std::memset(static_cast<void*>(&value), 0, sizeof(value));
  } else {
    value = Value();
  }
}

template <typename Value>
void AssignValue(Value& to, const Value& from) {
  if constexpr (std::is_array_v<Value>) {
    for (std::size_t i = 0; i < std::extent_v<Value>; ++i) AssignValue(to[i], from[i]);
  } else {
    to = from;
  }
}

/// An exception that a codel has thrown.
template <typename Detail>
Event Raised(const Invocation& call, Event exception, const Detail* detail) {
  static_assert(std::is_trivially_copyable_v<Detail>, "a detail that outlives its exception owns nothing");
  return call.context->raise(exception, detail, sizeof(*detail), call.context);
}

/// The detail of an exception that has been raised.
template <typename Detail>
void TakeDetail(const CodelContext& context, Event exception, Detail* detail) {
  Event last = nullptr;
  const void* const raised = context.raised(&last, &context);
  if (raised != nullptr && last == exception) std::memcpy(detail, raised, sizeof(*detail));
}

}  // namespace runnel::genom_execution
