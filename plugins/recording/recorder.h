#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/base/result.h"
#include "core/element/runtime.h"
#include "core/log/log_sink.h"
#include "core/port/probe_port.h"
#include "plugins/scheduling/backpressure.h"
#include "plugins/values/foxglove_channel.h"
#include "plugins/values/port_patterns.h"

namespace runnel {

class McapWriter;
class Scheduler;

/// What a recording says about where it comes from, for `runnel info` and for who replays it.
struct RecordedApplication {
  std::string name = {};
  std::string file = {};      ///< that it was built from
  std::string text = {};      ///< of that file; kept as an attachment
  std::string settings = {};  ///< "world=maze.xml seed=3"
  std::string version = {};   ///< of Runnel
};

struct RecorderOptions {
  std::string file;
  std::vector<std::string> ports = {};  ///< see PortPatterns; none: all outputs
  /// "zstd", "lz4", "none"; "": the best there is.
  std::string compression = {};
  std::size_t capacity = ProbePort::kCapacity;  ///< values of one port that may wait to be written
  RecordedApplication about = {};
};

/// How a recording is going.
struct RecordingStatus {
  std::uint64_t values = 0;
  std::uint64_t dropped = 0;  ///< had no room to wait, or could not be written
  std::size_t ports = 0;      ///< all that were there while it ran
  std::uint64_t bytes = 0;    ///< of the file
  /// Ports that fit, but whose values have no form that can be written.
  std::vector<std::string> left_out = {};
  /// Patterns that no port has fitted so far.
  std::vector<std::string> idle_patterns = {};
  std::optional<Error> unwritable = {};  ///< the first value that could not be written
  std::optional<Error> failure = {};     ///< nothing more is written
};

/// Records the values of outputs into an MCAP file: as JSON, with the times at which each value was published
/// (log_time) and measured (publish_time), with JSON schemas, and with what the application was; what Foxglove can draw also in its own schemas. What
/// modules say is recorded in its schema for logs, as "/log". Ports that come later are recorded from their first
/// value on, as soon as they fit; those that go just end.
///
/// Publishers pay what a queue costs (ProbePort). A thread of the recorder takes the values, makes text of them
/// and writes. On a real clock, what comes while a port's queue is full is lost, and counted; simulated
/// time waits instead, between two cycles, so that a recording of it is complete unless one cycle
/// publishes more than half a queue at one port.
///
/// Ownership:  of the file. The runtime and the scheduler must outlive it.
/// Threads:    Start() and Finish() outside of cycles and without the structure lock; status() any.
/// Errors:     of the file: at the start, told by Start(); later, the recording ends and the application
///             goes on, see RecordingStatus::failure.
class Recorder final : public ElementListener, public BackpressureSource {
 public:
  /// `scheduler` is told to hold simulated time back; nullptr: nobody is. Errors: of the file; a pattern
  /// that names one port which is not there or cannot be recorded, with the nearest name.
  static Result<std::unique_ptr<Recorder>> Start(Runtime& runtime, Scheduler* scheduler, RecorderOptions options);
  /// Finishes.
  ~Recorder() override;

  /// Writes what waits and ends the file. Idempotent. Errors: as RecordingStatus::failure.
  Result<void> Finish();
  /// Writes what waits and ends the file, without the structure lock: when the process is about to end by a crash. Once;
  /// nothing but destroying may follow.
  void FinishFile() noexcept { EndWriting(); }
  [[nodiscard]] RecordingStatus status() const;
  [[nodiscard]] const std::string& file() const noexcept { return options_.file; }
  /// The failure, or that a value could not be written, once each.
  [[nodiscard]] std::optional<Error> TakeFailure();

  void OnReady(FrameworkElement& element) override;
  // Whether another module takes over its connections, as one that replaces it does, is seen later.
  void OnDeleted(FrameworkElement& /*element*/) override { has_gone_ = true; }
  void OnChangesEnd() override;
  void WaitForRoom() noexcept override;

 private:
  /// One port, as it is recorded.
  struct Recorded {
    std::string path;
    const TypeInfo* type;
    std::unique_ptr<ProbePort> probe;
    std::uint64_t unwritten = 0;  // guarded by mutex_
    [[nodiscard]] std::uint64_t dropped() const { return unwritten + probe->dropped(); }
    std::vector<FoxgloveChannel> forms;  // in which its values are written, the whole one first
    // The writing thread's own:
    std::vector<std::uint16_t> channels;  // one for each form, once there is a value
    std::vector<std::string> messages;    // likewise: the newest
    std::uint32_t sequence = 0;
  };

  Recorder(Runtime& runtime, Scheduler* scheduler, RecorderOptions options, PortPatterns patterns);
  Result<void> Begin();
  Result<void> CheckNames();
  Result<void> WriteAbout();

  // Under the structure lock.
  void Follow(Port& port, const Recorded* before = nullptr);  // as what it was recorded before
  void NoteUse(const Port& port);
  void ShowWhereTheRobotIs();
  [[nodiscard]] bool IsRecorded(const Port& port);
  void DropGone();
  // By Finish().
  void DisconnectProbes();
  void EndWriting() noexcept;
  void Wake() noexcept;

  void Keep(const LogMessage& message);

  // By the writing thread, or by Finish() when that has ended.
  void Write() noexcept;
  void WriteUntilEnd();
  void EndFile();
  void CountWritten();
  bool WriteWaiting();
  std::uint64_t WriteWaitingOf(Recorded& recorded);
  Result<void> WriteValue(Recorded& recorded, ValueTimes times);
  std::uint64_t WriteLog();
  Result<std::uint16_t> ChannelFor(const FoxgloveChannel& form, const std::string& port, bool is_view);
  Result<void> WriteDrops();
  void Note(const Result<void>& done);
  void NoteException() noexcept;
  [[nodiscard]] std::vector<std::shared_ptr<Recorded>> All() const;

  Runtime& runtime_;
  Scheduler* const scheduler_;
  RecorderOptions options_;
  const PortPatterns patterns_;
  std::unique_ptr<FrameworkElement> element_;  // below which the probes are

  mutable OrderedMutex mutex_{LockLevel::kLeaf};
  std::vector<std::shared_ptr<Recorded>> recorded_;  // guarded by mutex_
  RecordingStatus status_;                           // likewise
  std::vector<std::pair<std::string, std::uint64_t>> drops_of_gone_;
  std::deque<LogMessage> said_;      // and is not written yet; guarded by mutex_
  std::uint64_t lost_messages_ = 0;  // likewise
  bool failure_is_told_ = false;
  bool unwritable_is_told_ = false;
  bool is_finishing_ = false;      // guarded by mutex_: nothing is taken out of recorded_ any more
  std::uint64_t made_probes_ = 0;  // under the structure lock
  bool has_new_names_ = false;     // likewise: OnChangesEnd() has to look

  std::unique_ptr<McapWriter> writer_;
  std::map<std::string, std::uint16_t> schemas_;
  std::map<std::string, std::uint16_t> channels_;
  std::vector<std::uint16_t> channels_of_ports_;  // in which each value stands once
  bool has_begun_ = false;                        // else its file goes with it
  bool has_finished_ = false;
  std::uint64_t written_drops_ = 0;
  std::uint32_t written_messages_ = 0;
  std::chrono::steady_clock::time_point last_flush_{};

  std::atomic<bool> has_failed_{false};
  std::atomic<bool> is_ending_{false};
  std::atomic<bool> has_gone_{false};
  std::mutex wake_mutex_;
  std::condition_variable wake_;
  bool is_woken_ = false;  // guarded by wake_mutex_
  std::thread thread_;
  std::optional<LogSink> log_sink_;
};

}  // namespace runnel
