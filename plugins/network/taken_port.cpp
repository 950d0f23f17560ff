#include "plugins/network/taken_port.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

#include "core/element/runtime.h"
#include "core/port/cycle.h"
#include "core/port/driving_ports.h"
#include "plugins/network_discovery/discovery_table.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

namespace {
constexpr std::size_t kMostGone = 64;
constexpr std::size_t kMostKept = 128;  // of one writer
constexpr std::size_t kEnd = 128;       // octets

// No lease is shorter. What comes sooner after its like, as two of a queue that were published at once, counts.
constexpr auto kShortestLoss = std::chrono::seconds(1);

// Of values that are not latched, which come often and may be large, their size and both ends have to do.
std::size_t HashOf(std::span<const std::byte> octets, bool is_whole) {
  const auto hash = [](std::span<const std::byte> part) {
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(part.data()), part.size()});
  };
  if (is_whole || octets.size() <= 2 * kEnd) return hash(octets);
  return hash(octets.first(kEnd)) ^ (3 * hash(octets.last(kEnd))) ^ octets.size();
}
}  // namespace

TakenPort::TakenPort(Port& output, TakeOptions options, std::shared_ptr<const ValueForm> form, ClockOffset clock,
                     const DiscoveryTable& table)
    : output_(output),
      options_(std::move(options)),
      form_(std::move(form)),
      clock_(std::move(clock)),
      table_(table),
      endpoint_{.topic = DdsTopic(options_.topic), .type = form_->codec->dds_type(), .user_data = form_->user_data} {
  output_.Annotate(std::make_unique<WritersElsewhere>(matched_));
}

// Under mutex_. As much as all of them offer, so that none is left out and nothing that they keep is missed. What is kept by one
// that has been here beside others that keep nothing may be from before, and no command of now: as long as one of those is there,
// nobody is asked for what is kept.
WireQos TakenPort::WantedQos(const std::vector<WireEndpoint>& writers) {
  WireQos qos = QosOf(options_.quality.value_or(ValueQuality::kNewest));
  const auto fits = [&](const WireEndpoint& each) {
    return each.options.type == endpoint_.type && Find(each.handle).fits;
  };
  // Readers have writers with a strength, or those without, as ROS 2's are: who has said one counts more.
  qos.is_exclusive = options_.is_exclusive && std::ranges::any_of(writers, [&](const WireEndpoint& each) {
                       return fits(each) && each.options.qos.is_exclusive;
                     });
  if (options_.quality) return qos;
  bool all_are_exclusive = true;
  bool is_latched = false;
  bool is_first = true;
  for (const WireEndpoint& each : writers) {
    if (!fits(each)) continue;
    qos.is_reliable = qos.is_reliable && each.options.qos.is_reliable;
    is_latched = (is_first || is_latched) && each.options.qos.is_latched && !Find(each.handle).is_passed_over;
    all_are_exclusive = all_are_exclusive && each.options.qos.is_exclusive;
    qos.depth = std::max(qos.depth, std::min(each.options.qos.depth, 128u));
    is_first = false;
  }
  qos.is_latched = is_latched;
  for (const WireEndpoint& each : writers) Find(each.handle).is_passed_over = !is_latched && fits(each);
  qos.is_exclusive = qos.is_exclusive || (!is_first && all_are_exclusive);
  return qos;
}

Result<void> TakenPort::Follow(WireParticipant& participant) {
  if (!is_connected_) {
    reader_.reset();
    *matched_ = 0;
    return {};
  }
  const auto writers = table_.Partners(endpoint_.topic, true);
  WireQos qos;
  {
    const std::lock_guard lock(mutex_);
    ForgetGone(writers);
    for (const WireEndpoint& each : writers) (void)Find(each.handle, true);
    qos = WantedQos(writers);
  }
  if (reader_ != nullptr && (qos == endpoint_.qos || writers.empty())) return {};
  reader_.reset();
  {
    const std::lock_guard lock(mutex_);
    endpoint_.qos = qos;
    MarkAsDelivered();
  }
  auto reader = participant.MakeReader(
      endpoint_, [this](const WireSample& sample) { Take(sample); },
      [this](std::size_t count) {
        if (count >= matched_->exchange(count, std::memory_order_relaxed)) return;
        const std::lock_guard lock(mutex_);
        MarkAsDelivered();
      });
  if (!reader) {
    *matched_ = 0;
    return reader.error();
  }
  reader_ = std::move(*reader);
  return {};
}

// The table has been told of it before its first value comes.
TakenPort::Writer& TakenPort::Find(std::uint64_t handle, bool looks_again) {
  auto known = std::ranges::find(writers_, handle, &Writer::handle);
  if (known != writers_.end() && !looks_again) return *known;
  const auto endpoint = table_.FindWriter(handle);
  if (known == writers_.end()) {
    ForgetGone(table_.Partners(endpoint_.topic, true));
    Writer writer{handle};
    const auto before = endpoint ? std::ranges::find(gone_, endpoint->id, &Writer::id) : gone_.end();
    if (before != gone_.end()) {
      writer.before = writer.delivered = before->delivered;
      writer.clock = before->clock;
      writer.is_passed_over = before->is_passed_over;
    }
    known = writers_.insert(writers_.end(), std::move(writer));
  }
  Writer& writer = *known;
  if (endpoint) {
    writer.id = endpoint->id;
    writer.fits = TypeMisfit(endpoint->options.user_data, endpoint_.user_data).empty();
    writer.has_simulated_time = table_.HasSimulatedTime(endpoint->participant);
    writer.application = table_.ApplicationName(endpoint->participant);
    // Not all engines say how many others keep.
    const WireQos& qos = endpoint->options.qos;
    writer.kept = !qos.is_latched              ? 0
                  : writer.application.empty() ? kMostKept
                                               : std::min<std::size_t>(qos.depth, kMostKept);
  }
  return writer;
}

// Under mutex_, as the next two. What writers keep is delivered again to a reader that is made anew, and when a link comes back.
// Then applications of Runnel send the newest value again that they offer, latched or not.
void TakenPort::MarkAsDelivered() {
  for (Writer& each : writers_) each.before = each.delivered;
}

// They are delivered again in their order, and what is new comes after them.
bool TakenPort::HasComeBefore(Writer& writer, const Delivered& value) {
  const auto found = std::ranges::find(writer.before, value);
  const bool is_known = found != writer.before.end();
  writer.before.erase(writer.before.begin(), is_known ? found + 1 : found);
  if (is_known) return true;
  writer.delivered.push_back(value);
  if (writer.delivered.size() > std::max<std::size_t>(writer.kept, 1)) writer.delivered.pop_front();
  return false;
}

void TakenPort::ForgetGone(const std::vector<WireEndpoint>& writers) {
  const auto is_gone = [&](std::uint64_t handle) {
    return std::ranges::find(writers, handle, &WireEndpoint::handle) == writers.end();
  };
  if (is_gone(chosen_)) chosen_ = 0;
  const auto has_gone = [&](const Writer& each) { return is_gone(each.handle); };
  std::ranges::copy_if(writers_, std::front_inserter(gone_), has_gone);
  gone_.resize(std::min(gone_.size(), kMostGone));
  std::erase_if(writers_, has_gone);
  if (writers.size() < 2) come_in_turn_ = is_turn_told_ = false;
}

// Of those without a strength the first keeps it. An application that was killed is there until its lease is over: whoever has
// been started again in its place, under its name, has it sooner. Of others' names, as nodes of ROS 2 have them, nothing follows.
bool TakenPort::IsHeard(std::uint64_t writer) {
  constexpr auto kSilent = std::chrono::seconds(1);
  if (ChoosesItself()) {
    const Time now = SteadyClock().Now();
    if (chosen_ != 0 && chosen_ != writer) {
      const std::string& application = Find(chosen_).application;
      const bool is_started_again = !application.empty() && application == Find(writer).application;
      if (!is_started_again || now - chosen_came_ < kSilent) return false;
    }
    chosen_ = writer;
    chosen_came_ = now;
  }
  if (last_writer_ == writer) return true;
  come_in_turn_ = come_in_turn_ || (writer_before_ == writer && !options_.is_exclusive && !endpoint_.qos.is_exclusive);
  writer_before_ = std::exchange(last_writer_, writer);
  return true;
}

std::uint64_t TakenPort::chosen() const {
  const std::lock_guard lock(mutex_);
  return ChoosesItself() ? chosen_ : 0;
}

void TakenPort::Take(const WireSample& sample) noexcept {
  try {
    const Duration offset = clock_.Now();
    const Time now = output_.runtime().clock().Now();
    Time sent = Time(Duration(sample.source_time)) - offset;
    Duration held_up{};
    bool is_comparable = false;
    {
      const std::lock_guard lock(mutex_);
      Writer& writer = Find(sample.writer);
      if (!writer.fits) return;
      const Delivered value{sample.source_time, HashOf(sample.octets, writer.kept > 0)};
      const bool is_the_last = !writer.delivered.empty() && writer.delivered.back() == value;
      // By the clocks of both machines, whatever time the application has.
      const Time machine = SteadyClock().Now();
      const Duration on_its_way = ClockOffset{}.Now() + machine.time_since_epoch() - Duration(sample.source_time);
      // It has come before: it keeps the stamp, or arrival, that it had then.
      if (HasComeBefore(writer, value) || !IsHeard(sample.writer)) return;
      is_comparable = !clock_.is_simulated && !writer.has_simulated_time;
      if (!writer.has_simulated_time) {
        // What a latched writer keeps may have lain there for hours.
        const Duration longest = writer.kept > 0 ? kFarthest : WriterClock::kLongestDelay;
        held_up = writer.clock.HeldUp(on_its_way, machine, longest);
        if (!output_.runtime().robot_stop().CheckIsKnown({.asked = writer.clock.sent(), .requests = {}})) {
          held_up = clock_.is_simulated ? now.time_since_epoch()
                                        : machine - writer.clock.sent();  // simulated time may be faster
        }
      }
      // Sent again by who had lost this reader, of which nothing is seen here: as where this process stood still.
      const Duration gap = machine - std::exchange(writer.came, machine);
      if (is_the_last && held_up > Duration{} && gap >= kShortestLoss) return;
      if (is_comparable) writer.clock.Note(now - sent, now);
      if (is_comparable) sent -= writer.clock.ahead();
    }
    if (!sample.flaw.empty()) return Refuse({.message = std::string(sample.flaw)});
    const OwnCycle cycle(now);
    std::optional<Time> timestamp;
    if (held_up > Duration{}) timestamp = now - held_up;
    // The older one of both: of what is held up for long the soonest of late says too little.
    if (options_.keeps_stamps && is_comparable) timestamp = std::min({sent, now, timestamp.value_or(now)});
    const auto published = output_.PublishFilled(
        [&](void* value) -> Result<void> {
          const auto read = form_->codec->Decode(sample.octets, value, sample.holder);
          return read ? Result<void>() : read.error();
        },
        timestamp);
    if (published) {
      taken_.fetch_add(1, std::memory_order_relaxed);
    } else {
      Refuse(published.error());
    }
  } catch (...) {
    refused_.fetch_add(1, std::memory_order_relaxed);
  }
}

void TakenPort::Refuse(Error error) {
  refused_.fetch_add(1, std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  error_ = std::move(error);
}

std::optional<Error> TakenPort::TakeError() {
  const std::lock_guard lock(mutex_);
  return std::exchange(error_, {});
}

TakenPort::WriterInCharge TakenPort::Owner() const {
  const std::lock_guard lock(mutex_);
  const std::uint64_t owner = ChoosesItself() ? chosen_ : endpoint_.qos.is_exclusive ? last_writer_ : 0;
  const auto writer = owner != 0 ? table_.FindWriter(owner) : std::nullopt;
  if (!writer) return {};
  const WireQos& qos = writer->options.qos;
  return {owner, table_.NameOf(writer->participant) +
                     (qos.is_exclusive ? " (strength " + std::to_string(qos.strength) + ")" : "")};
}

std::optional<Duration> TakenPort::least_delay(std::uint64_t writer) const {
  const std::lock_guard lock(mutex_);
  const auto known = std::ranges::find(writers_, writer, &Writer::handle);
  return known == writers_.end() ? std::nullopt : known->clock.least();
}

}  // namespace runnel
