#pragma once

#include <functional>
#include <list>
#include <map>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "core/base/clock.h"
#include "core/base/file_descriptor.h"
#include "core/base/result.h"
#include "plugins/genom_execution/engine.h"
#include "plugins/genom_standalone/standalone_component.h"
#include "plugins/genom_standalone/value_type.h"

namespace runnel::genom_standalone {

using Json = nlohmann::ordered_json;
/// What clients say: finds its members by a tree, however many there are.
using Said = nlohmann::json;

/// Structs as objects, sequences as arrays, an optional without a value as null, a union as an object of what is set,
/// enumerators and texts as texts.
[[nodiscard]] Json ToJson(const ValueType& type, const void* value);

/// What is not said stays as it is. Errors: what is of another type, does not fit, or is unknown, with its path; parts may
/// have been set then.
[[nodiscard]] Result<void> FromJson(const ValueType& type, const Said& json, void* value, const std::string& path);
/// Errors: a member of a structure that is not optional is not there. Precondition: it is a value of the type.
[[nodiscard]] Result<void> CheckAllAreSaid(const ValueType& type, const Said& json, const std::string& path);

/// Lines of text between this process and clients at a Unix socket.
///
/// Threads: one, but Wake(), which any may call, also signal handlers.
class LineServer {
 public:
  using Client = int;

  LineServer();
  /// Ends all sessions, and removes the socket.
  ~LineServer();
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  /// Errors: the path cannot be had, or somebody listens there.
  [[nodiscard]] Result<void> Listen(const std::string& path);
  /// Until lines have come, or Wake() was called; each goes to `take`, without its end. Who says nothing more is listened to
  /// no longer, and has what `waits` says is still to be sent to it.
  void Serve(const std::function<void(Client, const std::string&)>& take, const std::function<void(Client)>& gone,
             const std::function<bool(Client)>& waits);
  /// To a client that is gone: to nobody.
  void Send(Client client, const std::string& line);
  /// What has been sent goes out, for a second at most.
  void Flush();
  void Wake() noexcept;

 private:
  struct Session {
    FileDescriptor socket;
    std::string received = {}, unsent = {};
    bool has_said_all = false;
  };
  void Accept();
  [[nodiscard]] bool Receive(Client client, Session& session);
  [[nodiscard]] bool SendMore(Client client, Session& session);

  std::string path_;
  FileDescriptor listening_, woken_;
  std::map<Client, Session> sessions_;
};

/// What clients say, line by line, and what they are answered.
///
/// Threads: one, that of the LineServer.
class RequestServer {
 public:
  /// `step` runs a stepped component by so much time, and returns its own, which begins with 0; nullptr: has threads of its own.
  RequestServer(const StandaloneComponent& component, genom_execution::Engine& engine, LineServer& lines,
                std::function<Time(Duration)> step);
  /// Preconditions: no request is under way.
  ~RequestServer() = default;
  RequestServer(const RequestServer&) = delete;
  RequestServer& operator=(const RequestServer&) = delete;

  void Take(LineServer::Client client, const std::string& line);
  void ClientIsGone(LineServer::Client client);
  /// Whether a call of the client is to be answered.
  [[nodiscard]] bool IsAwaitedBy(LineServer::Client client) const;
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
  void TakeObject(LineServer::Client client, const std::string& line);
  Result<Json> Do(LineServer::Client client, const Said& line);
  Result<Json> Begin(LineServer::Client client, const Said& line);
  Result<Json> Step(const Said& line);
  Result<void> Fill(const StandaloneService& service, void* data, const Said& with);
  Result<Json> Put(const Said& values);
  Result<Json> Get(const Said& name);
  /// Stays while it is used, though a codel closes it.
  [[nodiscard]] Result<std::shared_ptr<StandalonePort>> FindPort(const std::string& name, bool is_to_be_made);
  [[nodiscard]] Json State();
  [[nodiscard]] Json Description() const;
  [[nodiscard]] Json Ending(const Call& call) const;
  [[nodiscard]] Result<std::size_t> FindService(const std::string& name) const;

  const StandaloneComponent& component_;
  genom_execution::Engine& engine_;
  LineServer& lines_;
  std::function<Time(Duration)> step_;
  Time time_ = {};  // of a stepped component
  std::list<Call> calls_;
};

}  // namespace runnel::genom_standalone
