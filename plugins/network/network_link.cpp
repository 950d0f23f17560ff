#include "plugins/network/network_link.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>

#include "core/base/error.h"
#include "core/element/element_path.h"
#include "core/element/file_notes.h"
#include "plugins/network/network_ports.h"
#include "plugins/network_discovery/distant_type.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/wire/reach_filter.h"

namespace runnel {

namespace {

// So long something may go unnoticed of which nobody tells.
constexpr auto kLookAround = std::chrono::seconds(1);
constexpr auto kAfterFailure = std::chrono::milliseconds(100);

// So often it is looked whether a call has ended, while one is under way.
constexpr auto kLookAtCalls = std::chrono::milliseconds(1);
// … whether its time is over.
constexpr auto kLookAtTime = std::chrono::milliseconds(10);

/// Beside the tree: no part of the application, so that nobody finds or saves it.
class BesideElement final : public FrameworkElement {
 public:
  explicit BesideElement(FrameworkElement& root) : FrameworkElement(Placement{root, "network", false}) {
    Annotate(std::make_unique<NotSaved>());
  }
};

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
    offered.push_back(
        std::make_unique<OfferedService>(runtime, offers[i], messages, dialect_, ++made_, wake_, &table_,
                                         [&options, i]() -> const std::string& { return options.services[i].port; }));
  }
  for (std::size_t i = taken_.size(); i < takes.size(); ++i) {
    const auto& take = takes[i];
    taken.push_back(
        std::make_unique<TakenService>(runtime, take.path, take.options, take.service, dialect_, ++made_, wake_));
  }
  const std::lock_guard lock(runtime.structure_mutex());
  std::ranges::move(offered, std::back_inserter(offered_));
  std::ranges::move(taken, std::back_inserter(taken_));
}

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

NetworkLink::NetworkLink(FrameworkElement& application, NetworkElement& element, ClockOffset clock)
    : application_(application),
      runtime_(application.runtime()),
      element_(element),
      clock_(std::move(clock)),
      table_([this] { LookAgain(); }) {}

Result<std::unique_ptr<NetworkLink>> NetworkLink::Start(FrameworkElement& application, NetworkElement& element,
                                                        WireEngine& engine, bool is_simulated,
                                                        std::function<std::string()> structure, RosHooks hooks) {
  std::unique_ptr<NetworkLink> link(new NetworkLink(application, element, {is_simulated, hooks.clock_lead}));
  WireMemberOptions member = element.options().member;
  member.user_data = "enclave=/;";  // without which nodes of ROS 2 look past it
  member.user_data += kIsApplication;
  if (is_simulated) member.user_data += kSimulatedTime;
  if (!element.options().commands.empty()) {
    member.user_data += kAllowedCommands;
    for (const std::string& each : element.options().commands) member.user_data += each + ",";
    member.user_data.back() = ';';
  }
  auto joined = engine.Join(member, link->table_);
  if (!joined) return joined.error().WithPosition(element.options().position);
  link->participant_ = std::move(*joined);
  if (member.reach == WireReach::kNetwork && !IsInNetwork()) {
    element.log().Warn(
        "this machine is in no network, so nobody else is reached, nor when it comes into one later: start the "
        "application again then");
  }
  link->structure_topic_ =
      StructureTopic::Start(*link->participant_, member.name, [raw = link.get()] { raw->LookAgain(); });
  link->structure_ = std::move(structure);
  hooks.dialect = engine.has_identities() ? ServiceDialect::kBeside : ServiceDialect::kInFront;
  hooks.table = &link->table_;
  link->services_.set_dialect(hooks.dialect);
  if (element.options().ros) {
    link->node_ = RosNode::Start(*element.options().ros, *link->participant_, application, is_simulated, element.log(),
                                 std::move(hooks), [wake = link->wake_] { wake->Notify(); });
  }
  {
    const ChangeScope changes(link->runtime_);
    link->beside_ = std::make_unique<BesideElement>(link->runtime_.root());
    link->runtime_.AddListener(*link);
    element.set_on_change([raw = link.get()] { raw->LookAgain(); });
    element.set_on_renamed([raw = link.get()](const std::string& from) { raw->NoteRenamed(from); });
    if (NetworkPorts* const ports = NetworkPorts::Of(element)) {
      ports->set_find_type([raw = link.get()](const std::string& path, const TypeInfo* expected) {
        return FindDistantType(raw->table_, path, expected, raw->element_.know_types());
      });
    }
  }
  link->Follow();  // so that all is offered when the first cycle runs
  link->thread_ = std::thread([raw = link.get()] { raw->Run(); });
  return link;
}

NetworkLink::~NetworkLink() {
  if (beside_ != nullptr) {
    const std::lock_guard lock(runtime_.structure_mutex());
    element_.set_on_change({});
    element_.set_on_renamed({});
    if (NetworkPorts* const ports = NetworkPorts::Of(element_)) ports->set_find_type({});
    runtime_.RemoveListener(*this);
  }
  ends_ = true;
  wake_->Notify();
  if (thread_.joinable()) thread_.join();
  taken_.clear();
  offered_.clear();
  services_.End();
  node_.reset();
  nodes_.reset();
  structure_topic_.reset();
  participant_.reset();
}

void NetworkLink::LookAgain() noexcept {
  // release: what has changed is seen by who answers.
  must_look_.store(true, std::memory_order_release);
  wake_->Notify();
}

void NetworkLink::NoteRenamed(const std::string& from) noexcept {
  for (const auto& each : offered_) {
    if (IsAtOrBelow(each->path(), from)) each->set_renamed(true);
  }
  LookAgain();
}

void NetworkLink::OnConnected(FrameworkElement&, FrameworkElement& to) {
  if (!to.IsAtOrBelow(*beside_)) LookAgain();
}
void NetworkLink::OnDisconnected(FrameworkElement&, FrameworkElement& to) {
  if (!to.IsAtOrBelow(*beside_)) LookAgain();
}
void NetworkLink::OnDeleted(FrameworkElement& element) {
  for (const auto& each : offered_) each->Forget(element);
  services_.Forget(element);
  LookAgain();
}

// What fails is tried again after a pause, as it may fail each time, as without memory; what can be sent is sent meanwhile.
void NetworkLink::Run() noexcept {
  const auto attempt = [this](void (NetworkLink::*work)()) {
    try {
      (this->*work)();
      return true;
    } catch (...) {
      element_.log().Error("the network: {}", DescribeException());
      must_look_ = true;  // without a notification, which would end the next wait
      follows_from_ = SteadyClock().Now() + kAfterFailure;
      return false;
    }
  };
  while (!ends_) {
    const bool follows = SteadyClock().Now() >= follows_from_;
    if (follows && must_look_.exchange(false, std::memory_order_acquire)) attempt(&NetworkLink::Follow);
    if (!attempt(&NetworkLink::SendAll)) wake_->WaitUntil(follows_from_);
  }
}

void NetworkLink::SendAll() {
  const Time now = SteadyClock().Now();
  Time deadline = now + kLookAround;
  for (const auto& each : offered_) {
    if (const auto again = each->Send(now)) deadline = std::min(deadline, *again);
  }
  const auto clock = node_ != nullptr ? node_->Work(now) : std::nullopt;
  if (clock) deadline = std::min(deadline, *clock);
  if (const auto calls = services_.Work(now)) deadline = std::min(deadline, *calls);
  if (now >= next_look_) {
    next_look_ = now + kLookAround;
    TellOwners();
    TellClocks();
    const auto has_error = [](const auto& each) { return each->has_error(); };
    const auto has_news = [](const auto& each) { return each->has_news(); };
    if (!strangers_.empty() || is_missing_young_ || std::ranges::any_of(taken_, has_news) ||
        std::ranges::any_of(offered_, has_error)) {
      return LookAgain();
    }
  }
  if (must_look_) deadline = std::min(deadline, follows_from_);
  if (!ends_) wake_->WaitUntil(deadline);
}

}  // namespace runnel
