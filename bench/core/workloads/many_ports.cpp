// What ports cost while nothing flows: memory of an idle port and of a connection, and how long it
// takes to make them, with 10 to 100,000 ports in one runtime. Ports come by the ten (five inputs,
// five outputs of type double) in an element, elements by the hundred in a group; what these take
// is counted in, a tenth of an element for each port.

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <malloc.h>

#include "bench/core/support/star.h"
#include "bench/core/workloads/workloads.h"
#include "core/module/group.h"

namespace runnel::bench {

namespace {

constexpr std::size_t kPortsOfANode = 10;
constexpr std::size_t kNodesOfAGroup = 100;

class FiveInFiveOut final : public Node {
 public:
  using Node::Node;
  std::array<Input<double>, 5> inputs = {Input<double>(*this, "in0"), Input<double>(*this, "in1"),
                                         Input<double>(*this, "in2"), Input<double>(*this, "in3"),
                                         Input<double>(*this, "in4")};
  std::array<Output<double>, 5> outputs = {Output<double>(*this, "out0"), Output<double>(*this, "out1"),
                                           Output<double>(*this, "out2"), Output<double>(*this, "out3"),
                                           Output<double>(*this, "out4")};
};

double HeapBytes() {
  const auto heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}

double NanosecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

std::vector<FiveInFiveOut*> MakeNodes(Runtime& runtime, std::size_t count) {
  std::vector<FiveInFiveOut*> nodes;
  FrameworkElement* group = nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kNodesOfAGroup == 0) {
      group = &runtime.Create<Group>(runtime.root(), "group" + std::to_string(i / kNodesOfAGroup));
    }
    nodes.push_back(&runtime.Create<FiveInFiveOut>(*group, "node" + std::to_string(i)));
  }
  return nodes;
}

// Each node's outputs to the next one's inputs.
std::size_t Connect(const std::vector<FiveInFiveOut*>& nodes) {
  std::size_t connections = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    FiveInFiveOut& next = *nodes[(i + 1) % nodes.size()];
    for (std::size_t k = 0; k < next.inputs.size(); ++k, ++connections) {
      MustSucceed(Port::Connect(nodes[i]->outputs[k], next.inputs[k]));
    }
  }
  return connections;
}

void RunPorts(benchmark::State& state, std::size_t ports) {
  using Clock = std::chrono::steady_clock;
  std::optional<Runtime> runtime;
  for (auto _ : state) {
    const double heap_before = HeapBytes();
    runtime.emplace();
    const auto made_from = Clock::now();
    const auto nodes = MakeNodes(*runtime, ports / kPortsOfANode);
    state.counters["port, time"] = NanosecondsSince(made_from) / static_cast<double>(ports);
    const double heap_idle = HeapBytes();
    state.counters["port, memory"] = (heap_idle - heap_before) / static_cast<double>(ports);
    const auto connected_from = Clock::now();
    const auto connections = static_cast<double>(Connect(nodes));
    state.counters["connection, time"] = NanosecondsSince(connected_from) / connections;
    state.counters["connection, memory"] = (HeapBytes() - heap_idle) / connections;
  }
}

}  // namespace

void AddManyPorts(Suite& suite) {
  for (const std::size_t ports : {10u, 1000u, 100'000u}) {
    suite.Start({.name = std::to_string(ports) + " ports, idle",
                 .quantities = {{"port, memory", "B"},
                                {"port, time", "ns"},
                                {"connection, memory", "B"},
                                {"connection, time", "ns"}},
                 .family = "ports in a runtime",
                 .axis = "ports",
                 .position = static_cast<double>(ports)});
    suite.Add(Role::kRunnel, "Input, Output", [ports](benchmark::State& state) { RunPorts(state, ports); })
        ->Iterations(1);
  }
}

}  // namespace runnel::bench
