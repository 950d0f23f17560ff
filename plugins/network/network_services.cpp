#include "plugins/network/network_services.h"

#include <algorithm>
#include <chrono>
#include <mutex>

#include "core/element/runtime.h"
#include "plugins/network_discovery/discovery_table.h"
#include "plugins/ros_messages/message_library.h"

namespace runnel {

namespace {

// So often it is looked whether a call has ended, while one is under way.
constexpr auto kLookAtCalls = std::chrono::milliseconds(1);
// … whether its time is over.
constexpr auto kLookAtTime = std::chrono::milliseconds(10);

}  // namespace

void NetworkServices::AddNew() {
  Runtime& runtime = element_.runtime();
  const NetworkOptions& options = element_.options();
  const MessageLibrary& messages = options.messages != nullptr ? *options.messages : MessageLibrary::Standard();
  std::vector<ServiceOfferOptions> offers;
  std::vector<NetworkElement::ServiceTake> takes;
  {
    const std::lock_guard lock(runtime.structure_mutex());
    offers = options.services;
    takes = element_.service_takes();
  }
  std::vector<std::unique_ptr<OfferedService>> offered;
  std::vector<std::unique_ptr<TakenService>> taken;
  for (std::size_t i = offered_.size(); i < offers.size(); ++i) {
    offered.push_back(std::make_unique<OfferedService>(runtime, offers[i], messages, dialect_, ++made_, wake_));
  }
  for (std::size_t i = taken_.size(); i < takes.size(); ++i) {
    const auto& take = takes[i];
    taken.push_back(std::make_unique<TakenService>(runtime, take.path, take.options, take.service, dialect_, ++made_, wake_));
  }
  const std::lock_guard lock(runtime.structure_mutex());
  std::ranges::move(offered, std::back_inserter(offered_));
  std::ranges::move(taken, std::back_inserter(taken_));
}

bool NetworkServices::IsThere(std::uint64_t writer) const { return table_.FindWriter(writer).has_value(); }

void NetworkServices::Forget(const FrameworkElement& element) noexcept {
  for (const auto& each : offered_) each->Forget(element);
}

void NetworkServices::End() noexcept {
  offered_.clear();
  taken_.clear();
}

std::optional<Time> NetworkServices::Work(Time now) {
  std::optional<Time> again;
  const auto look_at = [&](Time time) { again = std::min(again.value_or(time), time); };
  for (const auto& each : taken_) {
    if (each->Work()) look_at(now + kLookAtTime);
  }
  for (const auto& each : offered_) {
    if (each->Work()) look_at(now + kLookAtCalls);
  }
  return again;
}

void NetworkServices::AddIds(std::vector<WireId>& readers, std::vector<WireId>& writers) const {
  const auto add = [&](const ServiceEndpoints* endpoints) {
    if (endpoints == nullptr) return;
    readers.push_back(endpoints->reader_id());
    writers.push_back(endpoints->writer_id());
  };
  for (const auto& each : offered_) add(each->endpoints());
  for (const auto& each : taken_) add(each->endpoints());
}

std::string NetworkServices::Text() const {
  std::string text;
  for (const auto& each : offered_) text += each->Text();
  for (const auto& each : taken_) text += each->Text();
  return text;
}

}  // namespace runnel
