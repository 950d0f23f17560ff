#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plugins/command_service/command_service.h"

namespace runnel {

/// A change set on its way through the worker: applied at the first step; at the following ones new
/// modules that have taken the place of others are looked after until they have proved themselves. Fills
/// the answer in.
///
/// Threads:  the worker's. Copies share the work.
class ChangeTask {
 public:
  ChangeTask(ChangeRequest request, const ServedApplication& application,
             std::shared_ptr<CommandAnswer> answer);
  /// As TaskStep.
  std::optional<Duration> operator()() { return state_->Step(); }

 private:
  // A replaced module, to find out whether the new one is still there a moment later.
  struct Swap {
    std::string path;
    std::uint64_t before = 0;  // id of the old one
    bool is_back = false;
  };

  struct State {
    std::optional<Duration> Step();
    void Apply();
    void FindSwaps();
    void LookAfterProbation();
    [[nodiscard]] bool IsOver() const;
    void Conclude();

    ChangeRequest request;
    const ServedApplication& application;
    const std::shared_ptr<CommandAnswer> answer;
    std::vector<Swap> swaps = {};
    bool has_begun = false;
    bool is_on_probation = false;
    bool has_proved = false;
    std::chrono::steady_clock::time_point until{};  // when the wait for the proof is given up
    Duration look_again{};
  };

  const std::shared_ptr<State> state_;
};

}  // namespace runnel
