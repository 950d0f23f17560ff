#include "plugins/foxglove/internal/client_publication.h"

#include <atomic>
#include <mutex>
#include <utility>

#include "core/lockfree/thread_epoch.h"
#include "core/types/type_info.h"
#include "plugins/command_service/caught_error.h"
#include "plugins/values/foxglove_channel.h"
#include "plugins/values/json_values.h"

namespace runnel::internal {

/// What holds the output in the tree, beside the application.
class ClientPublication::Place final : public FrameworkElement {
 public:
  explicit Place(const Placement& placement) : FrameworkElement(placement) {
    Annotate(std::make_unique<BroughtByClient>());
  }
  std::unique_ptr<Port> output;
};

struct ClientPublication::PendingOutput {
  Place* place = nullptr;  // the runtime's
  std::string path;        // of the place
  std::optional<Error> error;
};

ClientPublication::ClientPublication(FoxgloveShared& shared, const DirectoryInput& input,
                                     std::function<void()> wake)
    : shared_(shared), type_(*input.type), pending_(std::make_shared<PendingOutput>()) {
  if (const auto usual = type_.Make()) AppendJson(type_, usual.get(), usual_);
  task_ = shared_.tasks->Post(
      [&shared, input, pending = pending_] {
        if (auto made = Make(shared, input, *pending); !made) pending->error = made.error();
      },
      std::move(wake));
}

Result<void> ClientPublication::Make(FoxgloveShared& shared, const DirectoryInput& input,
                                     PendingOutput& pending) {
  static std::atomic<std::uint64_t> number{0};
  Runtime& runtime = shared.runtime();
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = runtime.root().Find(input.path);
  if (!found) return found.error();
  auto* const port = dynamic_cast<Port*>(*found);
  if (port == nullptr || &port->type() != input.type) {
    return Error{.message = "this is another port by now", .path = input.path};
  }
  if (port->is_proxy() && port->Sinks().empty()) {
    return Error{.message = "nothing is connected to this port that could read it",
                 .path = input.path};
  }
  auto& place =
      runtime.Create<Place>(runtime.root(), "foxglove_client_" + std::to_string(++number));
  shared.places.insert(place.path());
  pending.place = &place;
  pending.path = place.path();
  place.output = port->MakeOutput(place, port->name(), {});
  if (!place.output) {
    return Error{.message = "only a module can make a " + input.type->name(), .path = input.path};
  }
  if (auto ready = runtime.MakeReady(place); !ready) return ready;
  return Port::Connect(*place.output, *port);
}

ClientPublication::~ClientPublication() {
  shared_.tasks->Post([&shared = shared_, pending = pending_] {
    if (pending->place == nullptr) return;
    DeletePlace(shared.runtime(), pending->path);
    shared.places.erase(pending->path);
  });
}

std::optional<Error> ClientPublication::TakeError() { return std::exchange(error_, std::nullopt); }

bool ClientPublication::Continue() {
  if (task_) {
    if (!task_->is_done()) return false;  // the worker tells when it is
    error_ = task_->failure() ? task_->failure() : pending_->error;
    task_ = nullptr;
    is_made_ = !error_;
  }
  if (waiting_ && is_made_) {
    if (auto published = PublishWaiting(); !published) error_ = published.error();
  }
  return waiting_ && is_made_;
}

Result<void> ClientPublication::Publish(std::string_view json) {
  waiting_ = json;
  as_of_.requests = shared_.runtime().robot_stop().state().requests;
  if (task_) return {};
  return PublishWaiting();
}

Result<void> ClientPublication::PublishWaiting() {
  const EpochGuard guard;  // what is found stays in memory so long
  {
    // Somebody may have deleted it, as any other element.
    Runtime& runtime = shared_.runtime();
    const std::unique_lock lock(runtime.structure_mutex(), std::try_to_lock);
    if (!lock) return {};  // it goes on waiting
    if (auto counts = shared_.runtime().robot_stop().CheckIsKnown(as_of_); !counts) {
      waiting_ = std::nullopt;
      return counts;
    }
    const auto found = runtime.root().Find(pending_->path);
    if (!found || *found != pending_->place) {
      waiting_ = std::nullopt;
      return Error{.message = "the output of this channel has been deleted",
                   .path = pending_->path,
                   .hint = "advertise it anew"};
    }
  }
  const std::string json = *std::exchange(waiting_, std::nullopt);
  const auto fill = [&](void* value) -> Result<void> {
    if (auto usual = SetFromJson(type_, usual_, value); !usual) return usual;
    return SetFromMessage(type_, json, value);
  };
  try {
    const auto published = pending_->place->output->PublishFilled(fill);
    if (!published) return published.error();
  } catch (...) {  // of a type that throws when it is read
    return CaughtError();
  }
  return {};
}

void DeletePlace(Runtime& runtime, const std::string& path) {
  FrameworkElement* place = nullptr;
  {
    const std::lock_guard lock(runtime.structure_mutex());
    if (const auto found = runtime.root().Find(path)) place = *found;
  }
  // That somebody else has deleted it is as good.
  if (place != nullptr) (void)runtime.Delete(*place);
}

}  // namespace runnel::internal
