#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/element/runtime.h"
#include "plugins/timing/trace_track.h"
#include "plugins/tracing/trace_file.h"

namespace runnel {

namespace internal {
struct TracedThread;
struct PendingTrace;
struct TraceSpan;
class TraceWriter;
}  // namespace internal

struct TraceOptions {
  std::string file;
  std::string application;    ///< its name
  bool is_simulated = false;  ///< cycles bear the time of the simulated clock
  /// How many events of one thread may wait to be written down.
  std::size_t capacity = 65'536;
  /// How long the file may become; what comes then is left out. Viewers hold all of it in memory.
  std::uint64_t most_bytes = 1'000'000'000;
  Duration interval = std::chrono::milliseconds(5);  ///< from one writing to the next
};

/// Writes into a file what the threads of an application do: cycles, the updates in them and what those
/// publish, faults, holds and changes of the structure. A track for each thread container, and one for
/// changes.
///
/// Give it to the scheduler (SchedulerOptions::tracer) before anything is scheduled. Cycles note what they
/// do on tracks of their own, lock-free; a thread of this class takes it from there every few milliseconds.
///
/// Ownership:  must outlive the scheduler; the runtime must outlive it.
/// Threads:    Finish() by one thread, when no cycle runs any more; the rest by the framework.
class TraceRecorder final : public CycleTracer, private ElementListener {
 public:
  /// Errors: the file cannot be made.
  static Result<std::unique_ptr<TraceRecorder>> Start(Runtime& runtime, TraceOptions options);
  ~TraceRecorder() override;

  /// What is put in, taken out and connected from now on is written down; not what is built before.
  void FollowStructure();
  /// Writes the rest and closes the file. Errors: what could not be written, or why the writing came to
  /// an early end.
  Result<TraceSummary> Finish();

  TraceTrack& TrackOf(std::uint64_t id, const std::string& path) override;
  std::unique_ptr<TracedElement> Watch(FrameworkElement& element) override;
  std::uint64_t NumberOf(const std::string& name) override;
  void OnHold(const std::string& path, Time began, Time ended) noexcept override;

 private:
  TraceRecorder(Runtime& runtime, TraceOptions options, TraceFile file);

  void OnReady(FrameworkElement& element) override;
  void OnDeleted(FrameworkElement& element) override {
    AddChange([&] { return "took out " + element.path(); });
  }
  void OnConnected(FrameworkElement& from, FrameworkElement& to) override {
    AddChange([&] { return "connected " + from.path() + " to " + to.path(); });
  }
  void OnDisconnected(FrameworkElement& from, FrameworkElement& to) override {
    AddChange([&] { return "disconnected " + from.path() + " from " + to.path(); });
  }

  void Add(internal::TraceSpan span);
  std::uint64_t GiveNumber(const std::string& name);
  void AddChange(const std::function<std::string()>& words) noexcept;
  [[nodiscard]] internal::PendingTrace TakePending();
  void Work() noexcept;
  void WriteUntilTheEnd();

  Runtime& runtime_;
  const TraceOptions options_;
  std::mutex mutex_;  // a leaf
  // Guarded by mutex_, down to the next blank line. The threads remain, whatever becomes of them.
  std::vector<std::unique_ptr<internal::TracedThread>> threads_;
  std::uint64_t names_given_ = 0;
  // That the writer does not know yet:
  std::vector<internal::TracedThread*> new_threads_;
  std::vector<std::string> new_names_;
  std::vector<internal::TraceSpan> spans_;
  std::uint64_t lost_spans_ = 0;
  bool follows_structure_ = false;
  bool ends_ = false;

  std::condition_variable end_;
  const std::unique_ptr<internal::TraceWriter> writer_;
  std::exception_ptr failure_;  // of the writing thread, once it has ended
  std::thread thread_;
};

}  // namespace runnel
