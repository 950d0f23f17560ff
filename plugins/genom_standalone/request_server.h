#pragma once

#include <list>
#include <memory>
#include <string>

#include "plugins/genom_execution/engine.h"
#include "plugins/genom_standalone/line_server.h"
#include "plugins/genom_standalone/standalone_component.h"
#include "plugins/genom_standalone/value_json.h"

namespace runnel::genom_standalone {

/// What clients say, line by line, and what they are answered.
///
/// Threads: one, that of the LineServer.
class RequestServer {
 public:
  /// `step` runs a stepped component by so many seconds, and returns its time; nullptr: has threads of its own.
  RequestServer(const StandaloneComponent& component, genom_execution::Engine& engine, LineServer& lines,
                std::function<double(double)> step);
  /// Preconditions: no request is under way.
  ~RequestServer() = default;
  RequestServer(const RequestServer&) = delete;
  RequestServer& operator=(const RequestServer&) = delete;

  void Take(LineServer::Client client, const std::string& line);
  void ClientIsGone(LineServer::Client client);
  /// Answers what has been accepted or done since.
  void Answer();

 private:
  struct Call {
    LineServer::Client client;
    Json as;
    std::size_t service;  // in the table; services.size(): abort
    std::unique_ptr<genom_execution::Request> request;
    bool is_accepted = false;  // and has been told so
  };
  Result<Json> Do(LineServer::Client client, const Json& line);
  Result<Json> Begin(LineServer::Client client, const Json& line);
  Result<void> Fill(const StandaloneService& service, void* data, const Json& with);
  Result<Json> Put(const Json& values);
  Result<Json> Get(const Json& name);
  [[nodiscard]] Result<StandalonePort*> FindPort(const std::string& name, bool is_to_be_made);
  [[nodiscard]] Json State();
  [[nodiscard]] Json Description() const;
  [[nodiscard]] Json Ending(const Call& call) const;
  [[nodiscard]] Result<std::size_t> FindService(const std::string& name) const;

  const StandaloneComponent& component_;
  genom_execution::Engine& engine_;
  LineServer& lines_;
  std::function<double(double)> step_;
  std::list<Call> calls_;
};

}  // namespace runnel::genom_standalone
