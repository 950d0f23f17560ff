#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "core/port/output.h"
#include "plugins/services/service_endpoint.h"

namespace runnel {

/// What does not depend on the types. Its address is that of the record.
struct CallRecordBase {
  std::uint64_t number = 0;  ///< of the client's calls; 0: from outside of the application
  CallStatus status = CallStatus::kPending;
  Time begun{};         ///< of the cycle that began to serve it
  Time asked_to_end{};  ///< of the cycle in which an activity was told to come to its end; 0: in none
};

/// What was asked and what has come of it, as services publish it. Its timestamp is when it was called.
template <typename Signature>
struct CallRecord;
template <typename Reply, typename... Arguments>
struct CallRecord<Reply(Arguments...)> : CallRecordBase {
  ArgumentPack<Arguments...> arguments;
  typename internal::ReplyOf<Reply>::Type reply{};
  std::string error;
};

namespace internal {
template <std::size_t... index, typename... T>
void Describe(TypeBuilder<IndexedArguments<std::index_sequence<index...>, T...>>& type) {
  type.Name("arguments " + SignatureName(std::type_identity<void(T...)>()));
  (type.Field("argument" + std::to_string(index + 1), &ArgumentOf<index, T>::value), ...);
}

template <typename Reply, typename... Arguments>
void PublishRecord(Output<CallRecord<Reply(Arguments...)>>& records, const Call<Reply(Arguments...)>& call,
                   CallStatus status) {
  if (!records.is_watched()) return;
  auto record = records.Loan();
  if (!record) return;
  record->number = call.number;
  record->status = status;
  record->begun = call.begun_at;
  record->asked_to_end = call.asked_to_end_at;
  record->arguments = call.arguments;
  if constexpr (!std::is_void_v<Reply>) record->reply = call.reply;
  record->error = call.error;
  records.Publish(std::move(record), call.called_at);
}
}  // namespace internal

template <typename Reply, typename... Arguments>
void Describe(TypeBuilder<CallRecord<Reply(Arguments...)>>& type) {
  using Record = CallRecord<Reply(Arguments...)>;
  type.Name("call " + SignatureName(std::type_identity<Reply(Arguments...)>()));
  type.Field("number", &Record::number).Field("status", &Record::status);
  type.Field("begun", &Record::begun).Field("asked_to_end", &Record::asked_to_end);
  if constexpr (sizeof...(Arguments) > 0) type.Field("arguments", &Record::arguments);
  if constexpr (!std::is_void_v<Reply>) type.Field("reply", &Record::reply);
  type.Field("error", &Record::error);
}

}  // namespace runnel
