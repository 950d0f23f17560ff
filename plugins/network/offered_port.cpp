#include "plugins/network/offered_port.h"

#include <algorithm>
#include <utility>

#include "core/base/exception_text.h"
#include "core/lockfree/thread_epoch.h"
#include "core/lockfree/wake_event.h"
#include "plugins/network_discovery/distant_type.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

Duration ClockOffset::Now() const {
  if (is_simulated) return {};
  const auto since_1970 = std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch());
  return since_1970 - SteadyClock().Now().time_since_epoch();
}

namespace {

// Of a value as octets: above, making and sending it takes longer than to wake a thread for it.
constexpr std::size_t kMostAfterCycle = 8192;
// Of one queue, after one cycle.
constexpr std::size_t kFew = 8;

}  // namespace

/// An input that only rings: whoever hears it looks at the newest value where it lies.
class OfferedPort::NewestInput final : public InputBase {
 public:
  NewestInput(FrameworkElement& group, const std::string& name, const TypeInfo& type)
      : InputBase({group, name}, type, {}) {}
  ~NewestInput() override {
    SetWaker(nullptr);
    DisconnectAll();
  }
  [[nodiscard]] std::uint64_t dropped() const noexcept override { return 0; }

 private:
  QueueSink* Bind(const std::vector<Source>&) override { return nullptr; }
  void TakeOverBinding(InputBase&) noexcept override {}
  void Bound() override {}
  [[nodiscard]] bool HasNew() const override { return false; }
};

OfferedPort::OfferedPort(FrameworkElement& beside, const std::string& name, const TypeInfo& type,
                         std::string path, OfferOptions options,
                         std::shared_ptr<const ValueForm> form, ClockOffset clock,
                         std::shared_ptr<WakeEvent> wake)
    : path_(std::move(path)),
      options_(std::move(options)),
      topic_(options_.topic),
      form_(std::move(form)),
      clock_(clock),
      bell_(std::make_shared<OfferBell>(std::move(wake), [this](OfferBell::By by) { SendBy(by); })) {
  if (options_.quality == ValueQuality::kEach) {
    auto each = std::make_unique<ProbePort>(beside, name, type);
    each_ = each.get();
    input_ = std::move(each);
  } else {
    input_ = std::make_unique<NewestInput>(beside, name, type);
  }
  input_->SetWaker(bell_.get());
}

OfferedPort::~OfferedPort() {
  bell_->Close();
  writer_.reset();
  input_.reset();
  // Publishers that have found it may still be about to ring it.
  Retire([bell = bell_] {});
}

WireEndpointOptions OfferedPort::endpoint() const {
  WireEndpointOptions endpoint{.topic = DdsTopic(topic_),
                               .type = form_->wire_type(),
                               .qos = QosOf(options_.quality),
                               .user_data = form_->user_data() + UnitText(options_.unit)};
  endpoint.qos.is_exclusive = options_.strength.has_value();
  endpoint.qos.strength = options_.strength.value_or(0);
  return endpoint;
}

Result<void> OfferedPort::Begin(WireParticipant& participant) {
  auto writer = participant.MakeWriter(endpoint(), [this](std::size_t count) {
    matched_.store(count, std::memory_order_relaxed);
    if (on_matched_) on_matched_();
  });
  if (!writer) return writer.error();
  writer_ = std::move(*writer);
  return {};
}

void OfferedPort::Attach(Port* port) {
  // What is latched is kept for those who may come.
  const bool is_wanted = matched() > 0 || options_.quality == ValueQuality::kLatched;
  const bool fits = port != nullptr && &port->type() == &input_->type();
  Port* const wanted = is_wanted && fits ? port : nullptr;
  Port* const before = input_->incoming().empty() ? nullptr : input_->incoming().front();
  if (before != wanted) {
    input_->DisconnectAll();
    // Refused only if it is about to go.
    if (wanted != nullptr && !Port::Connect(*wanted, *input_)) return source_.store(nullptr);
  }
  const auto sources = wanted != nullptr ? wanted->Sources() : std::vector<Port*>();
  const Port* const source = sources.empty() ? nullptr : sources.front();
  // release: pairs with the load in SendNewest().
  if (source_.exchange(source, std::memory_order_release) == source) return;
  // release: who sees it sees that source or a later one. Who does not see it yet may take a value of the new source for one
  // that has been sent; the bell is rung afterwards.
  attached_.fetch_add(1, std::memory_order_release);
  if (source != nullptr) bell_->Ring();
}

void OfferedPort::Forget(const FrameworkElement& element) noexcept {
  const Port* const source = source_.load(std::memory_order_relaxed);
  if (source != nullptr && source->IsAtOrBelow(element)) source_.store(nullptr, std::memory_order_release);
}

std::uint64_t OfferedPort::dropped() const noexcept { return input_->dropped(); }

bool OfferedPort::has_value() const noexcept { return options_.rate <= 0 && bell_->has_rung(); }

std::optional<Time> OfferedPort::Send(Time now) {
  if (options_.rate > 0 && now < next_) return next_;  // the bell keeps on ringing
  if (writer_ != nullptr && bell_->Answer()) bell_->SendByNetwork();
  return {};
}

void OfferedPort::SendBy(OfferBell::By by) {
  const std::uint64_t before = sent();
  try {
    if (each_ != nullptr) {
      SendEach(by == OfferBell::By::kCycle ? kFew : each_->capacity());
    } else if (SendNewest() && options_.rate > 0) {
      next_ = SteadyClock().Now() + FromSeconds(1 / options_.rate);
    }
  } catch (...) {
    Fail({.message = "a value cannot be sent: " + DescribeException()});
  }
  if (by == OfferBell::By::kCycle) sent_after_cycles_.fetch_add(sent() - before, std::memory_order_relaxed);
}

bool OfferedPort::Encode(const void* value, Time stamp, Octets& octets) {
  try {
    form_->Write(value, stamp, octets);
  } catch (...) {
    Fail({.message = "a value cannot be sent: " + DescribeException()});
    octets.clear();
  }
  return !octets.empty();
}

bool OfferedPort::SendNewest() {
  std::shared_ptr<Octets> octets;
  Time stamp;
  {
    const EpochGuard guard;  // what is loaded now stays so long
    // acquire: pairs with Attach().
    const std::uint64_t attached = attached_.load(std::memory_order_acquire);
    const Port* const source = source_.load(std::memory_order_acquire);
    if (source == nullptr) return false;
    const Shown newest{attached, source->publications()};
    if (newest == shown_) return false;
    octets = pool_.Take();
    bool is_whole = false;
    const bool is_there = source->VisitLatest([&](const void* value, ValueTimes of) {
      stamp = of.timestamp + clock_.Now();
      is_whole = Encode(value, stamp, *octets);
    });
    if (!is_there || !is_whole) return false;
    shown_ = newest;
  }
  Write(octets, stamp);
  return true;
}

void OfferedPort::SendEach(std::size_t most) {
  std::shared_ptr<Octets> octets;
  Time stamp;
  bool is_whole = false;
  const Time now = options_.rate > 0 ? SteadyClock().Now() : Time{};
  for (std::size_t i = 0; i < most; ++i) {
    octets = pool_.Take();
    const bool is_there = each_->Take([&](const void* value, ValueTimes of) {
      stamp = of.timestamp + clock_.Now();
      is_whole = Encode(value, stamp, *octets);
    });
    if (!is_there) return;
    if (options_.rate > 0 && now < next_) continue;
    if (options_.rate > 0) next_ = now + FromSeconds(1 / options_.rate);
    if (is_whole) Write(octets, stamp);
  }
  bell_->Ring();  // others have their turn first
}

void OfferedPort::Write(const std::shared_ptr<Octets>& octets, Time stamp) {
  is_large_ = is_large_ || octets->size() > kMostAfterCycle;
  bell_->set_sent_after_cycles(options_.sending == ValueSending::kAfterCycle && options_.rate <= 0 && !is_large_);
  const auto written = writer_->Write(octets, stamp.time_since_epoch().count());
  if (!written) return Fail(written.error());
  sent_.fetch_add(1, std::memory_order_relaxed);
}

void OfferedPort::Fail(Error error) {
  error.path = path_;
  const std::lock_guard lock(mutex_);
  error_ = std::move(error);
}

bool OfferedPort::has_error() const {
  const std::lock_guard lock(mutex_);
  return error_.has_value();
}

std::optional<Error> OfferedPort::TakeError() {
  const std::lock_guard lock(mutex_);
  return std::exchange(error_, {});
}

}  // namespace runnel
