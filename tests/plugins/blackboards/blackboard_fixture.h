#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "plugins/blackboards/blackboard.h"
#include "plugins/blackboards/blackboard_writer.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {

using Cells = std::vector<int>;

class MapOwner final : public Module {
 public:
  using Module::Module;
  Blackboard<Cells> map{this, "map", Cells(10, 0), {.queue = 8, .journal = 4}};

 private:
  void Update() override {}
};

class MapUser final : public Module {
 public:
  using Module::Module;
  BlackboardWriter<Cells> map{this, "map"};
  std::function<void(MapUser&)> action = [](MapUser&) {};
  std::vector<std::string> told;

  CallStatus Set(std::uint64_t index, int value) {
    auto transaction = map.Begin();
    transaction.change().push_back({index, value});
    return transaction.Commit([this](const auto& outcome) { Note(outcome); });
  }
  [[nodiscard]] Cells Seen() {
    const auto read = map.value().Peek();
    return read ? *read : Cells();
  }

 private:
  void Note(const BlackboardWriter<Cells>::Outcome& outcome) {
    told.push_back(outcome ? (outcome->is_applied ? "applied " : "not applied ") + std::to_string(outcome->revision)
                           : std::string(outcome.error()));
  }
  void Update() override { action(*this); }
};

class BlackboardTest : public EditorTest {
 protected:
  explicit BlackboardTest(SchedulerOptions::ClockKind clock = SchedulerOptions::ClockKind::kSimulated)
      : EditorTest(clock) {
    Register<MapOwner>("test/map_owner");
    Register<MapUser>("test/map_user");
    Must({CreateModule{"/app/owner", "test/map_owner"}});
    AddUser("user");
  }
  void AddUser(const std::string& name) {
    Must({CreateModule{"/app/" + name, "test/map_user"}, ConnectPorts{"/app/owner/map", "/app/" + name + "/map"},
          ConnectPorts{"/app/owner/map_changes", "/app/" + name + "/map_changes"}});
  }
  Blackboard<Cells>& board() { return At<MapOwner>("/app/owner").map; }
  MapUser& user(const std::string& name = "user") { return At<MapUser>("/app/" + name); }
};

}  // namespace runnel::test
