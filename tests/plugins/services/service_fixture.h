#pragma once

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "plugins/services/client.h"
#include "plugins/services/service.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {

/// Doubles numbers, says errors, throws.
class Server : public Module {
 public:
  using Module::Module;
  Service<int(int)> twice{this, "twice", &Server::Twice, {.description = "doubles", .queue = 4}};
  Service<std::string(std::string, int)> repeat{this, "repeat", &Server::Repeat, {.arguments = {"text", "times"}}};
  Service<void()> reset{this, "reset", &Server::Reset};

  int served = 0;
  bool throws_in_update = false;

 protected:
  Result<int> Twice(int value) {
    if (value < 0) return Error{.message = "is negative"};
    if (value > 1000) throw std::runtime_error("is too much");
    ++served;
    return factor() * value;
  }
  [[nodiscard]] virtual int factor() const { return 2; }

 private:
  static std::string Repeat(Server&, const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
  }
  void Reset() { served = 0; }
  void Update() override {
    if (throws_in_update) throw std::runtime_error("is broken");
  }
};

class TripleServer final : public Server {
 public:
  using Server::Server;

 private:
  [[nodiscard]] int factor() const override { return 3; }
};

/// Notes what it is told.
class Asker final : public Module {
 public:
  using Module::Module;
  Client<int(int)> twice{this, "twice", {.calls = 8, .timeout = 100ms}};
  Client<std::string(std::string, int)> repeat{this, "repeat"};
  Client<void()> reset{this, "reset"};

  CallStatus Ask(int value) {
    return twice.Call([this](const CallOutcome<int>& outcome) { Note(outcome); }, value);
  }
  std::function<void(Asker&)> action = [](Asker&) {};
  std::vector<std::string> told;

 private:
  void Note(const CallOutcome<int>& outcome) {
    told.push_back(outcome ? std::to_string(*outcome)
                           : CallStatusName(outcome.status()) + std::string(": ") + std::string(outcome.error()));
  }
  void Update() override { action(*this); }
};

class ServiceTest : public EditorTest {
 protected:
  ServiceTest() {
    Register<Server>("test/server");
    Register<TripleServer>("test/triple_server");
    Register<Asker>("test/asker");
    Must({CreateModule{"/app/server", "test/server"}, CreateModule{"/app/asker", "test/asker"},
          ConnectPorts{"/app/server/twice", "/app/asker/twice"},
          ConnectPorts{"/app/server/repeat", "/app/asker/repeat"},
          ConnectPorts{"/app/server/reset", "/app/asker/reset"}});
  }
  Server& server() { return At<Server>("/app/server"); }
  Asker& asker() { return At<Asker>("/app/asker"); }
};

}  // namespace runnel::test
