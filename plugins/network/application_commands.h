#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "plugins/command_service/command_service.h"
#include "plugins/network/network_link.h"
#include "plugins/ros_services/service_endpoints.h"

namespace runnel {

/// Changes that one application has another one make, where that one's file allows it: the service "/<name>/runnel_commands",
/// which takes a line of the language of changes and answers by a text. Only applications that allow something offer it.
///
/// A request is sent twice: the answer to the first one is a token, with which the second one is carried out, but for less
/// than half of the time for which whoever asks waits. So what has lain in the socket of a process that stood still is not done when that
/// process goes on. The token is a time of the clock of who gives it, so clocks need not agree.
///
/// Threads:  Ask() under the structure lock; the rest, and destroying, by who made it. Changes are made by the worker of
///           the service, as those of terminals.
class ApplicationCommands {
 public:
  /// `service` and `link` must outlive it. What the engine refuses is told by the log of `element`; nobody is served then.
  static std::unique_ptr<ApplicationCommands> Start(NetworkLink& link, NetworkElement& element,
                                                    CommandService& service);
  ~ApplicationCommands();

  /// "set //robot/planner/cruise_speed 0.3": has robot set it. Nothing: it has not answered yet, and is to be asked again,
  /// with the same `asking`; without that the request is taken back. Errors: what it says; it is not there; it does not allow it.
  Result<std::optional<std::string>> Ask(const std::string& change, std::shared_ptr<void>& asking);

 private:
  struct Question {
    std::unique_ptr<ServiceEndpoints> endpoints;
    std::string change;  // "set /planner/cruise_speed 0.3"
    Time begun;
    bool has_token = false;
  };
  /// What has been asked, as long as the asker waits and this one is there.
  struct Questions {
    std::mutex mutex;
    std::map<const void*, std::unique_ptr<Question>> open;  // by themselves
  };
  /// One that is being carried out here.
  struct Errand {
    CallId id;
    std::string text;  // "//planner has it done: set …"
    std::unique_ptr<PendingCommand> command;
  };

  ApplicationCommands(NetworkLink& link, NetworkElement& element, CommandService& service)
      : link_(link),
        element_(element),
        application_(element.parent()->path()),
        service_(service),
        tasks_(service.worker()) {}
  Result<std::unique_ptr<ServiceEndpoints>> Open(ServiceEndpoints::Side side, const std::string& name,
                                                 std::function<void()> on_news);
  Result<std::unique_ptr<Question>> Begin(const std::string& name, const std::string& path, const Change& change);
  Result<std::int64_t> Send(const Question& question, const std::string& whom);
  void Serve();
  void Begin(const ServiceMessage& request);
  void Reply(const CallId& id, const CommandAnswer& answer, const std::string& token = {});
  [[nodiscard]] std::optional<Error> WhyRefused(const ChangeSet& changes) const;

  NetworkLink& link_;
  NetworkElement& element_;
  const std::string application_;
  CommandService& service_;
  std::uint32_t opened_ = 0;
  const std::shared_ptr<Questions> questions_ = std::make_shared<Questions>();
  std::mutex mutex_;
  std::unique_ptr<ServiceEndpoints> offered_;  // guarded by mutex_, as the rest
  std::deque<CallId> known_;                   // the last that have come
  std::deque<Errand> errands_;
  TaskGroup tasks_;
};

}  // namespace runnel
