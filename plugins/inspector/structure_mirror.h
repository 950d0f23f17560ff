#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/element/framework_element.h"
#include "core/element/runtime.h"
#include "core/plugin/module_registry.h"
#include "core/port/port.h"
#include "plugins/command_service/application_log.h"
#include "plugins/command_service/structure_walk.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/values/watched_port.h"

namespace runnel::internal {

/// What there is to know of elements besides themselves.
struct ElementSurroundings {
  const ModuleRegistry* modules = nullptr;                ///< their summaries
  const Scheduler* scheduler = nullptr;                   ///< who says which modules are stuck
  std::map<std::uint64_t, std::string> thread_names;      ///< by id
  std::uint64_t default_thread = 0;                       ///< for what is assigned to none
  std::unordered_map<std::uint64_t, std::string> failed;  ///< modules, and what they threw
  std::vector<std::string> paused;                        ///< paths of elements, of threads
};

/// The element as the protocol has it: {"path":…,"kind":…,…}. Under the structure lock.
[[nodiscard]] std::string ElementJson(const FrameworkElement& element, const ElementSurroundings& around);

/// {"from":…,"to":…,…}. Under the structure lock.
[[nodiscard]] std::string ConnectionJson(const Connection& connection);

/// What counts can be read of: the outputs that publish, and the threads.
struct MeteredElements {
  std::vector<std::string> ports;    ///< paths
  std::vector<std::string> threads;  ///< paths
};

/// The counts at one moment.
struct CountSample {
  std::shared_ptr<const MeteredElements> of;
  std::vector<Publications> publications;
  std::vector<CycleStatistics> threads;
  Time time{};  ///< on the application's clock
};

/// What has been published and run between two samples of the same elements, as the protocol has it.
/// `told`: the rates that were told last, of which only other ones are told; kept up to date.
struct ToldRate {
  static constexpr double kNever = -1;
  PublicationRate rate = {};
  double told = kNever;
};
[[nodiscard]] std::string RateMessage(const CountSample& before, const CountSample& now, double time,
                                      std::vector<ToldRate>& told);

/// What has been measured of modules, as the protocol has it; `measured`: for how long, if it is.
[[nodiscard]] std::string ProfileMessage(const Profile& profile, std::optional<Duration> measured);

/// The structure of an application as viewers have been told it, once for all of them: what has changed
/// since is found by walking through everything again whenever the structure has another revision; the
/// values of parameters, whose changes nobody announces, by looking at some of them in turn.
///
/// Threads:  the server's. Tries the structure lock, and holds it for 2 ms at a time.
class StructureMirror {
 public:
  StructureMirror(Runtime& runtime, const ModuleRegistry& modules, const Scheduler& scheduler,
                  const ApplicationLog& log);

  /// Looks on for a moment. True: what there is to see has been seen; false: come again soon.
  /// Throws what a type or the lack of memory throws; then everything is looked at and told anew.
  bool Look();
  /// Grows with each difference that Look() finds; 0: nothing has been seen yet.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  /// A message of the protocol with everything.
  [[nodiscard]] std::string Whole() const;
  /// The message that leads from the revision before to `revision`; nullptr if it is forgotten.
  [[nodiscard]] const std::string* ChangeTo(std::uint64_t revision) const;
  [[nodiscard]] std::size_t size() const noexcept { return order_.size(); }

  /// Nothing if the structure is locked or has just changed.
  [[nodiscard]] std::optional<CountSample> Count() const;

 private:
  // An element as viewers have been told it, with the connections that begin there.
  struct Entry {
    std::string path;
    std::string json;
    std::vector<std::string> connections;
    std::uint64_t walk = 0;  // the number of the one that has seen it last
  };
  struct Difference {
    std::vector<std::string> gone;      // paths
    std::vector<std::string> elements;  // these and all that follow: as JSON
    std::vector<std::string> connected;
    std::vector<std::string> disconnected;
  };
  // What a walk has found, to be told when it has come to its end.
  struct Findings {
    std::vector<std::uint64_t> order;
    std::vector<std::pair<std::uint64_t, Entry>> news;
    MeteredElements metered;
    std::vector<const Port*> ports;
    std::vector<const ThreadContainer*> threads;
    std::vector<const FrameworkElement*> parameters;
  };

  // All of the following under the structure lock.
  bool LookOn();
  void BeginWalk();
  void Visit(const FrameworkElement& element);
  [[nodiscard]] Entry Describe(const FrameworkElement& element) const;
  void SweepParameters();
  void NoteFaults();
  void NoteThreads();

  // Not under the lock.
  void FinishWalk();
  void Forget() noexcept;
  [[nodiscard]] Difference TakeNews();
  void Tell(Difference difference);

  Runtime& runtime_;
  const ApplicationLog& log_;
  std::uint64_t next_in_log_ = 0;
  ElementSurroundings around_;
  std::uint64_t revision_ = 0;
  std::deque<std::string> changes_;  // the newest leads to revision_

  std::unordered_map<std::uint64_t, Entry> entries_;  // by id
  std::vector<const Entry*> order_;                   // of the tree; of the entries above
  StructureWalk walk_;
  std::uint64_t walks_ = 0;
  Findings found_;  // valid while the walk is under way

  Findings seen_;  // of the walk before it; valid while that is current
  std::size_t next_parameter_ = 0;
  std::shared_ptr<const MeteredElements> metered_;
};

}  // namespace runnel::internal
