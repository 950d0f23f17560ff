#pragma once

#include <cstdint>
#include <string>

#include "plugins/services/service_endpoint.h"

namespace runnel {

/// What was asked and what has come of it, as services publish it. Its timestamp is when it was called.
template <typename Signature>
struct CallRecord;
template <typename Reply, typename... Arguments>
struct CallRecord<Reply(Arguments...)> {
  std::uint64_t number = 0;  ///< of the caller's calls
  CallStatus status = CallStatus::kPending;
  ArgumentPack<Arguments...> arguments;
  typename internal::ReplyOf<Reply>::Type reply{};
  std::string error;
};

namespace internal {
template <std::size_t... index, typename... T>
void Describe(TypeBuilder<IndexedArguments<std::index_sequence<index...>, T...>>& type) {
  type.Name("arguments " + SignatureName(std::type_identity<void(T...)>()));
  (type.Field("argument" + std::to_string(index + 1),
              &ArgumentOf<index, T>::value),
   ...);
}
}  // namespace internal

template <typename Reply, typename... Arguments>
void Describe(TypeBuilder<CallRecord<Reply(Arguments...)>>& type) {
  using Record = CallRecord<Reply(Arguments...)>;
  type.Name("call " + SignatureName(std::type_identity<Reply(Arguments...)>()));
  type.Field("number", &Record::number).Field("status", &Record::status);
  if constexpr (sizeof...(Arguments) > 0) type.Field("arguments", &Record::arguments);
  if constexpr (!std::is_void_v<Reply>) type.Field("reply", &Record::reply);
  type.Field("error", &Record::error);
}

}  // namespace runnel
