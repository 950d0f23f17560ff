#include <atomic>
#include <mutex>
#include <utility>

#include "core/base/retry.h"
#include "core/element/attempt.h"
#include "core/lockfree/thread_epoch.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "plugins/foxglove/internal/foxglove_session.h"
#include "plugins/values/foxglove_channel.h"
#include "plugins/values/json_values.h"

namespace runnel::internal {

namespace {

// Hz of the application's time: what looks at the age of commands has a fresh one, as from the page.
constexpr double kRate = 20;
std::atomic<std::uint64_t> numbers{0};  // of what clients bring
}  // namespace

/// What holds the output in the tree, beside the application.
class ClientPublication::Place final : public FrameworkElement {
 public:
  explicit Place(const Placement& placement) : FrameworkElement(placement) {
    Annotate(std::make_unique<BroughtByClient>());
  }
  std::unique_ptr<Port> output;
};

ClientPublication::ClientPublication(FoxgloveShared& shared, const DirectoryInput& input, std::function<void()> wake)
    : shared_(shared),
      input_(input),
      type_(*input.type),
      wake_(std::move(wake)),
      place_("foxglove_client_" + std::to_string(++numbers)),
      is_made_(input.drives) {
  if (const auto usual = type_.Make()) AppendJson(type_, usual.get(), usual_);
  if (input.drives) return;
  task_ = shared_.tasks->Post(
      [&shared, input, place = place_] {
        if (auto made = Make(shared, input, place); !made) throw ElementError(made.error());
      },
      wake_);
}

Result<void> ClientPublication::Make(FoxgloveShared& shared, const DirectoryInput& input, const std::string& name) {
  Runtime& runtime = shared.runtime();
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = runtime.root().Find(input.path);
  if (!found) return found.error();
  auto* const port = dynamic_cast<Port*>(*found);
  if (port == nullptr || &port->type() != input.type) {
    return Error{.message = "this is another port by now", .path = input.path};
  }
  if (port->is_proxy() && port->Sinks().empty()) {
    return Error{.message = "nothing is connected to this port that could read it", .path = input.path};
  }
  shared.places.insert(name);
  auto& place = runtime.Create<Place>(runtime.root(), name);
  place.output = port->MakeOutput(place, port->name(), {});
  if (!place.output) {
    return Error{.message = "only a module can make a " + input.type->name(), .path = input.path};
  }
  if (auto ready = runtime.MakeReady(place); !ready) return ready;
  return Port::Connect(*place.output, *port);
}

namespace {
// Not for long: others are served by the same thread.
template <typename Action>
void TrySome(const Action& action) noexcept {
  for (int attempt = 0; attempt < 30; ++attempt) {
    try {
      return action();
    } catch (...) {  // no memory, or no thread
    }
  }
}
}  // namespace

// What does not come about even so ends with the deadline, or with the server.
ClientPublication::~ClientPublication() {
  if (!lease_.empty()) TrySome([this] { shared_.application.service.EndLease(lease_); });
  if (input_.drives) return;
  TrySome([this] {
    shared_.tasks->Post([&shared = shared_, place = place_] {
      if (DeletePlace(shared.runtime(), place)) shared.places.erase(place);
    });
  });
}

bool ClientPublication::Continue() {
  if (task_) {
    if (!task_->is_done()) return false;  // the worker tells when it is
    error_ = task_->failure();
    task_ = nullptr;
    is_made_ = !error_;
  }
  if (driving_ && driving_->is_done()) {
    const CommandAnswer answer = driving_->Take();
    if (!answer && !answer.diagnostics.ok()) error_ = answer.diagnostics.errors().front();
    driving_ = nullptr;
  }
  if (waiting_ && is_made_) {
    if (auto published = PublishWaiting(); !published) error_ = published.error();
  }
  return waiting_ && is_made_;
}

Result<void> ClientPublication::Publish(std::string_view json, Time received) {
  if (input_.drives) return Drive(json, received);
  waiting_ = json;
  as_of_ = shared_.runtime().robot_stop().AsOfNow();
  if (task_) return {};
  return PublishWaiting();
}

// Whoever has been silent takes hold anew: the protocol does not say when a button is pressed.
Result<void> ClientPublication::Drive(std::string_view json, Time received) {
  const Duration deadline = shared_.application.drive_deadline;
  if (lease_.empty() || received - heard_ > deadline) lease_ = "foxglove " + std::to_string(++numbers);
  heard_ = received;
  const std::shared_ptr<void> value = type_.Make();
  if (!value) return Error{.message = "only a module can make a " + type_.name()};
  return Attempt([&]() -> Result<void> {  // a type may throw when it is read
    if (auto read = Read(json, value.get()); !read) return read;
    PublishRequest publish{input_.path, ToText(type_, value.get()), kRate, deadline, lease_, received};
    driving_ = shared_.application.service.Begin(std::move(publish), *shared_.tasks, wake_);
    return {};
  });
}

Result<void> ClientPublication::Read(std::string_view json, void* value) const {
  if (auto usual = SetFromJson(type_, usual_, value); !usual) return usual;
  return SetFromMessage(type_, json, value);
}

Result<void> ClientPublication::PublishWaiting() {
  const EpochGuard guard;  // what is found stays in memory so long
  Place* place = nullptr;
  std::string json;
  {
    // Somebody may have deleted it, as any other element.
    Runtime& runtime = shared_.runtime();
    const std::unique_lock lock(runtime.structure_mutex(), std::try_to_lock);
    if (!lock) return {};  // it goes on waiting
    json = *std::exchange(waiting_, std::nullopt);
    if (auto counts = runtime.robot_stop().CheckIsKnown(as_of_); !counts) return counts;
    place = dynamic_cast<Place*>(runtime.root().FindChild(place_));
    if (place == nullptr) {
      return Error{
          .message = "the output of this channel has been deleted", .path = "/" + place_, .hint = "advertise it anew"};
    }
  }
  const auto fill = [&](void* value) { return Read(json, value); };
  // A type may throw when it is read.
  const auto published = Attempt([&] { return place->output->PublishFilled(fill); });
  return published ? Result<void>() : published.error();
}

bool DeletePlace(Runtime& runtime, const std::string& name) noexcept {
  return Retry([&] {
    std::unique_lock lock(runtime.structure_mutex());
    FrameworkElement* const place = runtime.root().FindChild(name);
    lock.unlock();
    // That somebody else has deleted it is as good.
    if (place != nullptr) (void)runtime.Delete(*place);
  });
}

}  // namespace runnel::internal
