#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plugins/timing/trace_track.h"
#include "plugins/tracing/trace_file.h"

namespace runnel::internal {

/// The thread of one container, as the trace shows it.
struct TracedThread {
  TracedThread(std::uint64_t its_id, std::string its_name, std::size_t capacity)
      : id(its_id), name(std::move(its_name)), track(capacity) {}

  const std::uint64_t id;
  const std::string name;  ///< JSON
  TraceTrack track;
};

/// What has not been noted in a cycle. `ended` is nothing for what takes no time.
struct TraceSpan {
  std::string name;  ///< JSON
  const char* category;
  Time began;
  std::optional<Time> ended;
  std::string arguments;  ///< the inside of a JSON object
};

/// What the writer does not know yet.
struct PendingTrace {
  std::vector<TracedThread*> threads;
  std::vector<std::string> names;  ///< JSON; they have the next numbers
  std::vector<TraceSpan> spans;
  std::uint64_t lost_spans = 0;
};

/// "simulated_s":0.050000000
void AppendSimulatedTime(Time time, std::string& json);

/// Makes events of a trace file of what has been noted. Threads: one at a time.
class TraceWriter {
 public:
  TraceWriter(TraceFile file, const std::string& application, bool is_simulated);

  /// Writes down what has been noted so far. What is noted of something whose name comes with later pending
  /// waits for them.
  void Write(PendingTrace pending);
  /// The end. Errors: what could not be written.
  Result<TraceSummary> Finish();

 private:
  // A fault whose message has not come to its end yet.
  struct OpenFault {
    Time when;
    std::string element;  // JSON
    std::string message;
  };
  struct KnownThread {
    TracedThread* thread;
    int track;
    std::optional<OpenFault> fault = {};
  };

  void Introduce(TracedThread& thread);
  void WriteEvents(KnownThread& known);
  void WriteEvent(KnownThread& known, const TraceEvent& event);
  void WriteCycle(const KnownThread& known, const TraceEvent& event);
  void CloseFault(KnownThread& known);
  void TellOfLost(int track, std::uint64_t lost);

  TraceFile file_;
  const bool is_simulated_;
  std::vector<KnownThread> threads_;
  std::vector<std::string> names_;
  std::uint64_t lost_ = 0;
  std::string name_;       // of the event that is being written
  std::string arguments_;  // the same
};

}  // namespace runnel::internal
