#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/module/executable.h"
#include "core/port/port.h"
#include "plugins/mcap/mcap_reader.h"
#include "plugins/recording/played_values.h"
#include "plugins/structure/change.h"
#include "plugins/values/port_patterns.h"

namespace runnel {

/// Makes the calls again that came from outside of the application while it was recorded, by terminals, pages, other
/// programs: each in the cycle in which its service began to serve it. Activities that were asked to end are asked in
/// the cycle in which that took effect. What comes of the calls nobody waits for.
///
/// Threads: as Player.
class PlayedCalls {
 public:
  PlayedCalls();
  ~PlayedCalls();

  /// `records`: the port NAME_calls beside a service, in this channel of the recording. False: there is no service.
  bool Add(Port& records, std::uint16_t channel);
  /// All calls between these times of the recording's clock. Errors: what was recorded cannot be read.
  Result<void> Read(McapReader& reader, Time from, Time to);
  /// In front of the tasks of the modules that serve, but of those that do not run.
  void WrapTasks(const std::function<bool(const FrameworkElement& module)>& runs);
  /// From the recording's clock to the application's.
  void Start(Duration offset) noexcept { offset_ = offset; }

  /// How many are made again.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  struct Service;
  class OfModule;

  std::map<std::uint16_t, Service> services_;  // by channels
  std::vector<std::unique_ptr<OfModule>> modules_;
  Duration offset_{};
  std::size_t size_ = 0;
};

struct PlayerOptions {
  std::vector<std::string> ports = {};  ///< see PortPatterns; none: all that are recorded
  std::optional<Duration> from = {};    ///< since the recording's start
  std::optional<Duration> to = {};
  bool loops = false;
};

/// Publishes what was recorded, in the place of what was recorded: in the place of the task of the module
/// that used to publish there, in its place in the cycle, the player publishes the recorded values. So everything
/// that reads them runs as it did: on a simulated clock, replaying what a module read into the same
/// application gives what it published, bit for bit.
///
/// A task of which all that anybody reads is played does not run itself. Others run on: an output of the
/// player takes over the connections of each played port, and what the module publishes there nobody reads.
/// Modules that judge the run always run. Those that run serve the calls again that came from outside (PlayedCalls).
///
///     auto player = Player::Prepare(runtime, std::move(reader), {.ports = {"laser/scan"}});
///     (*player)->Start(clock.Now());   // before the first cycle
///
/// Values bear the time that they were recorded with, moved by the time between the start of the recording
/// and Start(): on a clock that starts as the recording's did, the very same. A value is published in the
/// first cycle at or after its time.
///
/// Ownership:  of the file. Outlives the scheduler's running; the runtime outlives it.
/// Threads:    Prepare() and Start() while nothing runs. Played values are read from the file by the cycle
///             that needs them.
/// Errors:     Prepare(): nothing that fits is there, types that differ. Later: a value that cannot be read
///             ends the playing, see failure().
class Player {
 public:
  static Result<std::unique_ptr<Player>> Prepare(Runtime& runtime, std::unique_ptr<McapReader> reader,
                                                 const PlayerOptions& options);
  ~Player();

  /// The values begin at `now` of the application's clock.
  void Start(Time now) {
    values_->Start(now);
    calls_.Start(now - values_->start());
  }
  /// Where the recording begins on its own clock, at `from`; for clocks that can be set.
  [[nodiscard]] Time start() const noexcept { return values_->start(); }
  /// From the first to the last value that is played, once.
  [[nodiscard]] Duration length() const noexcept { return values_->end() - values_->start(); }

  [[nodiscard]] std::size_t ports() const noexcept { return played_.size(); }
  [[nodiscard]] std::size_t calls() const noexcept { return calls_.size(); }
  /// Recorded ports that fit but are not in the application.
  [[nodiscard]] const std::vector<std::string>& missing() const noexcept { return missing_; }
  [[nodiscard]] std::uint64_t published() const noexcept { return published_.load(std::memory_order_relaxed); }
  /// All has been published, and it does not loop; or it has failed.
  [[nodiscard]] bool is_over() const noexcept { return values_->is_over(); }
  [[nodiscard]] std::optional<Error> failure() const { return values_->failure(); }

 private:
  class PlayedTask;
  struct PlayedPort;

  Player(Runtime& runtime, std::unique_ptr<PlayedValues> values);
  Result<void> FindPorts(const PortPatterns& patterns);
  Result<void> FindCalls(const PortPatterns& patterns);
  Result<void> CheckType(const Port& port, const McapChannel& channel) const;
  // What a file that is saved meanwhile has of the ports that are played by others.
  [[nodiscard]] ChangeSet Connections() const;
  // A group of outputs that stand where those of `ports` stood.
  FrameworkElement& TakePlaces(const std::vector<PlayedPort*>& ports);
  void WrapTasks();
  [[nodiscard]] bool IsReadUnplayed(const Task& task) const;
  void WrapTasksOf(FrameworkElement& module, const std::vector<PlayedPort*>& ports);
  void Publish(const std::vector<PlayedPort*>& ports);
  void DoNothing() {}

  Runtime& runtime_;
  std::unique_ptr<PlayedValues> values_;
  FrameworkElement* element_ = nullptr;
  std::vector<std::unique_ptr<PlayedPort>> played_;
  std::shared_ptr<const Player* const> self_ = std::make_shared<const Player* const>(this);  // for who may outlive it
  std::vector<std::unique_ptr<PlayedTask>> tasks_;
  std::set<const FrameworkElement*> resting_;  // modules that do not run
  PlayedCalls calls_;
  std::vector<std::string> missing_;
  std::atomic<std::uint64_t> published_{0};
};

}  // namespace runnel
