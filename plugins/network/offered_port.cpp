#include "plugins/network/offered_port.h"

#include <algorithm>
#include <utility>

#include "core/base/exception_text.h"
#include "core/lockfree/thread_epoch.h"
#include "core/lockfree/wake_event.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

Duration ClockOffset::Now() const {
  if (is_simulated) return {};
  const auto since_1970 = std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch());
  return since_1970 - SteadyClock().Now().time_since_epoch();
}

/// Rung by publishers.
class OfferedPort::Bell final : public Waker {
 public:
  explicit Bell(std::shared_ptr<WakeEvent> wake) : wake_(std::move(wake)) {}
  void Wake() noexcept override {
    // release: who answers sees what has been published before.
    has_rung_.store(true, std::memory_order_release);
    wake_->Notify();
  }
  // relaxed: only who answers looks at what has been published.
  [[nodiscard]] bool has_rung() const noexcept { return has_rung_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool Answer() noexcept { return has_rung() && has_rung_.exchange(false, std::memory_order_acquire); }

 private:
  const std::shared_ptr<WakeEvent> wake_;
  std::atomic<bool> has_rung_{false};
};

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
      wake_(std::move(wake)),
      bell_(std::make_shared<Bell>(wake_)) {
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
  writer_.reset();
  input_.reset();
  // Publishers that have found it may still be about to ring it.
  Retire([bell = bell_] {});
}

WireEndpointOptions OfferedPort::endpoint() const {
  WireEndpointOptions endpoint{.topic = DdsTopic(topic_),
                               .type = form_->wire_type(),
                               .qos = QosOf(options_.quality),
                               .user_data = form_->user_data()};
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
  shown_.reset();
  if (source != nullptr) bell_->Wake();
}

void OfferedPort::Forget(const FrameworkElement& element) noexcept {
  const Port* const source = source_.load(std::memory_order_relaxed);
  if (source != nullptr && source->IsAtOrBelow(element)) source_.store(nullptr, std::memory_order_release);
}

std::uint64_t OfferedPort::dropped() const noexcept { return input_->dropped(); }

bool OfferedPort::has_value() const noexcept { return options_.rate <= 0 && bell_->has_rung(); }

std::optional<Time> OfferedPort::Send(Time now) {
  if (options_.rate > 0 && now < next_) {
    return next_;  // the bell keeps on ringing
  }
  if (!bell_->Answer() || writer_ == nullptr) return {};
  if (each_ != nullptr) {
    SendEach(now);
  } else {
    if (SendNewest() && options_.rate > 0) next_ = now + FromSeconds(1 / options_.rate);
  }
  return {};
}

void OfferedPort::Encode(const void* value, ValueTimes times, Octets& octets) const {
  form_->Write(value, times.timestamp + clock_.Now(), octets);
}

bool OfferedPort::SendNewest() {
  std::shared_ptr<Octets> octets;
  ValueTimes times;
  {
    const EpochGuard guard;  // what is loaded now stays so long
    const Port* const source = source_.load(std::memory_order_acquire);
    if (source == nullptr) return false;
    const std::uint64_t count = source->publications();
    if (count == shown_) return false;
    octets = pool_.Take();
    const bool is_there = source->VisitLatest([&](const void* value, ValueTimes of) {
      times = of;
      try {
        Encode(value, of, *octets);
      } catch (...) {
        error_ = Error{.message = "a value cannot be sent: " + DescribeException(), .path = path_};
        octets->clear();
      }
    });
    if (!is_there || octets->empty()) return false;
    shown_ = count;
  }
  Write(octets, times);
  return true;
}

void OfferedPort::SendEach(Time now) {
  std::shared_ptr<Octets> octets;
  ValueTimes times;
  const auto encode = [&](const void* value, ValueTimes of) {
    times = of;
    try {
      Encode(value, of, *octets);
    } catch (...) {
      error_ = Error{.message = "a value cannot be sent: " + DescribeException(), .path = path_};
      octets->clear();
    }
  };
  for (std::size_t i = 0; i < each_->capacity(); ++i) {
    octets = pool_.Take();
    if (!each_->Take(encode)) return;
    if (options_.rate > 0 && now < next_) continue;
    if (options_.rate > 0) next_ = now + FromSeconds(1 / options_.rate);
    if (!octets->empty()) Write(octets, times);
  }
  bell_->Wake();  // others have their turn first
}

void OfferedPort::Write(const std::shared_ptr<Octets>& octets, ValueTimes times) {
  const auto written = writer_->Write(octets, (times.timestamp + clock_.Now()).time_since_epoch().count());
  if (written) {
    sent_.fetch_add(1, std::memory_order_relaxed);
  } else {
    error_ = written.error();
    error_->path = path_;
  }
}

}  // namespace runnel
