#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/element/runtime.h"
#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/types/type_of.h"
#include "plugins/recording/recorder.h"
#include "plugins/recording/recording_names.h"
#include "plugins/scheduling/scheduler.h"
#include "tests/plugins/mcap/mcap_fixture.h"

namespace runnel::test {

/// Travels in buffers, since it owns memory.
struct Sample {
  std::vector<double> values;
  std::string name;
};
inline void Describe(TypeBuilder<Sample>& type) {
  type.Name("test::Sample").Field("values", &Sample::values).Field("name", &Sample::name);
}

struct Secret {
  int number = 0;
};
inline void Describe(TypeBuilder<Secret>& type) { type.Name("test::Secret"); }

/// Counts its cycles; what it publishes depends on all of them.
class Source final : public Module {
 public:
  using Module::Module;
  Output<double> number{this, "number", {.unit = "rad"}};
  Output<Sample> sample{this, "sample"};
  Output<Secret> secret{this, "secret"};
  double factor = 0.1;

 private:
  void Update() override {
    state_ = 3.9 * factor * state_ * (1 - state_) + 0.1 / ++count_;
    number.Publish(state_);
    auto loan = sample.Loan();
    loan->values.assign(static_cast<std::size_t>(count_ % 5), state_ / 3);
    loan->name = "n" + std::to_string(count_);
    sample.Publish(std::move(loan));
    secret.Publish(Secret{count_});
  }
  double state_ = 0.3;
  int count_ = 0;
};

/// Reads what the source publishes, in the same cycle, and keeps a state over all of it.
class Sink final : public Module {
 public:
  using Module::Module;
  Input<double> number{this, "number"};
  Input<Sample> sample{this, "sample"};
  Output<double> sum{this, "sum"};

 private:
  void Update() override {
    if (const auto read = number.Read(); read.is_new()) total_ += *read / 7;
    if (const auto read = sample.Read()) total_ += static_cast<double>(read->values.size()) * 1e-3;
    sum.Publish(total_);
  }
  double total_ = 0;
};

/// A simulated application of the two, which is recorded into a folder of the test's own.
class RecordingTest : public McapTest {
 protected:
  struct Application {
    Application() {
      CreateThread(runtime, "main", {.period = std::chrono::milliseconds(10)});
      source = &runtime.Create<Source>(runtime.root(), "source");
      sink = &runtime.Create<Sink>(runtime.root(), "sink");
      Must(Port::Connect(source->number, sink->number));
      Must(Port::Connect(source->sample, sink->sample));
      Must(runtime.MakeReady(runtime.root()));
    }
    void Run(Duration duration) { scheduler.RunUntil(runtime.clock().Now() + duration); }

    Runtime runtime;
    Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
    Source* source;
    Sink* sink;
  };

  /// Records what fits while an application runs for so long.
  std::string Record(const std::string& name, Application& application, Duration duration,
                     std::vector<std::string> ports = {}) {
    auto recorder = Must(
        Recorder::Start(application.runtime, &application.scheduler, {.file = Path(name), .ports = std::move(ports)}));
    application.Run(duration);
    Must(recorder->Finish());
    EXPECT_EQ(recorder->status().dropped, 0u);
    return Path(name);
  }
  /// "time json" of each value of a port.
  [[nodiscard]] static std::vector<std::string> ValuesOf(const std::string& file, const std::string& path) {
    auto reader = Must(McapReader::Open(file));
    std::vector<std::string> values;
    Must(reader->ReadMessages([&](const McapMessage& message) -> Result<void> {
      const McapChannel& channel = reader->contents().channels.at(message.channel);
      if (!IsView(channel) && PortOf(channel) == path) {
        values.push_back(std::to_string(message.log_time) + " " + std::string(message.data));
      }
      return {};
    }));
    return values;
  }
};

}  // namespace runnel::test
