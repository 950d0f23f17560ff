#include "plugins/network/offered_port.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/driving_ports.h"
#include "plugins/network_discovery/distant_type.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

namespace {

// Of a value as octets: above, making and sending it takes longer than to wake a thread for it.
constexpr std::size_t kMostAfterCycle = 8192;
// Of one queue, after one cycle.
constexpr std::size_t kFew = 8;
// The safe value, while it is stopped, for those who come, or have missed it; and what could not be sent.
constexpr auto kAgain = std::chrono::milliseconds(100);

}  // namespace

/// Where the values are that readers of the port find. It stays as it is, but for a source that goes.
struct OfferedPort::Binding {
  std::atomic<const Port*> source;          // that readers are bound to; nullptr: none
  std::vector<internal::PassedStop> stops;  // on the way to them
  std::uint64_t number;

  [[nodiscard]] bool LetsPass(ValueTimes times) const noexcept {
    return std::ranges::all_of(stops, [&](const auto& each) { return each.stop->LetsPass(times); });
  }
  [[nodiscard]] bool IsOf(const Port* other, const std::vector<internal::PassedStop>& others) const noexcept {
    constexpr auto kStop = &internal::PassedStop::stop;
    return source.load(std::memory_order_relaxed) == other && std::ranges::equal(stops, others, {}, kStop, kStop);
  }
};

/// An input that only rings: whoever hears it looks at the newest value where it lies, which is where readers find it: what
/// is set by hand, or converted, too.
class OfferedPort::Reader final : public InputBase {
 public:
  Reader(FrameworkElement& group, const std::string& name, const TypeInfo& type, OfferedPort& offered)
      : InputBase({group, name}, type, {}), offered_(offered) {}
  ~Reader() override {
    SetWaker(nullptr);
    DisconnectAll();
  }
  [[nodiscard]] std::uint64_t dropped() const noexcept override { return 0; }
  /// Of one port that takes the place of another it is not told.
  void LookAgain() { (void)Bind(sources()); }

 private:
  QueueSink* Bind(const std::vector<Source>& from) override {
    offered_.SetBinding(from.empty() ? nullptr : from.front().output, internal::PassedStops(*this));
    return nullptr;
  }
  void TakeOverBinding(InputBase&) noexcept override {}
  void Bound() override {}
  [[nodiscard]] bool HasNew() const override { return false; }

  OfferedPort& offered_;
};

OfferedPort::OfferedPort(FrameworkElement& beside, const std::string& name, const TypeInfo& type, std::string path,
                         OfferOptions options, std::shared_ptr<const ValueForm> form, ClockOffset clock,
                         std::shared_ptr<WakeEvent> wake)
    : path_(std::move(path)),
      options_(std::move(options)),
      topic_(options_.topic),
      form_(std::move(form)),
      clock_(std::move(clock)),
      bell_(std::make_shared<OfferBell>(std::move(wake), [this](OfferBell::By by) { SendBy(by); })) {
  reader_ = std::make_unique<Reader>(beside, name, type, *this);
  if (options_.quality == ValueQuality::kEach && options_.rate <= 0) {  // of a bounded rate the newest wins
    each_ = std::make_unique<ProbePort>(beside, name + "_each", type);
    each_->SetWaker(bell_.get());
  } else {
    reader_->SetWaker(bell_.get());
  }
}

OfferedPort::~OfferedPort() {
  bell_->Close();
  writer_.reset();
  each_.reset();
  reader_.reset();
  stop_subscriptions_.clear();
  Retire([binding = binding_.load(std::memory_order_relaxed)] { delete binding; });
  // Publishers that have found it may still be about to ring it.
  Retire([bell = bell_] {});
}

WireEndpointOptions OfferedPort::endpoint() const {
  WireEndpointOptions endpoint{.topic = DdsTopic(topic_),
                               .type = form_->codec->dds_type(),
                               .qos = QosOf(options_.quality),
                               .user_data = form_->user_data + UnitText(options_.as.empty() ? options_.unit : "")};
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
  // A command of motion stops whoever moves by it elsewhere, whether or not anybody has marked it here.
  // Of a list nobody knows here how long it has to be: who marks it says so.
  if (options_.is_measured || !IsVelocity(type(), options_.unit) || HasLists(type())) return {};
  const std::shared_ptr<const void> zero = type().Make();
  if (auto set = reader_->SetDriving(true, zero ? AnyValue(type(), zero) : AnyValue(), {}, DrivingKind::kVelocity);
      !set)
    return set;
  AddWhatDrives(reader_->runtime(), topic_ + " (in the network)", reader_->stop());
  return {};
}

void OfferedPort::Attach(Port* port) {
  // What is latched is kept for those who may come.
  const bool is_wanted = matched() > 0 || options_.quality == ValueQuality::kLatched;
  const bool fits = port != nullptr && &port->type() == &type();
  Port* const wanted = is_wanted && fits ? port : nullptr;
  for (InputBase* const input : {static_cast<InputBase*>(reader_.get()), static_cast<InputBase*>(each_.get())}) {
    if (input == nullptr || (input->incoming().empty() ? nullptr : input->incoming().front()) == wanted) continue;
    input->DisconnectAll();
    // Refused only if it is about to go.
    if (wanted != nullptr) (void)Port::Connect(*wanted, *input);
  }
  reader_->LookAgain();
}

void OfferedPort::SetBinding(const Port* source, std::vector<internal::PassedStop> stops) {
  Binding* const before = binding_.load(std::memory_order_relaxed);
  if (before != nullptr && before->IsOf(source, stops)) return;
  // Who stops the robot sends the safe value itself: the network's thread may wait for the structure lock.
  std::vector<StopSignal::Subscription> subscriptions;
  for (const internal::PassedStop& each : stops) {
    for (const auto& signal : {each.stop->robot(), each.stop->block()}) {
      if (signal) subscriptions.push_back(signal->Listen([bell = bell_] { bell->SendStop(); }));
    }
  }
  const std::uint64_t number = before != nullptr ? before->number + 1 : 1;
  // release: pairs with the acquire of those who send.
  binding_.store(new Binding{source, std::move(stops), number}, std::memory_order_release);
  Retire([before] { delete before; });
  stop_subscriptions_ = std::move(subscriptions);
  bell_->Ring();
}

void OfferedPort::Forget(const FrameworkElement& element) noexcept {
  Binding* const binding = binding_.load(std::memory_order_relaxed);
  const Port* const source = binding != nullptr ? binding->source.load(std::memory_order_relaxed) : nullptr;
  if (source != nullptr && source->IsAtOrBelow(element)) binding->source.store(nullptr, std::memory_order_release);
}

const TypeInfo& OfferedPort::type() const noexcept { return reader_->type(); }

bool OfferedPort::is_stopped() const {
  const EpochGuard guard;
  const Binding* const binding = binding_.load(std::memory_order_acquire);
  return binding != nullptr &&
         std::ranges::any_of(binding->stops, [](const auto& each) { return each.stop->in_force(); });
}

std::optional<Time> OfferedPort::Send(Time now) {
  if (is_stopped() && writer_ != nullptr) {
    (void)bell_->Answer();
    is_left_.store(false, std::memory_order_relaxed);
    bell_->SendByNetwork();
    return now + kAgain;
  }
  if (options_.rate > 0 && now < next_) return next_;  // the bell keeps on ringing
  const bool was_left = is_left_.load(std::memory_order_relaxed) && is_left_.exchange(false, std::memory_order_relaxed);
  if (writer_ != nullptr && (bell_->Answer() || was_left)) bell_->SendByNetwork();
  return is_left_.load(std::memory_order_relaxed) ? std::optional(now + kAgain) : std::nullopt;
}

void OfferedPort::SendBy(OfferBell::By by) noexcept {
  const std::uint64_t before = sent();
  try {
    SendSafeValue();
    if (by == OfferBell::By::kStop) return;
    if (each_ != nullptr) {
      SendEach(by == OfferBell::By::kCycle ? kFew : each_->capacity());
    } else if (SendNewest() && options_.rate > 0) {
      next_ = SteadyClock().Now() + FromSeconds(1 / options_.rate);
    }
  } catch (...) {
    Fail();
  }
  if (by == OfferBell::By::kNetwork) return;
  if (is_left_.load(std::memory_order_relaxed)) bell_->Ring();
  if (by == OfferBell::By::kCycle) sent_after_cycles_.fetch_add(sent() - before, std::memory_order_relaxed);
}

// The two clocks drift: a value that is sent again, as to who reads again, would have another one, and be taken for new.
Time OfferedPort::StampOf(ValueTimes times) {
  const bool is_again = stamped_ && stamped_->times.timestamp == times.timestamp &&
                        stamped_->times.publication_time == times.publication_time;
  if (!is_again) stamped_ = {times, times.timestamp + clock_.Now()};
  return stamped_->stamp;
}

// Once for each stop and release that has been seen: nobody elsewhere goes on by a value from before.
void OfferedPort::SendSafeValue() {
  std::shared_ptr<Octets> octets;
  Time stamp;
  std::int64_t bar;
  {
    const EpochGuard guard;
    const Binding* const binding = binding_.load(std::memory_order_acquire);
    if (binding == nullptr || binding->stops.empty()) return;
    const auto latest = std::ranges::max_element(binding->stops, {}, [](const auto& each) { return each.stop->bar(); });
    bar = latest->stop->bar();
    const Time now = SteadyClock().Now();
    const bool is_new = bar != bar_ && bar_ != StopSignal::kInForce;
    if (bar == StopSignal::kNever || !(is_new || (bar == StopSignal::kInForce && now >= again_))) {
      bar_ = bar;
      return;
    }
    again_ = now + kAgain / 2;
    octets = pool_.Take();
    stamp = reader_->runtime().clock().Now() + clock_.Now();
    form_->codec->Encode(latest->safe_value.get(), stamp, *octets);
    shown_.reset();  // what counts again comes after it
  }
  Write(octets, stamp);
  bar_ = bar;
}

bool OfferedPort::SendNewest() {
  std::shared_ptr<Octets> octets;
  Time stamp;
  Shown newest{};
  {
    const EpochGuard guard;  // what is loaded now stays so long
    // acquire: pairs with SetBinding().
    const Binding* const binding = binding_.load(std::memory_order_acquire);
    const Port* const source = binding != nullptr ? binding->source.load(std::memory_order_acquire) : nullptr;
    if (source == nullptr) return false;
    newest = {binding->number, source->publications()};
    if (newest == shown_) return false;
    octets = pool_.Take();
    bool is_whole = false;
    const bool is_there = source->VisitLatest([&](const void* value, ValueTimes of) {
      stamp = StampOf(of);
      is_whole = binding->LetsPass(of);
      if (is_whole) form_->codec->Encode(value, stamp, *octets);
    });
    if (!is_there || !is_whole) return false;
  }
  Write(octets, stamp);
  shown_ = newest;
  return true;
}

void OfferedPort::SendEach(std::size_t most) {
  std::shared_ptr<Octets> octets;
  Time stamp;
  for (std::size_t i = 0; i < most; ++i) {
    octets = pool_.Take();
    bool is_whole = false;
    const bool is_there = each_->Take([&](const void* value, ValueTimes of) {
      try {
        const EpochGuard guard;
        stamp = StampOf(of);
        if (!binding_.load(std::memory_order_acquire)->LetsPass(of)) return;
        form_->codec->Encode(value, stamp, *octets);
        is_whole = true;
      } catch (...) {
        Fail();
      }
    });
    if (!is_there) return;
    if (is_whole) Write(octets, stamp);
  }
  bell_->Ring();  // others have their turn first
}

void OfferedPort::Write(const std::shared_ptr<Octets>& octets, Time stamp) {
  is_large_ = is_large_ || octets->size() > kMostAfterCycle;
  bell_->set_sent_after_cycles(options_.sending == ValueSending::kAfterCycle && options_.rate <= 0 && !is_large_);
  const auto written = writer_->Write(octets, stamp.time_since_epoch().count());
  if (written) {
    sent_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  Error error = written.error();
  error.path = path_;
  const std::lock_guard lock(mutex_);
  error_ = std::move(error);
}

// Who takes the error makes its text: here there may be no memory for one.
void OfferedPort::Fail() noexcept {
  is_left_.store(true, std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  failure_ = std::current_exception();
}

bool OfferedPort::has_error() const {
  const std::lock_guard lock(mutex_);
  return error_.has_value() || failure_ != nullptr;
}

std::optional<Error> OfferedPort::TakeError() {
  const std::lock_guard lock(mutex_);
  if (failure_ != nullptr)
    error_ = Error{.message = "a value cannot be sent: " + DescribeException(failure_), .path = path_};
  failure_ = nullptr;
  return std::exchange(error_, {});
}

}  // namespace runnel
