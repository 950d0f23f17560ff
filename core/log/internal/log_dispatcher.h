#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/log/log_level.h"
#include "core/log/log_sink.h"
#include "core/log/logger.h"

namespace runnel {

class Runtime;

namespace internal {

/// Who stands between the rings of all threads and the sinks of all runtimes of the process.
///
/// Threads: any; locks. `reading_` comes before `listing_`.
class LogDispatcher {
 public:
  [[nodiscard]] static LogDispatcher& OfProcess();

  void Add(Logger& logger);
  /// Hands on what it has said first, if it has said something.
  void Remove(Logger& logger, bool has_spoken) noexcept;
  /// `sink` is who the entry is removed by.
  void Add(const LogSink& sink, Runtime& runtime, std::function<void(const LogMessage&)> receive);
  void Remove(const LogSink& sink) noexcept;

  void SetLevel(Runtime& runtime, std::string path, LogLevel level);
  bool ResetLevel(Runtime& runtime, const std::string& path);
  [[nodiscard]] LogLevels Levels(const Runtime& runtime);
  void ForgetLevels(const Runtime& runtime) noexcept;

  void Flush();

 private:
  using LevelOfPath = std::map<std::string, LogLevel, std::less<>>;
  struct Sink {
    const LogSink* owner;
    const Runtime* runtime;
    std::function<void(const LogMessage&)> receive;
  };
  struct Pending {
    const Runtime* runtime;
    LogMessage message;
  };

  LogDispatcher() = default;
  // With reading_ locked.
  void HandOn() noexcept;
  void Show(const Pending& pending);
  [[nodiscard]] std::vector<Pending> Collect();
  void Run(const std::stop_token& stop);
  // Both with listing_ locked.
  [[nodiscard]] LogLevel LowestFor(const Logger& logger) const;
  void SetAll(const Runtime& runtime) noexcept;

  std::mutex reading_;
  std::vector<Sink> sinks_;
  std::uint64_t lost_ = 0;  // and not yet told
  std::mutex listing_;      // a leaf
  Logger* first_ = nullptr;
  std::map<const Runtime*, LevelOfPath> levels_;
  std::condition_variable_any wake_;
  std::jthread thread_;  // the last member: ends first
};

}  // namespace internal
}  // namespace runnel
