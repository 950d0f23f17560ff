#include "plugins/recording/played_values.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>

namespace runnel {

namespace {

std::int64_t Signed(std::uint64_t time) {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() / 2);
  return static_cast<std::int64_t>(std::min(time, kMost));
}

}  // namespace

PlayedValues::PlayedValues(std::unique_ptr<McapReader> reader, std::optional<Duration> from,
                           std::optional<Duration> to, bool loops)
    : reader_(std::move(reader)), loops_(loops) {
  const McapStatistics& all = reader_->contents().statistics;
  const std::int64_t first = Signed(all.start);
  start_ = first + (from ? from->count() : 0);
  end_ = Signed(all.end);
  if (to) end_ = std::min(end_, first + to->count());
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
    const std::int64_t time = Signed(message.log_time);
    const std::int64_t timestamp = Signed(message.publish_time);
    if (time > end_) return {};
    if (time < start_) {
      Waiting& newest =
          before_.try_emplace(message.channel, Waiting{time, timestamp, {}}).first->second;
      if (time >= newest.time) newest = {time, timestamp, std::string(message.data)};
      return {};
    }
    std::deque<Waiting>& values = wanted->second;
    // Nearly always at the end: chunks overlap little, and each has a channel's values in order.
    const auto place =
        std::upper_bound(values.begin(), values.end(), time,
                         [](std::int64_t at, const Waiting& each) { return at < each.time; });
    values.insert(place, {time, timestamp, std::string(message.data)});
    return {};
  });
  if (!read) failure_ = read.error();
}

std::optional<PlayedValues::Value> PlayedValues::Take(std::uint16_t channel, Time now) {
  const std::lock_guard lock(mutex_);
  if (!has_begun_ || failure_) return {};
  std::int64_t at = now.time_since_epoch().count() - offset_;
  if (loops_ && at > end_ && HasEnded()) {
    // The next round begins a nanosecond after the last value, so that time goes on.
    offset_ += end_ - start_ + 1;
    at = now.time_since_epoch().count() - offset_;
    Rewind();
  }
  Read(at);
  std::deque<Waiting>& values = waiting_[channel];
  if (values.empty() || values.front().time > at) return {};
  Waiting first = std::move(values.front());
  values.pop_front();
  return Value{Time(Duration(first.time + offset_)), Time(Duration(first.timestamp + offset_)),
               std::move(first.json)};
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

}  // namespace runnel
