#include "core/port/input_base.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <span>

#include "core/base/retry.h"
#include "core/channel/channel_base.h"
#include "core/element/runtime.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/port_options.h"
#include "core/port/port_stop.h"

namespace runnel {

namespace {

bool HasValue(const Port& port) {
  return port.VisitLatest([](const void*, Time) {});
}

// As a publisher does: what the waker refers to lives as long as the guard.
void Wake(Waker& waker) noexcept {
  const EpochGuard guard;
  waker.Wake();
}

}  // namespace

InputBase::InputBase(const Placement& placement, const TypeInfo& type, InputOptions options)
    : Port(placement, Direction::kInput, type, options.description),
      options_(std::move(options)),
      arrival_(options_.waits ? std::make_unique<ArrivalEvent>() : nullptr),
      strategy_(options_.strategy) {}

InputBase::~InputBase() {
  // A publisher may still be telling it, by a list of subscribers from before.
  if (arrival_) Retire([arrival = arrival_.release()] { delete arrival; });
}

void InputBase::SetWaker(Waker* waker) {
  const std::lock_guard lock(runtime().structure_mutex());
  if (waker_ == waker) return;
  Waker* const before = std::exchange(waker_, waker);
  if (waker_ == nullptr) {  // who takes it away is about to go, and must not be woken any more
    Retry([this] { UpdateChannels(); });
    return;
  }
  try {
    UpdateChannels();
  } catch (...) {
    waker_ = before;  // so that the same call does the rest
    throw;
  }
  if (waker_ != nullptr && HasValue(*this)) Wake(*waker_);
}

void InputBase::DeclareDriving() {
  const InputOptions& declared = options_;
  const bool is_velocity =
      declared.command == DrivingKind::kVelocity || DrivingKindByUnits(type(), unit()) == DrivingKind::kVelocity;
  const bool has_own = declared.safe_value || is_velocity;  // whose default may well move
  const auto safe = FindSafeValue(has_own ? declared.safe_value : declared.limits.default_value, declared.command);
  if (!safe) throw ElementError(safe.error());
  const auto command = FindDrivingKind(declared.command, *safe);
  if (!command) throw ElementError(command.error());
  if (auto set = SetStop(*safe, declared.brake, *command, runtime().robot_stop().signal()); !set) {
    throw ElementError(set.error());
  }
  declared_stop_ = stop();
}

Result<void> InputBase::Prepare() {
  InputLimits limits = options_.limits;
  if (const auto* const given = FindAnnotation<GivenLimits>()) {
    const InputLimits& from = given->limits;
    if (from.default_value) limits.default_value = from.default_value;
    if (from.minimum) limits.minimum = from.minimum;
    if (from.maximum) limits.maximum = from.maximum;
    if (from.out_of_bounds != OutOfBounds::kDiscard) limits.out_of_bounds = from.out_of_bounds;
  }
  return limits.has_some() ? SetLimits(std::move(limits)) : Result<void>();
}

void InputBase::SetStrategy(Strategy strategy) {
  const std::lock_guard lock(runtime().structure_mutex());
  const Strategy before = this->strategy();
  if (before == strategy) return;
  strategy_.store(strategy, std::memory_order_relaxed);
  try {
    Rebind(std::vector<Source>(sources_));
  } catch (...) {
    strategy_.store(before, std::memory_order_relaxed);
    Retry([this] { Rebind(std::vector<Source>(sources_)); });
    throw;
  }
}

bool InputBase::Wait(Duration timeout) {
  RUNNEL_CHECK(CurrentCycle() == nullptr && !EpochGuard::HeldByThisThread(),
               "an input cannot wait in a cycle, as in Update()");
  if (HasNew()) return true;
  if (timeout <= Duration::zero()) return false;
  using Deadline = KernelFutex::Deadline;
  const Deadline now = std::chrono::steady_clock::now();
  const Deadline deadline = timeout < Deadline::max() - now ? now + timeout : Deadline::max();
  return PrepareToWait().Wait(deadline, [this] { return HasNew(); });
}

// The list of subscribers is swapped before the reader looks again, so that a publisher whose value
// it does not find then knows of the event.
ArrivalEvent& InputBase::PrepareToWait() {
  if (arrival_) return *arrival_;
  const std::lock_guard lock(runtime().structure_mutex());
  arrival_ = std::make_unique<ArrivalEvent>();
  try {
    UpdateChannels();
  } catch (...) {  // some publishers may know it
    const ArrivalEvent* const unused = arrival_.release();
    Retry([this] { UpdateChannels(); });
    Retire([unused] { delete unused; });
    throw;
  }
  return *arrival_;
}

void InputBase::Rebind(const std::vector<Source>& sources) {
  std::vector<Source> concerned = sources_;
  const std::size_t known = concerned.size();
  for (const Source& source : sources) {
    if (std::ranges::find(concerned, source.output, &Source::output) == concerned.end()) concerned.push_back(source);
  }
  const bool was_visited = IsVisited();
  sources_ = sources;
  try {
    sink_ = Bind(sources);
    // Whom publishers need not know, they are not told of: an output may have thousands of these.
    if (was_visited || IsVisited()) {
      for (const Source& each : concerned) UpdateChannel(*each.output);
      UpdateStops();
    }
  } catch (...) {
    // Some have been told, and some have not: who calls next, with these sources or those from before, tells all.
    sources_ = std::move(concerned);
    throw;
  }
  Bound();
  // What a new connection brings is there already, and no publisher tells of it.
  if (arrival_) arrival_->Wake();
  const auto added = std::span(concerned).subspan(known);
  const auto brings_data = [](const Source& each) { return HasValue(*each.output); };
  if (waker_ != nullptr && std::ranges::any_of(added, brings_data)) Wake(*waker_);
}

void InputBase::ReplaceSource(const Port& from, Port& to) noexcept {
  for (Source& source : sources_) {
    if (source.output == &from) source.output = &to;
  }
}

// Taking over has been checked to be among inputs.
void InputBase::ExchangeFlow(Port& from) noexcept {
  auto& other = static_cast<InputBase&>(from);
  sources_.swap(other.sources_);
  std::swap(sink_, other.sink_);
  TakeOverBinding(other);
}

void InputBase::FollowExchange(Port& from) {
  auto& other = static_cast<InputBase&>(from);
  const auto is_told = [](const InputBase& input) { return input.waker_ || input.arrival_; };
  // A binding that pulls is another one. Else publishers find the same queue, and need to be told only
  // if somebody else is to be woken.
  // So is one of an input that ages in another way.
  if (strategy() != other.strategy() || ageing() != other.ageing()) {
    Rebind(std::vector<Source>(sources_));
  } else if (is_told(*this) || is_told(other)) {
    UpdateChannels();
    other.UpdateStops();
  }
  if (arrival_) arrival_->Wake();
  if (waker_ != nullptr && HasValue(*this)) Wake(*waker_);
}

// Whether publishers have to do anything for this input.
bool InputBase::IsVisited() const noexcept {
  return sink_ != nullptr || waker_ != nullptr || arrival_ != nullptr || sources_.size() > 1;
}

void InputBase::UpdateChannels() {
  for (const Source& source : sources_) UpdateChannel(*source.output);
  UpdateStops();
}

void InputBase::UpdateStops() {
  Subscribers subscribers;
  if (waker_ != nullptr) subscribers.wakers.push_back(waker_);
  if (arrival_) subscribers.wakers.push_back(arrival_.get());
  TellStops(subscribers);
}

// Works out anew whom publishers into the output's channel have to visit, and what they have to
// reserve and number for them.
void InputBase::UpdateChannel(Port& output) {
  ChannelBase& channel = *ChannelOf(output);
  Subscribers subscribers;
  std::size_t waiting = 0;
  bool shares_an_input = false;
  for (Port* port : output.BoundSinks()) {
    // A sink is an input that is no interface port, and all of those derive from InputBase.
    auto& input = static_cast<InputBase&>(*port);
    if (input.sink_ != nullptr) {
      if (ProbeQueue* const probe = input.sink_->probe()) {
        subscribers.probes.push_back(probe);
      } else {
        subscribers.queues.push_back(input.sink_);
      }
      waiting += input.sink_->capacity();
    }
    if (input.waker_ != nullptr) subscribers.wakers.push_back(input.waker_);
    if (input.arrival_) subscribers.wakers.push_back(input.arrival_.get());
    shares_an_input = shares_an_input || input.sources_.size() > 1;
  }
  channel.ReserveFor(waiting);
  if (shares_an_input) channel.SetOrdered();
  channel.SetSubscribers(std::move(subscribers));
}

}  // namespace runnel
