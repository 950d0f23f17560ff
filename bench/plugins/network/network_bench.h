#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/types/shared_vector_types.h"
#include "plugins/network/network_link.h"
#include "plugins/wire_cyclone/cyclone_wire.h"
#include "plugins/wire_shared_memory/shared_memory_wire.h"

namespace runnel {

/// 128 B.
struct Block {
  std::array<double, 16> values;
};
inline void Describe(TypeBuilder<Block>& type) { type.Name("bench::Block").Field("values", &Block::values); }

/// As the image of a camera: a list of numbers.
struct Picture {
  double sent = 0;
  SharedVector<std::uint8_t> data;
};
inline void Describe(TypeBuilder<Picture>& type) {
  type.Name("bench::Picture").Field("sent", &Picture::sent).Field("data", &Picture::data);
}

inline constexpr std::size_t kPicture = 1920 * 1080 * 3;

/// Seconds by a clock that all processes have.
[[nodiscard]] inline double Now() { return ToSeconds(SteadyClock().Now()); }
/// Of this process until now, in seconds.
[[nodiscard]] double ProcessorTime();

/// How many values, how often; without a period as fast as it goes, for a second.
struct Load {
  int count;
  std::chrono::microseconds period;
  bool is_even = true;  ///< false: at intervals from half of the period to one and a half, as they like
};

/// What has been measured of one writing and one reading process.
struct Figures {
  double p50 = 0;  // s, one way
  double p99 = 0;
  double processor_writing = 0;  // s a value that has arrived
  double processor_reading = 0;
  double sent = 0;
  double arrived = 0;
  double rate = 0;  // of those that have arrived, 1/s
};

/// What is sent and noted by the processes of one measurement, in memory that they share.
class Course {
 public:
  explicit Course(const Load& load) : load_(load) {}

  /// By the writing process, once it has found the other: calls `send` as often as the load says.
  void Write(const std::function<void()>& send);
  /// By the reading process, for each value that has come.
  void Note(double sent);
  /// By the reading process: until no more comes.
  void WaitForEnd();
  [[nodiscard]] Figures figures() const;

 private:
  static constexpr std::size_t kMost = 1 << 20;

  const Load load_;
  std::atomic<bool> has_ended_{false};
  std::atomic<std::size_t> count_{0};
  double sent_ = 0;
  double processor_writing_ = 0;
  double processor_reading_ = 0;
  double first_ = 0;
  double last_ = 0;
  std::array<float, kMost> latencies_;  // s
};

/// Runs both in processes of their own, by the same course.
[[nodiscard]] Figures Measure(const Load& load, const std::function<void(Course&)>& read,
                              const std::function<void(Course&)>& write);

/// The engine alone, by the seam of octets.
[[nodiscard]] Figures MeasureEngine(const Load& load, std::size_t size);
/// From port to port.
[[nodiscard]] Figures MeasureBlocks(const Load& load, ValueQuality quality, ValueSending sending);
[[nodiscard]] Figures MeasurePictures(const Load& load, bool has_shared_memory = true);

/// What it costs to publish through a port that is offered, read by nobody, and by another process.
void PrintPublishing();
/// How long it takes until `count` ports of an application are known to another one, and what memory they need.
void PrintMany(int count);
/// How soon two find one another; how long it takes until `count` know each other, and what memory they need.
void PrintDiscovery(int starts);
void PrintCrowd(int count);

/// An application with one element.
template <typename Element>
struct Application {
  Runtime runtime;
  Group& group = runtime.Create<Group>(runtime.root(), "application");
  Element& element = runtime.Create<Element>(group, "element");
  std::shared_ptr<WireEngine> engine = MakeSharedMemoryWire(MakeCycloneWire());
  NetworkElement* network = nullptr;
  std::unique_ptr<NetworkLink> link;

  void Begin(NetworkOptions options, Port* taken) {
    network = &runtime.Create<NetworkElement>(group, "network", std::move(options));
    if (taken != nullptr) (void)Port::Connect(**network->AddTake({.topic = "/values"}, taken->type()), *taken);
    (void)runtime.MakeReady(runtime.root());
    link = std::move(*NetworkLink::Start(group, *network, *engine, false));
  }
};

template <typename T>
class Sender final : public FrameworkElement {
 public:
  explicit Sender(const Placement& placement) : FrameworkElement(placement) {}
  Output<T> output{*this, "output"};
};

template <typename T>
class Receiver final : public FrameworkElement {
 public:
  explicit Receiver(const Placement& placement) : FrameworkElement(placement) {}
  Input<T> input{*this, "input"};
};

}  // namespace runnel
