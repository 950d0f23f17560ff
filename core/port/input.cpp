#include "core/port/input.h"

#include <algorithm>
#include <mutex>

#include "core/element/runtime.h"

namespace runnel {

InputBase::InputBase(const Placement& placement, const TypeInfo& type, InputOptions options)
    : Port(placement, Direction::kInput, type, options.description), options_(std::move(options)) {}

void InputBase::SetWaker(Waker* waker) {
  const std::lock_guard lock(runtime().structure_mutex());
  if (waker_ == waker) return;
  waker_ = waker;
  for (const Source& source : sources_) UpdateChannel(*source.output);
}

void InputBase::Rebind(const std::vector<Source>& sources) {
  std::vector<Port*> outputs;
  for (const Source& source : sources_) outputs.push_back(source.output);
  for (const Source& source : sources) {
    if (std::ranges::find(outputs, source.output) == outputs.end()) {
      outputs.push_back(source.output);
    }
  }
  sources_ = sources;
  sink_ = Bind(sources);
  for (Port* output : outputs) UpdateChannel(*output);
  Bound();
}

// Works out anew whom publishers into the output's channel have to visit, and what they have to
// reserve and number for them.
void InputBase::UpdateChannel(Port& output) {
  ChannelBase& channel = *ChannelOf(output);
  Subscribers subscribers;
  std::size_t waiting = 0;
  bool shares_an_input = false;
  for (Port* port : output.Sinks()) {
    // A sink is an input that is no interface port, and all of those derive from InputBase.
    auto& input = static_cast<InputBase&>(*port);
    if (input.sink_ != nullptr) {
      subscribers.queues.push_back(input.sink_);
      waiting += input.sink_->room();
    }
    if (input.waker_ != nullptr) subscribers.wakers.push_back(input.waker_);
    shares_an_input = shares_an_input || input.sources_.size() > 1;
  }
  channel.ReserveFor(waiting);
  // Once numbered, always numbered: else a number from before would outdo a later value.
  if (shares_an_input) channel.SetOrdered(true);
  channel.SetSubscribers(std::move(subscribers));
}

}  // namespace runnel
