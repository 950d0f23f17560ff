#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace runnel {

/// What a trace has come to.
struct TraceSummary {
  std::uint64_t events = 0;    ///< in the file
  std::uint64_t lost = 0;      ///< as they came faster than they could be written down
  std::uint64_t left_out = 0;  ///< as the file was as long as it may be, or could not be written
};

/// A file in Chrome's trace event format, the array form of it, which Perfetto and chrome://tracing open:
///
///     [
///     {"ph":"X","pid":4711,"tid":2,"ts":12.345,"dur":1.002,"name":"cycle","cat":"cycle","args":{…}},
///     …
///     ]
///
/// It is whole after each Flush() but for the last bracket, which readers do not insist on: nothing is lost
/// of a program that is killed but what has not been flushed.
///
/// Threads: one at a time. Allocation: yes.
class TraceFile {
 public:
  /// Errors: the file cannot be made.
  static Result<TraceFile> Create(const std::string& file, std::uint64_t most_bytes);
  ~TraceFile();
  TraceFile(TraceFile&&) = default;
  TraceFile& operator=(TraceFile&&) = delete;

  /// Times count from now on.
  [[nodiscard]] Time start() const noexcept { return start_; }

  // One event each. `name` and the texts in `arguments` are JSON already; `arguments` is the inside of an
  // object, "" for none. All are left out and counted once the file is as long as it may be.

  /// What a process or thread is called: "process_name", "thread_name", "thread_sort_index".
  void AddName(int track, std::string_view what, std::string_view arguments);
  /// Something that took some time.
  void AddSlice(int track, std::string_view name, const char* category, Time began, Time ended,
                std::string_view arguments);
  /// Something that happened.
  void AddInstant(int track, std::string_view name, const char* category, Time when, std::string_view arguments);

  /// One end of an arrow, or a place that it passes: 's', 't' or 'f' (Chrome's phases). It goes from the slice that is
  /// there at its time to the next one of the same name and id.
  void AddArrow(int track, std::string_view name, char phase, Time when, std::string_view id);

  /// From now on the room may be used that was left for the last events.
  void UseReserve() noexcept { reserve_ = 0; }
  /// Writes down what has been added.
  void Flush();
  /// Flushes and closes. Errors: what could not be written, since the beginning.
  Result<void> Close();

  [[nodiscard]] std::uint64_t events() const noexcept { return events_; }
  /// That found no room in the file, or could not be written.
  [[nodiscard]] std::uint64_t left_out() const noexcept { return left_out_; }

 private:
  TraceFile(std::string name, std::FILE* file, std::uint64_t most_bytes);

  /// Whether there is room for an event. Appends what all have in common.
  bool Begin(char phase, int track, std::string_view name);
  void End(std::string_view arguments);
  void Write(std::string_view bytes);
  void Fail() { error_ = SystemError("the trace could not be written", name_); }

  std::string name_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  const std::uint64_t most_bytes_;
  const Time start_;
  const int process_;
  std::string text_;  // not written yet
  std::size_t events_in_text_ = 0;
  std::uint64_t reserve_ = 4096;
  std::uint64_t written_ = 0;
  std::uint64_t events_ = 0;
  std::uint64_t left_out_ = 0;
  std::optional<Error> error_;
};

}  // namespace runnel
