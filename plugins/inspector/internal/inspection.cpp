#include "plugins/inspector/internal/inspection.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "core/base/files.h"
#include "plugins/values/json_reader.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

std::string Arrangement::FileOf(const std::string& application_file) {
  if (application_file.empty()) return {};
  return std::filesystem::path(application_file).replace_extension(".layout.json").string();
}

Result<void> Arrangement::Read(const std::string& file) {
  const auto text = TextOfFile(file);
  if (!text) return {};
  const auto json = JsonPart::Parse(*text, 2);
  if (!json) return json.error().WithContext(file + " cannot be read");
  Entries read;
  for (const auto& [name, value] : json->members()) {
    if (auto each = value.text()) read.emplace(name, std::move(*each));
  }
  return Change(read);
}

Result<void> Arrangement::Change(const Entries& changed) {
  for (const auto& [name, text] : changed) {
    if (name.empty() || name.size() > kLongestName || text.size() > kLongestText) {
      return Error{.message = "an entry of the layout is too long, or has no name",
                   .hint = "at most " + std::to_string(kLongestText) + " bytes"};
    }
  }
  if (entries_.size() + changed.size() > kMostEntries) {
    return Error{.message = "more than " + std::to_string(kMostEntries) + " entries of the layout"};
  }
  if (changed.empty()) return {};
  ++revision_;
  for (const auto& [name, text] : changed) entries_[name] = {text, revision_};
  return {};
}

Arrangement::Entries Arrangement::Since(std::uint64_t revision) const {
  Entries changed;
  for (const auto& [name, entry] : entries_) {
    const bool is_told = revision == 0 ? entry.text.empty() : entry.revision <= revision;
    if (!is_told) changed.emplace(name, entry.text);
  }
  return changed;
}

std::string Arrangement::MessageSince(std::uint64_t revision) const {
  return JsonObjectText([&](JsonObject& json) {
    json.Add("op", "layout");
    JsonObject entries(json.Key("entries"));
    for (const auto& [name, text] : Since(revision)) entries.Add(name, text);
  });
}

std::string Arrangement::Text() const {
  std::string text;
  for (const auto& [name, entry] : entries_) {
    if (entry.text.empty()) continue;
    text += text.empty() ? "{\n  " : ",\n  ";
    AppendJsonString(name, text);
    text += ": ";
    AppendJsonString(entry.text, text);
  }
  return text.empty() ? text : text + "\n}\n";
}

Result<void> Arrangement::Write(const std::string& file, const std::string& text) {
  if (!text.empty()) return ReplaceFile(file, text);
  std::error_code failure;
  std::filesystem::remove(file, failure);
  if (failure) return Error{.message = file + ": " + failure.message()};
  return {};
}

namespace {

using std::chrono::milliseconds;

// How often structure and parameters are looked at for changes that others have made.
constexpr auto kLook = milliseconds(50);
// While there is more to look at, or the structure is locked.
constexpr auto kLookOn = milliseconds(2);
constexpr auto kLookAtRegistry = milliseconds(1000);
constexpr auto kLookAtReach = milliseconds(500);

std::string RunName() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::to_string(getpid()) + "-" + std::to_string(std::chrono::duration_cast<milliseconds>(now).count());
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

Inspection::SteadyTime Inspection::Look() {
  const SteadyTime now = std::chrono::steady_clock::now();
  if (now < look_at_) return look_at_;
  LookAtRegistry(now);
  look_at_ = now + (mirror_.Look() ? Duration(kLook) : Duration(kLookOn));
  return look_at_;
}

const std::optional<StopReach>& Inspection::stop_reach() {
  const SteadyTime now = std::chrono::steady_clock::now();
  if (now < look_at_reach_) return reach_;
  look_at_reach_ = now + kLookAtReach;
  return reach_ = FindStopReach(application_.runtime, &scheduler_);
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
  // Modules are made for it, some of which take their time.
  cataloguing_ = tasks_.Post([this] {
    auto made = std::make_shared<const Catalogue>(MakeCatalogue(application_));
    const std::lock_guard guard(mutex_);
    catalogue_ = std::move(made);
  });
  registry_ = registry;
}

}  // namespace runnel::internal
