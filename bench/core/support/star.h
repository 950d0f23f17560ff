#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/element/runtime.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/cycle.h"
#include "core/port/input.h"
#include "core/port/output.h"

namespace runnel::bench {

/// What an executor does once for all modules of a cycle.
struct InACycle {
  EpochGuard guard;
  CycleScope scope{Cycle{}};
};

inline void MustSucceed(const Result<void>& result) {
  if (!result) throw std::runtime_error(result.error().ToString());
}

/// An element to hang a port below.
class Node : public FrameworkElement {
 public:
  explicit Node(const Placement& placement) : FrameworkElement(placement) {}
};

template <typename T>
class Sender final : public Node {
 public:
  explicit Sender(const Placement& placement, OutputOptions options = {})
      : Node(placement), out(*this, "out", std::move(options)) {}
  Output<T> out;
};

template <typename T>
class Receiver final : public Node {
 public:
  explicit Receiver(const Placement& placement) : Node(placement), in(*this, "in") {}
  Input<T> in;
};

/// One output connected to `count` inputs.
template <typename T>
class Star {
 public:
  explicit Star(std::size_t count, const ConnectOptions& connection = {}, OutputOptions options = {})
      : sender_(runtime_.Create<Sender<T>>(runtime_.root(), "sender", std::move(options))) {
    for (std::size_t i = 0; i < count; ++i) {
      inputs_.push_back(&runtime_.Create<Receiver<T>>(runtime_.root(), "receiver" + std::to_string(i)).in);
      MustSucceed(Port::Connect(output(), *inputs_.back(), connection));
    }
  }

  [[nodiscard]] Runtime& runtime() noexcept { return runtime_; }
  [[nodiscard]] Output<T>& output() noexcept { return sender_.out; }
  [[nodiscard]] Input<T>& input(std::size_t i) noexcept { return *inputs_.at(i); }
  [[nodiscard]] std::size_t size() const noexcept { return inputs_.size(); }

 private:
  Runtime runtime_;
  Sender<T>& sender_;
  std::vector<Input<T>*> inputs_;
};

}  // namespace runnel::bench
