// What the thread of a recorder does.
#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "core/base/error.h"
#include "core/types/type_info.h"
#include "plugins/mcap/mcap_writer.h"
#include "plugins/recording/recorder.h"
#include "plugins/recording/recording_names.h"
#include "plugins/values/foxglove_channel.h"

namespace runnel {

namespace {

// So long a value waits at most before it is taken; a queue of 128 keeps up with 25 kHz then.
constexpr auto kLookAgain = std::chrono::milliseconds(5);
// What a killed process loses is not older than this.
constexpr auto kLongestChunk = std::chrono::seconds(1);

std::uint64_t Nanoseconds(Time time) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(time.time_since_epoch().count(), 0));
}

template <typename Make>
Result<std::uint16_t> FindOrMake(std::map<std::string, std::uint16_t>& known, const std::string& name,
                                 const Make& make) {
  if (const auto found = known.find(name); found != known.end()) return found->second;
  const Result<std::uint16_t> made = make();
  if (made) known.emplace(name, *made);
  return made;
}

}  // namespace

// Whatever is thrown here ends the recording, and nothing else: the file has its end all the same.
void Recorder::Write() noexcept {
  for (const auto step : {&Recorder::WriteUntilEnd, &Recorder::EndFile, &Recorder::CountWritten}) {
    try {
      (this->*step)();
    } catch (...) {
      NoteException();
    }
  }
}

void Recorder::WriteUntilEnd() {
  while (!has_failed_) {
    const bool is_last = is_ending_;  // what was published before the end is waiting by now
    const bool found = WriteWaiting();
    if (has_gone_.exchange(false)) DropGone();
    if (std::chrono::steady_clock::now() - last_flush_ >= kLongestChunk) {
      last_flush_ = std::chrono::steady_clock::now();
      Note(WriteDrops());
      Note(writer_->Flush());
    }
    if (is_last && !found) break;
    if (found) continue;
    std::unique_lock lock(wake_mutex_);
    wake_.wait_for(lock, kLookAgain, [this] { return is_woken_; });
    is_woken_ = false;
  }
}

void Recorder::EndFile() {
  Note(WriteDrops());
  Note(writer_->Finish());
}

// Of a file that has failed, not what was waiting to be written.
void Recorder::CountWritten() {
  std::uint64_t written = 0;
  for (const std::uint16_t channel : channels_of_ports_) written += writer_->written_messages(channel);
  const std::lock_guard lock(mutex_);
  status_.bytes = writer_->written_bytes();
  status_.dropped += status_.values - std::min(status_.values, written);
  status_.values = written;
}

bool Recorder::WriteWaiting() {
  std::uint64_t count = 0;
  for (const auto& each : All()) {
    if (has_failed_) break;
    count += WriteWaitingOf(*each);
  }
  const bool has_written_log = WriteLog() > 0;
  const std::lock_guard lock(mutex_);
  status_.values += count;
  status_.bytes = writer_->written_bytes();
  return count > 0 || has_written_log;
}

// A view, since nobody replays it.
std::uint64_t Recorder::WriteLog() {
  std::deque<LogMessage> said;
  {
    const std::lock_guard lock(mutex_);
    said.swap(said_);
  }
  if (said.empty()) return 0;
  static const FoxgloveChannel form = LogChannel();
  const auto channel = ChannelFor(form, "log", true);
  Note(channel ? Result<void>() : channel.error());
  for (const LogMessage& message : said) {
    if (has_failed_) break;
    std::string json;
    form.append(&message, message.time, json);
    const std::uint64_t time = Nanoseconds(message.time);
    Note(writer_->AddMessage({*channel, ++written_messages_, time, time, json}));
  }
  return said.size();
}

// No more than a queue full, so that all ports have their turn.
std::uint64_t Recorder::WriteWaitingOf(Recorded& recorded) {
  std::uint64_t count = 0;
  for (std::size_t taken = 0; taken < recorded.probe->capacity() && !has_failed_; ++taken) {
    ValueTimes times;
    std::exception_ptr failure;  // the value must be let go of first
    const bool found = recorded.probe->Take([&](const void* value, ValueTimes of) {
      times = of;
      try {
        recorded.messages.resize(recorded.forms.size());
        for (std::size_t i = 0; i < recorded.forms.size(); ++i) {
          recorded.messages[i].clear();
          recorded.forms[i].append(value, of.timestamp, recorded.messages[i]);
        }
      } catch (...) {
        failure = std::current_exception();
      }
    });
    if (!found) break;
    if (failure) {  // those that can be are recorded all the same
      Error error{.message = "a value cannot be written, and is left out: " + DescribeException(failure),
                  .path = recorded.path};
      const std::lock_guard lock(mutex_);
      ++recorded.unwritten;
      if (!status_.unwritable) status_.unwritable = std::move(error);
      continue;
    }
    ++count;
    Note(WriteValue(recorded, times));
  }
  return count;
}

// Its log time is when it was published here, in the order of which values are replayed; its publish time
// when it was measured, as whoever published it there said.
Result<void> Recorder::WriteValue(Recorded& recorded, ValueTimes times) {
  // A port that has come back goes on in its channels, if it has its type.
  for (std::size_t i = recorded.channels.size(); i < recorded.forms.size(); ++i) {
    const auto channel = ChannelFor(recorded.forms[i], recorded.path, i > 0);
    if (!channel) return channel.error();
    recorded.channels.push_back(*channel);
  }
  ++recorded.sequence;
  for (std::size_t i = 0; i < recorded.channels.size(); ++i) {
    auto added = writer_->AddMessage({recorded.channels[i], recorded.sequence, Nanoseconds(times.publication_time),
                                      Nanoseconds(times.timestamp), recorded.messages[i]});
    if (!added) return added;
  }
  return {};
}

Result<std::uint16_t> Recorder::ChannelFor(const FoxgloveChannel& form, const std::string& port, bool is_view) {
  const auto schema = FindOrMake(schemas_, form.schema_name,
                                 [&] { return writer_->AddSchema(form.schema_name, kSchemaEncoding, form.schema); });
  if (!schema) return schema.error();
  return FindOrMake(channels_, port + " " + form.topic + " " + form.schema_name, [&] {
    auto added = writer_->AddChannel(*schema, form.topic, kMessageEncoding, {{is_view ? kViewOfKey : kPortKey, port}});
    if (added && !is_view) channels_of_ports_.push_back(*added);
    return added;
  });
}

// Written anew whenever there are more, so that the file of a killed process knows of them.
Result<void> Recorder::WriteDrops() {
  McapMetadata drops{kDropsMetadata, {}};
  std::uint64_t sum = 0;
  const auto add = [&](const std::string& path, std::uint64_t count) {
    sum += count;
    if (count > 0) drops.texts.emplace_back(path, std::to_string(count));
  };
  for (const auto& [path, count] : drops_of_gone_) add(path, count);
  for (const auto& each : All()) add(each->path, each->dropped());
  {
    const std::lock_guard lock(mutex_);
    add("log", lost_messages_);
  }
  if (sum == written_drops_) return {};
  written_drops_ = sum;
  return writer_->AddMetadata(drops);
}

// Probes to which nothing is connected any more, once they are empty.
void Recorder::DropGone() {
  std::vector<std::shared_ptr<Recorded>> gone;
  {
    const std::unique_lock structure(runtime_.structure_mutex(), std::try_to_lock);
    if (!structure) {
      has_gone_ = true;
      return;
    }
    for (const auto& each : All()) {
      const bool is_fed = std::ranges::any_of(
          each->probe->incoming(), [](const Port* port) { return port->life_cycle() != LifeCycle::kDeleted; });
      if (!is_fed) gone.push_back(each);
    }
  }
  for (const auto& each : gone) {
    if (each->probe->waiting() > 0) {
      has_gone_ = true;
      continue;
    }
    const std::lock_guard lock(mutex_);
    if (is_finishing_) return;
    std::erase(recorded_, each);
    status_.dropped += each->dropped();
    drops_of_gone_.emplace_back(each->path, each->dropped());
  }
}

void Recorder::Note(const Result<void>& done) {
  if (done) return;
  has_failed_ = true;
  const std::lock_guard lock(mutex_);
  if (!status_.failure) status_.failure = done.error();
}

void Recorder::NoteException() noexcept {
  has_failed_ = true;
  std::string what = DescribeException();
  const std::lock_guard lock(mutex_);
  if (!status_.failure) status_.failure.emplace().message = std::move(what);
}

}  // namespace runnel
