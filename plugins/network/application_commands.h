#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "plugins/command_service/command_service.h"
#include "plugins/network/network_link.h"

namespace runnel {

/// Changes that one application has another one make, where that one's file allows it: lines of the language of changes, of
/// which each answers by a text. "/<name>/runnel_commands" has a reader only in applications that allow something.
///
/// Threads:  Ask() under the structure lock; the rest, and destroying, by who made it. Changes are made by the worker of
///           the service, as those of terminals.
class ApplicationCommands {
 public:
  /// `service` and `link` must outlive it. Errors: of the engine.
  static Result<std::unique_ptr<ApplicationCommands>> Start(NetworkLink& link, NetworkElement& element, CommandService& service);
  ~ApplicationCommands();

  /// "set //robot/planner/cruise_speed 0.3": has robot set it. Nothing: it has not answered yet, and is to be asked again
  /// in the same words. Errors: what it says; it is not there; it does not allow it.
  Result<std::optional<std::string>> Ask(const std::string& change);

 private:
  /// One that has been asked, and what for.
  struct Question;
  /// One that is being carried out here.
  struct Errand {
    std::string id;
    std::string text;  // "//planner has it done: set …"
    std::unique_ptr<PendingCommand> command;
  };

  ApplicationCommands(NetworkLink& link, NetworkElement& element, CommandService& service)
      : link_(link), element_(element), application_(element.parent()->path()), service_(service), tasks_(service.worker()) {}
  void Hear(const std::string& message);
  void Reply(const std::string& id, const CommandAnswer& answer);
  void Tend();
  [[nodiscard]] bool IsKnown(const std::string& id);
  [[nodiscard]] std::optional<Error> WhyRefused(const ChangeSet& changes) const;

  NetworkLink& link_;
  NetworkElement& element_;
  const std::string application_;
  CommandService& service_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Question>> questions_;  // by their changes; guarded by mutex_
  std::uint64_t asked_ = 0;                                     // guarded by mutex_
  std::deque<Errand> errands_;                                  // guarded by mutex_
  std::mutex replying_;
  std::deque<std::string> told_;  // the last replies; guarded by replying_, as the writer is
  std::unique_ptr<WireWriter> replies_;
  std::unique_ptr<WireReader> reader_;
  TaskGroup tasks_;
};

}  // namespace runnel
