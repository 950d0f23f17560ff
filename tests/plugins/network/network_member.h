#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/log/log_sink.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/types/shared_vector_types.h"
#include "core/types/type_builder.h"
#include "plugins/network/network_link.h"
#include "tests/support/fake_wire.h"
#include "tests/support/wait_until.h"

namespace runnel::test {

struct Place {
  double x = 0;
  double y = 0;
};
inline void Describe(TypeBuilder<Place>& type) {
  type.Name("test::Place").Field("x", &Place::x, {.unit = "m"}).Field("y", &Place::y, {.unit = "m"});
}

/// Too large to be copied in a queue, so that values are leased.
struct Row {
  SharedVector<double> values;
};
inline void Describe(TypeBuilder<Row>& type) { type.Name("test::Row").Field("values", &Row::values); }

class Module1 final : public Module {
 public:
  using Module::Module;
  Output<Place> place{this, "place"};
  Output<Row> row{this, "row"};
  Input<Place> goal{this, "goal"};
  Input<Row> wanted{this, "wanted"};
  std::function<void(Module1&)> action = [](Module1&) {};

 private:
  void Update() override { action(*this); }
};

template <typename T>
T Must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().ToString());
  return std::move(*result);
}

/// An application with one module.
class Member {
 public:
  Member(WireEngine& engine, const std::string& name) : engine_(engine), name_(name) {
    (void)runtime.MakeReady(runtime.root());
  }
  ~Member() { link_.reset(); }

  void Offer(OfferOptions offer) { options_.offers.push_back(std::move(offer)); }
  /// "/topic" to the module's input.
  void Take(TakeOptions take, Port& to) { takes_.emplace_back(std::move(take), &to); }
  /// What others may have done here.
  void Allow(std::vector<std::string> commands) { options_.commands = std::move(commands); }
  void Begin(bool is_simulated = false) {
    options_.member.name = name_;
    network = &runtime.Create<NetworkElement>(group, "network", options_);
    for (const auto& [take, to] : takes_) {
      Port* const output = Must(network->AddTake(take, to->type()));
      if (const auto connected = Port::Connect(*output, *to); !connected)
        throw std::runtime_error(connected.error().ToString());
    }
    (void)runtime.MakeReady(runtime.root());
    link_ = Must(NetworkLink::Start(group, *network, engine_, is_simulated, [this] { return structure; }));
  }
  void End() { link_.reset(); }
  [[nodiscard]] NetworkLink& link() { return *link_; }
  [[nodiscard]] std::string Text() const { return link_->Text(); }
  [[nodiscard]] auto StructureOf(const std::string& path) const { return link_->StructureOf(path); }
  [[nodiscard]] std::string said() {
    FlushLog();
    const std::lock_guard lock(mutex_);
    return said_;
  }
  void WaitFor(const std::string& text) {
    WaitUntil("it says " + text, [&] { return said().find(text) != std::string::npos; });
  }

  std::string structure;  // before Begin()
  Runtime runtime;
  Group& group = runtime.Create<Group>(runtime.root(), name_of_group());
  Module1& module = runtime.Create<Module1>(group, "module");
  NetworkElement* network = nullptr;

 private:
  static std::string name_of_group() { return "application"; }

  std::mutex mutex_;
  std::string said_;
  LogSink sink_{runtime, [this](const LogMessage& message) {
                  const std::lock_guard lock(mutex_);
                  said_ += message.text + "\n";
                }};
  WireEngine& engine_;
  const std::string name_;
  NetworkOptions options_;
  std::vector<std::pair<TakeOptions, Port*>> takes_;
  std::unique_ptr<NetworkLink> link_;
};

/// The network's thread connects it meanwhile.
inline bool IsConnected(const Port& output) {
  const std::lock_guard lock(output.runtime().structure_mutex());
  return !output.outgoing().empty();
}

}  // namespace runnel::test
