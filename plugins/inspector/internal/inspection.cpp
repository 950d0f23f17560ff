#include "plugins/inspector/internal/inspection.h"

#include <utility>

#include <unistd.h>

namespace runnel::internal {

namespace {

using std::chrono::milliseconds;

// How often structure and parameters are looked at for changes that others have made.
constexpr auto kLook = milliseconds(50);
// While there is more to look at, or the structure is locked.
constexpr auto kLookOn = milliseconds(2);
constexpr auto kLookAtRegistry = milliseconds(1000);

std::string RunName() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::to_string(getpid()) + "-" +
         std::to_string(std::chrono::duration_cast<milliseconds>(now).count());
}

}  // namespace

Inspection::Inspection(CommandService& service, Scheduler& scheduler, InspectorOptions options)
    : service_(service),
      application_(service.application()),
      scheduler_(scheduler),
      options_(std::move(options)),
      run_(RunName()),
      start_(application_.runtime.clock().Now()),
      mirror_(application_.runtime, application_.modules, scheduler, application_.log),
      panel_(options_.file),
      tasks_(service.worker()) {
  const auto read = arrangement_.Read(Arrangement::FileOf(options_.file));
  if (!read) application_.log.Add(ApplicationLog::Kind::kWarning, read.error().ToString());
}

std::shared_ptr<const Catalogue> Inspection::catalogue() const {
  const std::lock_guard lock(mutex_);
  return catalogue_;
}

void Inspection::NoteEnd(std::string verdict) {
  const std::lock_guard lock(mutex_);
  verdict_ = std::move(verdict);
}

std::optional<std::string> Inspection::verdict() const {
  const std::lock_guard lock(mutex_);
  return verdict_;
}

Inspection::SteadyTime Inspection::Look() {
  const SteadyTime now = std::chrono::steady_clock::now();
  if (now < look_at_) return look_at_;
  LookAtRegistry(now);
  look_at_ = now + (mirror_.Look() ? Duration(kLook) : Duration(kLookOn));
  return look_at_;
}

void Inspection::LookAtRegistry(SteadyTime now) {
  if (now < look_at_registry_ || (cataloguing_ && !cataloguing_->is_done())) return;
  if (cataloguing_ && cataloguing_->failure()) registry_ = 0;  // once more
  std::unique_lock lock(application_.runtime.structure_mutex(), std::try_to_lock);
  if (!lock) return;
  const std::uint64_t registry = RegistryFingerprint(application_.modules);
  lock.unlock();
  look_at_registry_ = now + kLookAtRegistry;
  if (registry == registry_) return;
  registry_ = registry;
  // Modules are made for it, some of which take their time.
  cataloguing_ = tasks_.Post([this] {
    auto made = std::make_shared<const Catalogue>(
        MakeCatalogue(application_));
    const std::lock_guard guard(mutex_);
    catalogue_ = std::move(made);
  });
}

}  // namespace runnel::internal
