#include "plugins/recording/played_values.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>

#include "core/base/erase_where.h"
#include "core/module/executable.h"
#include "core/port/cycle.h"
#include "core/types/type_info.h"
#include "plugins/recording/recording_player.h"
#include "plugins/services/call_record.h"
#include "plugins/services/callable.h"
#include "plugins/values/foxglove_channel.h"

namespace runnel {

namespace {

std::int64_t Signed(std::uint64_t time) {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() / 2);
  return static_cast<std::int64_t>(std::min(time, kMost));
}

constexpr std::string_view kSuffix = "_calls";
// How long a round waits for who takes its last values: a module may be paused, or deleted.
constexpr Duration kAwaited = std::chrono::seconds(1);
constexpr Duration kNoTimeout = std::chrono::hours(24 * 365);

}  // namespace

PlayedValues::PlayedValues(std::unique_ptr<McapReader> reader, std::optional<Duration> from, std::optional<Duration> to,
                           bool loops)
    : reader_(std::move(reader)), loops_(loops) {
  const McapStatistics& all = reader_->contents().statistics;
  const std::int64_t first = Signed(all.start);
  start_ = first + (from ? from->count() : 0);
  end_ = Signed(all.end);
  if (to && to->count() < end_ - first) end_ = first + to->count();
  end_ = std::max(end_, start_);
}

void PlayedValues::Start(Time now) {
  const std::lock_guard lock(mutex_);
  offset_ = now.time_since_epoch().count() - start_;
  has_begun_ = true;
  Rewind();
}

void PlayedValues::Rewind() {
  next_chunk_ = 0;
  before_.clear();
  for (auto& [channel, values] : waiting_) values.clear();
  Read(start_);
  for (auto& [channel, value] : before_) {
    // What was the newest when the stretch began is published at its beginning; with its own time, unless
    // that would go back behind what the round before has published.
    if (loops_) {
      value.timestamp += start_ - value.time;
      value.time = start_;
    }
    waiting_[channel].push_front(std::move(value));
  }
  before_.clear();
}

// All chunks that may have values until then.
void PlayedValues::Read(std::int64_t until) {
  const auto& chunks = reader_->contents().chunks;
  while (!failure_ && next_chunk_ < chunks.size()) {
    const std::int64_t start = Signed(chunks[next_chunk_].start);
    if (start > until && start <= end_) return;
    if (start <= end_) ReadChunk(chunks[next_chunk_]);
    ++next_chunk_;
  }
}

void PlayedValues::ReadChunk(const McapChunk& chunk) {
  const auto read = reader_->ReadMessages(chunk, [&](const McapMessage& message) -> Result<void> {
    const auto wanted = waiting_.find(message.channel);
    if (wanted == waiting_.end()) return {};
    Waiting value{Signed(message.log_time), chunk.offset, Signed(message.publish_time), std::string(message.data)};
    if (value.time > end_) return {};
    if (value.time < start_) {
      const auto [newest, is_first] = before_.try_emplace(message.channel);
      if (is_first || value.order() >= newest->second.order()) newest->second = std::move(value);
      return {};
    }
    std::deque<Waiting>& values = wanted->second;
    // Nearly always at the end: chunks overlap little, and each has a channel's values in order.
    const auto place = std::ranges::upper_bound(values, value.order(), {}, &Waiting::order);
    values.insert(place, std::move(value));
    return {};
  });
  if (!read) failure_ = read.error();
}

std::optional<PlayedValues::Value> PlayedValues::Take(std::uint16_t channel, Time now) {
  const std::lock_guard lock(mutex_);
  if (!has_begun_ || failure_) return {};
  std::int64_t at = now.time_since_epoch().count() - offset_;
  const bool has_ended = loops_ && at > end_ && HasEnded();
  if (has_ended || (loops_ && at - end_ > kAwaited.count())) {
    // The next round begins a nanosecond after the last value, so that time goes on.
    offset_ += has_ended ? end_ - start_ + 1 : at - start_;
    at = now.time_since_epoch().count() - offset_;
    Rewind();
  }
  Read(at);
  std::deque<Waiting>& values = waiting_[channel];
  if (values.empty() || values.front().time > at) return {};
  Waiting first = std::move(values.front());
  values.pop_front();
  return Value{Time(Duration(first.time + offset_)), Time(Duration(first.timestamp + offset_)), std::move(first.json)};
}

bool PlayedValues::HasEnded() const {
  return next_chunk_ >= reader_->contents().chunks.size() &&
         std::ranges::all_of(waiting_, [](const auto& each) { return each.second.empty(); });
}

bool PlayedValues::is_over() const {
  const std::lock_guard lock(mutex_);
  return failure_.has_value() || (has_begun_ && !loops_ && HasEnded());
}

void PlayedValues::Fail(Error error) {
  const std::lock_guard lock(mutex_);
  if (!failure_) failure_ = std::move(error);
}

std::optional<Error> PlayedValues::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

struct PlayedCalls::Service {
  Port* records;
  Callable* callable;
  FrameworkElement* module;
};

/// The calls of one module's services. Runs in front of its first task.
class PlayedCalls::OfModule {
 public:
  struct Made {
    Callable* callable;
    std::shared_ptr<void> record;  // a CallRecord
    Time called;
    std::unique_ptr<AnyCall> call = nullptr;  // while it is under way

    [[nodiscard]] const CallRecordBase& base() const { return *static_cast<const CallRecordBase*>(record.get()); }
  };

  OfModule(const PlayedCalls& all, FrameworkElement& module) : all_(all), module_(module) {}

  [[nodiscard]] FrameworkElement& module() const noexcept { return module_; }
  [[nodiscard]] std::size_t size() const noexcept { return calls_.size(); }
  void Add(Made made) { calls_.push_back(std::move(made)); }
  void Wrap() {
    std::ranges::stable_sort(calls_, {}, [](const Made& each) { return std::pair(each.base().begun, each.called); });
    std::vector<Task> tasks = module_.FindAnnotation<Executable>()->tasks();
    if (tasks.empty()) return;
    original_ = tasks.front().run;
    tasks.front().run = BoundCall::To<&OfModule::Run>(*this);
    module_.Annotate(std::make_unique<Executable>([tasks] { return tasks; }));
  }
  void Run() {
    if (const Cycle* const cycle = CurrentCycle()) Make(cycle->now);
    (*original_)();
  }

 private:
  void Make(Time now) {
    const Time then = now - all_.offset_;
    for (; next_ < calls_.size() && calls_[next_].base().begun <= then; ++next_) {
      Made& made = calls_[next_];
      made.call = made.callable->NewCall();
      made.call->TakeArguments(made.base());
      if (made.call->Begin(now, kNoTimeout) == CallStatus::kPending) under_way_.push_back(&made);
    }
    EraseWhere(under_way_, [&](Made* made) {
      const Time asked = made->base().asked_to_end;
      if (asked != Time() && asked <= then) made->call->Abort();
      if (made->call->Poll(now) == CallStatus::kPending) return false;
      made->call.reset();
      return true;
    });
  }

  const PlayedCalls& all_;
  FrameworkElement& module_;
  std::vector<Made> calls_;
  std::size_t next_ = 0;
  std::vector<Made*> under_way_;
  std::optional<BoundCall> original_;
};

PlayedCalls::PlayedCalls() = default;
PlayedCalls::~PlayedCalls() = default;

bool PlayedCalls::Add(Port& records, std::uint16_t channel) {
  if (!records.name().ends_with(kSuffix) || records.parent() == nullptr) return false;
  FrameworkElement* const port =
      records.parent()->FindChild(records.name().substr(0, records.name().size() - kSuffix.size()));
  auto* const callable = port != nullptr ? port->FindAnnotation<Callable>() : nullptr;
  FrameworkElement* module = records.parent();
  while (module != nullptr && module->FindAnnotation<Executable>() == nullptr) module = module->parent();
  if (callable == nullptr || module == nullptr) return false;
  services_.emplace(channel, Service{&records, callable, module});
  return true;
}

Result<void> PlayedCalls::Read(McapReader& reader, Time from, Time to) {
  if (services_.empty()) return {};
  return reader.ReadMessages([&](const McapMessage& message) -> Result<void> {
    const auto found = services_.find(message.channel);
    if (found == services_.end()) return {};
    const auto& [records, callable, module] = found->second;
    OfModule::Made made{callable, records->type().Make(), Time(Duration(message.publish_time))};
    if (auto read = SetFromMessage(records->type(), message.data, made.record.get()); !read) {
      return read.error().WithPath(records->path());
    }
    const CallRecordBase& call = made.base();
    if (call.number != 0 || call.begun < from || call.begun > to) return {};
    auto of = std::ranges::find(modules_, module, [](const auto& each) { return &each->module(); });
    if (of == modules_.end()) of = modules_.insert(of, std::make_unique<OfModule>(*this, *module));
    (*of)->Add(std::move(made));
    return {};
  });
}

void PlayedCalls::WrapTasks(const std::function<bool(const FrameworkElement& module)>& runs) {
  for (const auto& each : modules_) {
    if (!runs(each->module())) continue;
    each->Wrap();
    size_ += each->size();
  }
}

}  // namespace runnel
